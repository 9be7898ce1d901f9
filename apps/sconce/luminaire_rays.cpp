// SPDX-License-Identifier: Apache-2.0
#include "luminaire_rays.h"

#include <algorithm>

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

}  // namespace

LampRays::LampRays(const std::string& file, uint64_t count, uint32_t seed, const Progress& progress)
    : file_(file), traced_(names_scene(file)), once_(progress) {
  if (!traced_) return;
  Scene scene = import_scene(file, progress);
  scene.name = file;
  assign_groups(scene, Grouping::automatic);
  const World world = make_world(scene);
  const Tracer tracer(scene, world);
  const Lamps lamps(scene, world);
  BenchParams params;
  params.rays = count;
  params.seed = seed;
  rays_ = trace_luminaire(scene, world, tracer, lamps, params, progress);
}

void LampRays::each(const std::function<void(std::span<const SourceRay>)>& f) const {
  if (traced_)
    f(rays_);
  else
    luminous_ = read_rays(file_, f, once_).luminous;
  once_.warning = nullptr;
}

}  // namespace sconce::app
