// SPDX-License-Identifier: Apache-2.0
// Another renderer's picture in the window: mixed by the processor, shown by the device.
#pragma once

#include "mix/mixer.h"
#include "session/look.h"
#include "session/opened_picture.h"
#include "session/session.h"
#include "viewer/screen.h"

namespace sconce::viewer {

class Sheet : public Screen {
 public:
  Sheet(const gpu::Context& context, std::shared_ptr<const OpenedPicture> opened);

  /// Draws the whole picture where something changed. @param look  picture or luminance
  void draw(const Session& session, LookKind look, const FalseColor& scale);
  Image linear() const override { return mixed_light_; }
  const OpenedPicture& opened() const { return *opened_; }
  std::shared_ptr<const EncodedLayers> layers() const { return layers_of(opened_); }

 private:
  std::shared_ptr<const OpenedPicture> opened_;
  Mixer mixer_;
  Image mixed_light_;
  gpu::Texture light_;
  std::optional<Mood> shown_;
  LookKind look_ = LookKind::picture;
  FalseColor scale_;
};

}  // namespace sconce::viewer
