// SPDX-License-Identifier: Apache-2.0
// For tests: scenes with a renderer that is known, and its solver.
#pragma once

#include "detect/realtime.h"
#include "detect/synthetic_host.h"
#include "scene/shapes.h"

namespace sconce {

inline TransferParams quick() {
  TransferParams params;
  params.gather = 1024, params.rays = 128, params.lights = 48, params.keep_sums = true, params.cluster = 64;
  return params;
}

/// A box or a ball from the inside, its renderer, and its solver.
struct Rig {
  Scene scene;
  World world;
  Tracer tracer;
  SyntheticHost host;
  Detection detection;
  RealtimeRadiosity radiosity;

  Rig(Scene s, std::vector<SyntheticMaterial> materials, std::vector<SyntheticLamp> lamps,
      const TransferParams& params = quick())
      : scene(std::move(s)),
        world(make_world(scene)),
        tracer(scene, world),
        host{world, std::move(materials)},
        detection(detect_materials(scene, world, host.renderer())),
        radiosity(traced(), vertex_receivers(traced()), cells(), host.renderer(), detection, params) {
    host.lamps = std::move(lamps);
    host.tracer = &tracer;
  }
  TracedScene traced() const { return {scene, world, tracer}; }
  TextureSpace cells() const {
    std::vector<uint32_t> all(world.size());
    for (uint32_t t = 0; t < all.size(); ++t) all[t] = t;
    return face_cells(all, texels_by_area(world, all, 0.1f, 64));
  }
  double mean() const {
    double sum = 0;
    for (const Rgb& light : radiosity.ambient()) sum += static_cast<double>(light.g);
    return sum / static_cast<double>(radiosity.ambient().size());
  }
};

inline Scene room() {
  Scene scene;
  add_box(scene, "room", add_material(scene, "grey", Rgb(0.5f)), Vec3(0), Vec3(1), true);
  return scene;
}

inline Scene ball() {
  Scene scene;
  add_sphere(scene, "shell", add_material(scene, "grey", Rgb(0.5f)), Vec3(0), 1, 12, true);
  return scene;
}

}  // namespace sconce
