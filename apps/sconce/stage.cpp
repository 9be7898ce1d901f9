// SPDX-License-Identifier: Apache-2.0
#include "stage.h"

#include "core/error.h"
#include "gpu/near_lights.h"
#include "gpu/way.h"
#include "mix/tone_lightmap.h"
#include "picture/fixed_function.h"
#include "tone/apply.h"

namespace sconce::app {

namespace {

class CpuStage : public Stage {
 public:
  explicit CpuStage(const Package& package) : package_(&package), view_(package) {}
  std::string device() const override { return "cpu"; }
  const Scene& scene() const override { return view_.scene(); }
  const View* view() const override { return &view_; }
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

/// The curve comes first here, so drawing waits for it.
class SoftwareStage : public CpuStage {
 public:
  using CpuStage::CpuStage;
  std::string device() const override { return "software"; }
  void draw(const Camera& camera, const MixSpec& mix, const std::vector<Image>& pages,
            const PictureParams& params, const Progress& progress) override {
    camera_ = camera, mix_ = mix, pages_ = pages, params_ = params, progress_ = progress;
  }
  Image coverage() const override {
    Image coverage;
    view()->render(camera_, mix_, pages_, params_, progress_, &coverage);
    return coverage;
  }
  Image8 toned(const Exposure& exposure, const ToneMapper& mapper) const override {
    const std::vector<Image8> lightmap = tone_lightmap(pages_, exposure, mapper);
    Image8 out{params_.width, params_.height, 3, {}};
    std::vector<float> sum;  // of codes, as a frame buffer that smooths edges adds them
    for (int s = 0; s < params_.samples; ++s) {
      const Image codes =
          fixed_function(view()->hits(camera_, params_, s, progress_), mix_, lightmap, exposure, mapper);
      sum.resize(codes.data.size());
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += codes.data[i];
    }
    const float scale = 255.0f / static_cast<float>(params_.samples);
    for (const float v : sum) out.data.push_back(static_cast<unsigned char>(v * scale + 0.5f));
    return out;
  }

 private:
  Camera camera_;
  MixSpec mix_;
  std::vector<Image> pages_;
  PictureParams params_;
  Progress progress_;
};

bool mirrors_light_fields(const Scene& scene) {
  return scene.has_mirrors() && std::any_of(scene.luminaires.begin(), scene.luminaires.end(),
                                            [](const Luminaire& l) { return l.field != nullptr; });
}

class GlStage : public Stage {
 public:
  GlStage(const Package& package, std::unique_ptr<gpu::Context> context, const std::string& tier)
      : package_(&package),
        context_(std::move(context)),
        tier_(&(tier == "auto" ? gpu::tier_of(context_->capabilities()) : find_shader_tier(tier))),
        shown_(package),
        directional_(package.manifest().basis == Basis::sh1 && shown_.scene.has_normal_maps()),
        layers_(for_tier(read_layers(package, directional_ ? coefficients(Basis::sh1) : 1), *tier_)),
        view_(*context_, shown_, directional_ || mirrors_light_fields(shown_.scene)) {}
  std::string device() const override { return context_->capabilities().renderer; }
  const Scene& scene() const override { return shown_.scene; }
  // Finding a free view needs rays.
  Camera eye_height_camera(const Progress& progress) const override {
    return View(*package_).camera("", progress);
  }
  void draw(const Camera& camera, const MixSpec& mix, const std::vector<Image>& pages,
            const PictureParams& params, const Progress& progress) override {
    check_pages(package_->manifest(), mix, pages);
    if (params.reflections > 0 && scene().has_mirrors()) progress.warn(kNoReflections);
    if (scene().has_panes()) progress.warn(kNoPanes);
    const auto light = gpu::choose_mix(*context_, view_, layers_, *tier_, camera, mix.weights, params);
    gpu::AddedLight* glints[] = {mirrored(mix, params)};
    view_.draw(camera, mix.weights, *light, params, progress,
               {.added = std::span(glints).first(glints[0] != nullptr ? 1 : 0)});
  }
  Image linear() const override { return view_.linear(); }
  Image coverage() const override { return view_.coverage(); }
  Image8 toned(const Exposure& exposure, const ToneMapper& mapper) const override {
    return view_.toned(exposure, mapper);
  }

 private:
  /// What glossy surfaces mirror of light fields; null where there is nothing of that.
  gpu::AddedLight* mirrored(const MixSpec& mix, const PictureParams& params) {
    if (params.reflections == 0 || !scene().has_mirrors()) return nullptr;
    if (near_ == nullptr)
      near_ = std::make_unique<gpu::NearLights>(
          *context_, view_.geometry(), shown_.world.bounds, Lamps(scene(), shown_.world),
          std::span<const std::pair<std::size_t, Rgb>>(), gpu::NearLightParams{.glints = true});
    near_->set_mix(mix.weights);
    return near_->empty() ? nullptr : near_.get();
  }

  const Package* package_;
  std::unique_ptr<gpu::Context> context_;
  const ShaderTier* tier_;
  ShownScene shown_;
  bool directional_;  ///< the lightmap's light sees normal maps
  EncodedLayers layers_;
  gpu::View view_;
  std::unique_ptr<gpu::NearLights> near_;
};

}  // namespace

std::unique_ptr<gpu::Context> open_context(const std::string& device) {
  if (device == "cpu" || device == "software") return nullptr;
  try {
    return std::make_unique<gpu::Context>(gpu::ContextParams{.hardware_only = device == "auto"});
  } catch (const Error&) {
    if (device != "auto") throw;
    return nullptr;
  }
}

std::unique_ptr<Stage> make_stage(const Package& package, const std::string& device, const std::string& tier,
                                  bool reflections) {
  if (device == "software") return std::make_unique<SoftwareStage>(package);
  auto context = open_context(device);
  if (context && device == "auto") {
    const Scene scene = package.scene();
    if ((reflections && scene.has_mirrors()) || scene.has_panes()) context.reset();
  }
  if (context) return std::make_unique<GlStage>(package, std::move(context), tier);
  return std::make_unique<CpuStage>(package);
}

}  // namespace sconce::app
