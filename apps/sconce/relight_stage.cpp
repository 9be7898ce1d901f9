// SPDX-License-Identifier: Apache-2.0
#include "relight_stage.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>

#include "core/error.h"
#include "gpu/direct_light.h"
#include "gpu/near_lights.h"
#include "gpu/pixel_indirect.h"
#include "gpu/transfer.h"
#include "gpu/view.h"
#include "stage.h"

namespace sconce::app {

namespace {

class CpuRelightStage : public RelightStage {
 public:
  CpuRelightStage(const RelightJob& job, const FoldedBounces& bounces)
      : view_(job.view),
        lamps_(job.lamps),
        relighter_(job.package, job.view, job.op, bounces, job.lamps, job.cull, job.lobes) {}
  std::string device() const override { return "cpu"; }
  Relighter::Seconds seconds() const override { return relighter_.seconds(); }
  Culling::Report culled() const override {
    Culling::Report report = relighter_.culled();
    double squares = 0;
    for (const Rgb& e : relighter_.indirect())
      for (const float v : {e.r, e.g, e.b}) squares += static_cast<double>(v) * static_cast<double>(v);
    report.bound /= std::max(std::sqrt(squares), 1e-30);
    return report;
  }
  void add_to(std::vector<Image>& pages) const override { relighter_.add_to(pages); }
  Image draw(const Camera& camera, const MixSpec& mix, const std::vector<Image>& pages,
             const std::vector<Image>& components, const PictureParams& params,
             const Progress& progress) override {
    return view_.render(
        camera, mix, pages, params, progress, nullptr, relighter_.added(), components,
        [&](const Shade& surface, const Vec3& to_eye, const SurfacePoint& at, uint32_t stream,
            uint32_t index) { return lamps_.glints(mix, surface, to_eye, at, stream, index); },
        relighter_.mirrored());
  }

 private:
  const View& view_;
  const MovedLamps& lamps_;
  Relighter relighter_;
};

/// Column, row.
std::string place(uint32_t number, int width) {
  return fmt::format("{}, {}", number % static_cast<uint32_t>(width), number / static_cast<uint32_t>(width));
}

bool mirrors(const RelightJob& job, const RelightDevice& device) {
  return device.reflections && job.view.scene().has_mirrors();
}

class GlRelightStage : public RelightStage {
 public:
  GlRelightStage(const RelightJob& job, std::unique_ptr<gpu::Context> context,
                 std::vector<gpu::LampShader> shaders, const MovedLamps& lamps, const RelightDevice& device)
      : job_(job),
        context_(std::move(context)),
        view_(*context_, job.view.shown(), job.view.sees_normal_maps() || mirrors(job, device)),
        direct_(*context_, view_.geometry(), job.view.world().bounds, std::move(shaders)),
        near_(*context_, view_.geometry(), job.view.world().bounds, lamps.lamps(), lamps.chosen(),
              {std::max(64, device.shadow_side / 4), device.terms_per_pass, device.srgbe,
               mirrors(job, device)}),
        transfer_(*context_, job.op) {
    using Clock = std::chrono::steady_clock;
    const gpu::Buffer points(*context_, job.op.lit, "the operator's cloud");
    glFinish();
    const auto start = Clock::now();
    direct_.light_cloud(points, job.op.slots(), job.op.points_per_slot, transfer_.exitance());
    near_.light_cloud(points, job.op.slots(), job.op.points_per_slot, transfer_.exitance());
    glFinish();
    const auto lit = Clock::now();
    transfer_.apply();
    glFinish();
    seconds_.direct = std::chrono::duration<double>(lit - start).count();
    seconds_.indirect = std::chrono::duration<double>(Clock::now() - lit).count();
    added_ = {&direct_, &near_};
    if (job.op.kind == OperatorReceivers::pixels) {
      pixels_ = std::make_unique<gpu::PixelIndirect>(*context_, job.op, transfer_.illuminance(),
                                                     job.view.world().bounds.diagonal());
      added_.push_back(pixels_.get());
    }
  }
  std::string device() const override { return context_->capabilities().renderer; }
  Relighter::Seconds seconds() const override { return seconds_; }
  void add_to(std::vector<Image>& pages) const override {
    add_to_pages(job_.package, job_.view, job_.op, transfer_.read(), pages);
  }
  Image draw(const Camera& camera, const MixSpec& mix, const std::vector<Image>& pages,
             const std::vector<Image>& components, const PictureParams& params,
             const Progress& progress) override {
    if (params.reflections > 0 && job_.view.scene().has_mirrors()) progress.warn(kNoReflections);
    if (job_.view.scene().has_panes()) progress.warn(kNoPanes);
    near_.set_mix(mix.weights);
    view_.draw(camera, mix.weights, gpu::MixedPages(*context_, pages, components), params, progress,
               {.added = added_});
    for (const gpu::DirectLight::Report& report : direct_.mishaps()) {
      std::string line = report.file + ": NaN or infinity, painted over:";
      if (report.cloud.count > 0)
        line += fmt::format(" {} of {} gather samples (first: {})", report.cloud.count, job_.op.lit.size(),
                            report.cloud.first);
      if (report.pixels.count > 0)
        line += fmt::format("{} {} pixels of all passes (first: {})", report.cloud.count > 0 ? "," : "",
                            report.pixels.count, place(report.pixels.first, params.width));
      progress.warn(line);
    }
    return view_.linear();
  }

 private:
  RelightJob job_;
  std::unique_ptr<gpu::Context> context_;
  gpu::View view_;
  gpu::DirectLight direct_;
  gpu::NearLights near_;
  gpu::Transfer transfer_;
  std::unique_ptr<gpu::PixelIndirect> pixels_;
  std::vector<gpu::AddedLight*> added_;
  Relighter::Seconds seconds_;
};

}  // namespace

void RelightDevice::check() const {
  if (name != "auto" && name != "cpu" && name != "gl")
    throw UsageError("option '--device'", "unknown device '" + name + "'", "auto, cpu, gl");
  if (patches < 1 || patches > 1024)
    throw UsageError("option '--patches'", std::to_string(patches), "1 to 1024");
  if (shadow_side < 64 || shadow_side > 16384)
    throw UsageError("option '--shadow-map'", fmt::format("{} texels", shadow_side), "64 to 16384");
  if (terms_per_pass < 0)
    throw UsageError("option '--terms-per-pass'", std::to_string(terms_per_pass), "0 (all), 1, 2, ...");
}

std::unique_ptr<RelightStage> make_relight_stage(const RelightJob& job, const RelightDevice& device,
                                                 const Progress& progress) {
  if (device.name == "cpu" && !job.shaders.empty())
    throw UsageError("option '--device'", "light shaders need OpenGL", "gl, auto");
  if (job.cull > 0 && (device.name == "gl" || !job.shaders.empty()))
    throw UsageError("option '--cull'", "OpenGL leaves nothing out", "with --device cpu");
  for (const std::string& name : job.lamps.buried())
    progress.warn("lamp '" + name + "' stands inside something: its rays end on backs of surfaces");
  const Scene& scene = job.view.scene();
  const bool traced = device.name == "auto" && (mirrors(job, device) || scene.has_panes());
  const bool cpu = traced || job.cull > 0 || !job.op.gather.basis.values.empty();
  if (auto context = open_context(!job.shaders.empty() ? "gl" : cpu ? "cpu" : device.name)) {
    try {
      std::vector<gpu::LampShader> all =
          gpu::lamp_shaders(job.lamps.lamps(), job.lamps.chosen(), device.patches, device.shadow_side);
      all.insert(all.end(), job.shaders.begin(), job.shaders.end());
      return std::make_unique<GlRelightStage>(job, std::move(context), std::move(all), job.lamps, device);
    } catch (const gpu::UnknownLamp&) {
      if (device.name == "gl" || !job.shaders.empty()) throw;
    }
  }
  const auto bounces = job.bounces ? job.bounces : std::make_shared<const FoldedBounces>(job.op);
  return std::make_unique<CpuRelightStage>(job, *bounces);
}

}  // namespace sconce::app
