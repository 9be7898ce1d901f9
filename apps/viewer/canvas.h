// SPDX-License-Identifier: Apache-2.0
// The picture in the window: drawn again where something changed, smoothed while nothing does.
#pragma once

#include <imgui.h>

#include <memory>

#include "gpu/light_source.h"
#include "gpu/mix.h"
#include "gpu/view.h"
#include "mix/mixer.h"
#include "session/look.h"
#include "session/movers.h"
#include "session/reading.h"
#include "viewer/screen.h"

namespace sconce::viewer {

/// All that a picture depends on.
struct Scenery {
  Camera camera;
  int width = 0, height = 0;
  LookKind look = LookKind::picture;
  FalseColor scale;
};

class Canvas : public Screen {
 public:
  Canvas(const gpu::Context& context, std::shared_ptr<const Opened> opened);

  /// Draws what is needed. @return whether more samples are to come
  bool draw(const Session& session, const Scenery& scenery, const Movers& movers);
  /// Objects stand elsewhere. @param view  must outlive it from now on
  void follow(const sconce::View& view);
  /// Beside the picture, of the same size: codes of another one, for the right half of `reference`.
  void set_reference(const Image& linear, const Session& session);
  bool has_reference() const { return reference_sum_ != nullptr; }
  void forget_reference() { reference_sum_.reset(); }
  /// The same picture by rays, with what mirrors show: stands instead of what was drawn until anything but
  /// the exposure changes. @param linear  cd/m2
  void set_at_rest(Image linear, const Session& session);
  /// Counts the pictures that were begun anew.
  uint64_t version() const { return version_; }
  void draw_anew() { samples_ = 0; }
  /// Of the mix that is drawn. @param movers  as in draw()
  std::vector<Image> mixed_pages(const Movers& movers);
  /// As mix_components(), of the groups whose light is as it was baked; empty where no normal maps are seen.
  std::vector<Image> mixed_components(const MixSpec& mix, const Movers& movers);
  /// Pages of each group whose light is not as it was baked, as weighted in the mix that is drawn.
  const GroupPages& moved_pages(const Movers& movers);

  ImTextureID reference() const { return id_of(reference_display_.texture()); }
  Image linear() const override { return at_rest_ ? at_rest_linear_ : view_.linear(); }
  const gpu::Geometry& geometry() const { return view_.geometry(); }
  static constexpr int kSamples = 16;

 private:
  void update_mix(const MixSpec& mix, const Movers& movers, bool metered);
  const gpu::LightSource& light(LookKind look);
  void display(const Session& session, const Scenery& scenery);

  const gpu::Context* context_;
  std::shared_ptr<const Opened> opened_;
  gpu::View view_;
  Mixer mixer_;
  std::vector<Mixer> axes_;                 ///< of its directions; empty where no normal maps are seen
  std::unique_ptr<gpu::AtlasMix> atlas_;    ///< where a graphics device mixes
  std::unique_ptr<gpu::MixedPages> pages_;  ///< where the processor does
  std::unique_ptr<gpu::MixedPages> noise_;
  MixSpec noise_mix_;
  gpu::DisplayPass reference_display_;
  std::unique_ptr<gpu::Texture> reference_sum_, at_rest_;
  Image at_rest_linear_;

  GroupPages moved_pages_;
  uint64_t moved_version_ = 0;  ///< Movers::version() that they are of
  MixSpec moved_mix_;           ///< and the mix
  bool on_device_ = false;
  uint64_t relit_ = 0;  ///< Movers::version()
  Scenery drawn_;
  Mood shown_;
  int samples_ = 0;
  uint64_t version_ = 0;
};

}  // namespace sconce::viewer
