// SPDX-License-Identifier: Apache-2.0
#include "detect/ambient_map.h"

namespace sconce {

namespace {

Atlas one_atlas(const TracedScene& traced, float density) {
  AtlasParams params;
  params.density = density;
  return make_atlas(traced.scene, traced.world, traced.tracer, params);
}

}  // namespace

AmbientMap::AmbientMap(Scene scene, float density)
    : scene_(std::move(scene)),
      world_(make_world(scene_)),
      tracer_(scene_, world_),
      traced_{scene_, world_, tracer_},
      atlas_(one_atlas(traced_, density)),
      space_(atlas_space(atlas_)) {}

std::vector<std::array<Vec2, 3>> AmbientMap::coordinates() const {
  std::vector<std::array<Vec2, 3>> all(world_.size(), {Vec2(0), Vec2(0), Vec2(0)});
  const Vec2 whole(static_cast<float>(space_.width), static_cast<float>(space_.height));
  for (std::size_t i = 0; i < space_.triangles.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) all[space_.triangles[i]][c] = space_.corners[i][c] / whole;
  return all;
}

void AmbientMap::start(const HostRenderer& host, TransferParams params, const Progress& progress) {
  params.keep_sums = true;
  detection_ = detect_materials(scene_, world_, host);
  radiosity_ = std::make_unique<RealtimeRadiosity>(traced_, texel_receivers(traced_, atlas_), space_, host,
                                                   detection_, params, progress);
}

}  // namespace sconce
