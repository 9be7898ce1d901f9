// SPDX-License-Identifier: Apache-2.0
// For tests and benchmarks: scenes made ready to be asked for light.
#pragma once

#include "light/lamp.h"
#include "receive/atlas.h"
#include "scene/groups.h"
#include "scene/shapes.h"

namespace sconce {

/// White, with a red and a green block; dark.
inline Scene coloured_room() {
  Scene scene;
  const auto white = add_material(scene, "white", Rgb(0.7f)),
             red = add_material(scene, "red", Rgb(0.7f, 0.1f, 0.1f)),
             green = add_material(scene, "green", Rgb(0.1f, 0.6f, 0.1f));
  add_box(scene, "room", white, Vec3(-1, 0, -1), Vec3(1, 2, 1), true);
  add_box(scene, "red", red, Vec3(0.1f, 0, -0.6f), Vec3(0.6f, 0.8f, -0.1f), false);
  add_box(scene, "green", green, Vec3(-0.9f, 0, -0.9f), Vec3(-0.3f, 1.2f, -0.5f), false);
  return scene;
}

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
