// SPDX-License-Identifier: Apache-2.0
// For tests and benchmarks: scenes made ready to be asked for light.
#pragma once

#include "light/lamp.h"
#include "receive/atlas.h"
#include "scene/groups.h"

namespace sconce {

/// Members refer to each other, so it stays where it is.
struct LitScene {
  Scene scene;
  World world;
  Tracer tracer;
  Lamps lamps;

  LitScene(Scene s, Grouping grouping)
      : scene((assign_groups(s, grouping), std::move(s))),
        world(make_world(scene)),
        tracer(scene, world),
        lamps(scene, world) {}
  LitScene(const LitScene&) = delete;
  LitScene& operator=(const LitScene&) = delete;
};

/// With a lightmap. @param page  texels
struct LitAtlas : LitScene {
  Atlas atlas;
  TexelReceivers receivers;

  LitAtlas(Scene s, Grouping grouping, int page)
      : LitScene(std::move(s), grouping), atlas(make(*this, page)), receivers(world, tracer, atlas) {}

 private:
  static Atlas make(const LitScene& lit, int page) {
    AtlasParams params;
    params.page_size = page;
    return make_atlas(lit.scene, lit.world, lit.tracer, params);
  }
};

}  // namespace sconce
