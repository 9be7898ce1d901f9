// SPDX-License-Identifier: Apache-2.0
#include "stage.h"

#include "core/error.h"
#include "gpu/view.h"
#include "picture/render.h"
#include "tone/apply.h"

namespace sconce::app {

namespace {

class CpuStage : public Stage {
 public:
  explicit CpuStage(const Package& package) : package_(&package), view_(package) {}
  std::string device() const override { return "cpu"; }
  const Scene& scene() const override { return view_.scene(); }
  Camera eye_height_camera(const Progress& progress) const override { return view_.camera("", progress); }
  void draw(const Camera& camera, const MixSpec& mix, const std::vector<Image>& pages,
            const PictureParams& params, const Progress& progress) override {
    std::vector<Image> components;
    if (view_.sees_normal_maps()) components = mix_components(*package_, mix);
    linear_ = view_.render(camera, mix, pages, params, progress, &coverage_, {}, components);
  }
  Image linear() const override { return linear_; }
  Image coverage() const override { return coverage_; }
  Image8 toned(const Exposure& exposure, const ToneMapper& mapper) const override {
    return tone_map(linear_, exposure, mapper);
  }

 private:
  const Package* package_;
  View view_;
  Image linear_, coverage_;
};

class GlStage : public Stage {
 public:
  GlStage(const Package& package, std::unique_ptr<gpu::Context> context)
      : package_(&package), context_(std::move(context)), shown_(package), view_(*context_, shown_) {}
  std::string device() const override { return context_->capabilities().renderer; }
  const Scene& scene() const override { return shown_.scene; }
  // Finding a free view needs rays.
  Camera eye_height_camera(const Progress& progress) const override {
    return View(*package_).camera("", progress);
  }
  void draw(const Camera& camera, const MixSpec& mix, const std::vector<Image>& pages,
            const PictureParams& params, const Progress& progress) override {
    check_pages(package_->manifest(), mix, pages);
    if (package_->manifest().basis == Basis::sh1 && scene().has_normal_maps())
      progress.warn("OpenGL shows surfaces without their normal maps; --device cpu sees them");
    view_.draw(camera, mix.weights, gpu::MixedPages(*context_, pages), params, progress);
  }
  Image linear() const override { return view_.linear(); }
  Image coverage() const override { return view_.coverage(); }
  Image8 toned(const Exposure& exposure, const ToneMapper& mapper) const override {
    return view_.toned(exposure, mapper);
  }

 private:
  const Package* package_;
  std::unique_ptr<gpu::Context> context_;
  ShownScene shown_;
  gpu::View view_;
};

/// Null where `device` leaves it to us and there is no graphics device: OpenGL in software is slower than
/// rays.
std::unique_ptr<gpu::Context> open_context(const std::string& device) {
  if (device == "cpu") return nullptr;
  try {
    return std::make_unique<gpu::Context>(gpu::ContextParams{.hardware_only = device == "auto"});
  } catch (const Error&) {
    if (device != "auto") throw;
    return nullptr;
  }
}

}  // namespace

std::unique_ptr<Stage> make_stage(const Package& package, const std::string& device) {
  // Normal maps are seen by rays only.
  const bool rays = device == "auto" && package.manifest().basis != Basis::flat;
  if (auto context = open_context(rays ? "cpu" : device))
    return std::make_unique<GlStage>(package, std::move(context));
  return std::make_unique<CpuStage>(package);
}

}  // namespace sconce::app
