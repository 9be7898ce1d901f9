// SPDX-License-Identifier: Apache-2.0
// OpenGL draws no reflections: as soon as nothing moves, rays do, coarse first.
#include "picture/gloss.h"
#include "viewer/viewer.h"

namespace sconce::viewer {

namespace {

constexpr int kPasses = 16;  // one ray per pixel each

bool shows_mirrors(LookKind look) {
  return look == LookKind::picture || look == LookKind::luminance;
}

}  // namespace

void Viewer::follow_mirrors() {
  Canvas& canvas = *state_.canvas;
  const Opened& opened = *state_.opened;
  const Scene& scene = opened.rays.scene();
  const bool wanted =
      state_.reflections && shows_mirrors(state_.look) && (scene.has_mirrors() || scene.has_panes());
  if (!wanted || canvas.version() != mirrored_) mirroring_.stop();
  if (!wanted) {
    if (mirrored_ != 0) canvas.draw_anew();
    mirrored_ = 0;
    return;
  }
  if (auto picture = mirroring_.take(); picture && canvas.version() == mirrored_)
    canvas.set_at_rest(std::move(*picture), *state_.session);
  if (canvas.version() == mirrored_ || drawing_more_ || state_.dragging()) return;
  mirrored_ = canvas.version();
  PictureParams params{.width = static_cast<int>(state_.canvas_size.x),
                       .height = static_cast<int>(state_.canvas_size.y),
                       .samples = 1,
                       .reflections = kReflections};
  mirroring_.start([opened = state_.opened, mover = state_.objects.mover, &view = rays(),
                    camera = state_.camera, mix = canvas.mix(), pages = canvas.mixed_pages(state_.movers()),
                    components = canvas.mixed_components(canvas.mix(), state_.movers()),
                    params](const Progress& progress, const auto& publish) mutable {
    Image sum = Image::rgb(params.width, params.height);
    for (int pass = 1; pass <= kPasses; ++pass) {
      params.seed = static_cast<uint32_t>(pass);
      const Image one = view.render(camera, mix, pages, params, progress, nullptr, {}, components);
      Image mean = sum;
      for (std::size_t i = 0; i < sum.data.size(); ++i) {
        sum.data[i] += one.data[i];
        mean.data[i] = sum.data[i] / static_cast<float>(pass);
      }
      publish(std::move(mean));
    }
  });
}

}  // namespace sconce::viewer
