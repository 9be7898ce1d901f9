// SPDX-License-Identifier: Apache-2.0
#include "luminaire_rays.h"

#include <algorithm>

#include "core/error.h"
#include "core/text.h"
#include "import/import.h"
#include "measure/virtual_bench.h"
#include "scene/groups.h"

namespace sconce::app {

namespace {

bool names_scene(const std::string& file) {
  const std::filesystem::path path = file;
  return lower(path.filename().string()) == "structure.xml" ||  // of an L3D
         std::ranges::find(scene_endings(), lower(path.extension().string())) != scene_endings().end();
}

Scene grouped(Scene scene, const std::string& file) {
  scene.name = file;
  assign_groups(scene, Grouping::automatic);
  return scene;
}

}  // namespace

struct LampRays::Model {
  Model(const std::string& file, const Progress& progress)
      : scene(grouped(import_scene(file, progress), file)),
        world(make_world(scene)),
        tracer(scene, world),
        lamps(scene, world) {}

  Scene scene;
  World world;
  Tracer tracer;
  Lamps lamps;
  BenchParams params;
};

LampRays::LampRays(const std::string& file, double count, int seed, const Progress& progress)
    : file_(file), once_(progress) {
  if (!(count >= 1 && count <= 2e9)) throw UsageError("--rays", "is out of range", "1 to 2000000000");
  if (!names_scene(file)) return;
  auto model = std::make_unique<Model>(file, progress);
  model->params.rays = static_cast<uint64_t>(count);
  model->params.seed = static_cast<uint32_t>(seed);
  model_ = std::move(model);
}

LampRays::~LampRays() = default;

void LampRays::each(const std::function<void(std::span<const SourceRay>)>& f) const {
  if (!kept_.empty())
    f(kept_);
  else if (model_ != nullptr)
    trace_luminaire(model_->scene, model_->world, model_->tracer, model_->lamps, model_->params, f, once_);
  else
    luminous_ = read_rays(file_, f, once_).luminous;
  once_.warning = nullptr;
}

void LampRays::keep() {
  if (model_ == nullptr) return;
  std::vector<SourceRay> rays;
  each([&](std::span<const SourceRay> some) { rays.insert(rays.end(), some.begin(), some.end()); });
  kept_ = std::move(rays);
}

void add_bench(Options& options, double& count, int& seed) {
  options.option("--rays", &count, "that a scene's lamps send out");
  options.option("--seed", &seed, "random seed of a scene's rays");
}

}  // namespace sconce::app
