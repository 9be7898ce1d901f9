// SPDX-License-Identifier: Apache-2.0
// What the window needs of whatever draws its picture.
#pragma once

#include <imgui.h>

#include <cstdint>

#include "core/stopwatch.h"
#include "gpu/display_pass.h"
#include "mix/mix.h"

namespace sconce::viewer {

inline ImTextureID id_of(const gpu::Texture& texture) {
  return reinterpret_cast<ImTextureID>(static_cast<std::intptr_t>(texture.handle()));
}

class Screen {
 public:
  explicit Screen(const gpu::Context& context) : display_(context) {}
  virtual ~Screen() = default;

  ImTextureID texture() const { return id_of(display_.texture()); }
  Image8 read() const { return display_.read(); }
  /// Linear, before exposure and tone curve.
  virtual Image linear() const = 0;
  const Metering& metering() const { return metering_; }
  const MixSpec& mix() const { return mix_; }
  double fader_milliseconds() const { return fader_ms_; }  ///< processor's work of the last fader move
  /// Of the last draw(), in OpenGL.
  double drawing_milliseconds() const { return drawing_ms_; }

 protected:
  gpu::DisplayPass display_;
  MixSpec mix_;
  bool mixed_ = false, metered_ = false;
  Metering metering_;
  double fader_ms_ = 0, drawing_ms_ = 0;
};

}  // namespace sconce::viewer
