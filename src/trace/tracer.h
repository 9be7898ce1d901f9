// SPDX-License-Identifier: Apache-2.0
// Rays. The only place that names Embree.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "core/receiver.h"
#include "scene/world.h"

namespace sconce {

struct Ray {
  Vec3 origin;
  Vec3 direction;  ///< unit
  float far = 1e30f, near = 0;
};

struct Hit {
  static constexpr uint32_t kMiss = 0xffffffffu;
  uint32_t triangle = kMiss;  ///< of the World
  Vec2 barycentric{0};        ///< weights of vertices 1 and 2
  float distance = 0;
  bool back = false;  ///< the ray came from behind the face

  explicit operator bool() const { return triangle != kMiss; }
};

/// Where a ray ended, on the side that it came from.
inline SurfacePoint surface_point(const World& world, const Hit& hit) {
  const float side = hit.back ? -1.0f : 1.0f;
  return {world.position(hit.triangle, hit.barycentric), side * world.normal(hit.triangle, hit.barycentric),
          side * world.face_normals[hit.triangle]};
}

/// Where light on its way along a ray ended, and what came through the panes before that.
struct Passage {
  Hit hit;
  Rgb factor{1.0f};
};

/// Rays against a World, watertight (Embree's robust mode). Surfaces block from both sides; alpha-masked
/// texels do not. Panes are surfaces that light may pass (Scene::passes). Thread-safe. The scene and world
/// must outlive it.
class Tracer {
 public:
  Tracer(const Scene& scene, const World& world);
  ~Tracer();
  Tracer(Tracer&&) noexcept;
  Tracer& operator=(Tracer&&) noexcept;

  /// @pre origin and direction finite (asserted), direction unit
  /// Panes are surfaces like others to these two.
  Hit closest(const Ray& ray) const;
  bool occluded(const Ray& ray) const;

  bool has_panes() const { return panes_; }
  /// Of a surface that was hit: nothing passes but panes.
  Passing passing(const Hit& hit) const { return panes_ ? passing_pane(hit) : Passing(); }
  /// The rest of a ray behind what it hit; distances are still counted from its origin.
  Ray beyond(const Ray& ray, const Hit& hit) const;
  /// Share of the light that gets from one end of a ray to the other: the product of all panes between.
  Rgb transmittance(const Ray& ray) const {
    if (!occluded(ray)) return Rgb(1.0f);
    return panes_ ? through_panes(ray) : Rgb(0.0f);
  }
  /// The closest hit, where each pane on the way lets the ray pass or ends it by chance, in proportion to
  /// what passes.
  /// @param random  asked for a number in [0, 1) where there are panes
  template <class Random>
  Passage follow(const Ray& ray, Random&& random) const {
    const Hit hit = closest(ray);
    if (!panes_ || !hit) return {hit};
    return onwards(ray, hit, random());
  }

 private:
  struct State;
  Passing passing_pane(const Hit& hit) const;
  Rgb through_panes(Ray ray) const;
  Passage onwards(Ray ray, Hit hit, float u) const;

  std::unique_ptr<State> state_;
  bool panes_ = false;
};

/// A scene made ready for rays. What it refers to must outlive it.
struct TracedScene {
  const Scene& scene;
  const World& world;
  const Tracer& tracer;
};

/// Instruction set that Embree's kernels run on here. Same binary and same ISA give the same bits.
std::string isa();

/// Start of a ray that leaves a surface: moved off along the face normal (towards `direction`) by a few ulps
/// of the coordinates, so that the ray does not meet its own surface again.
Vec3 offset_origin(const Vec3& position, const Vec3& face_normal, const Vec3& direction);

}  // namespace sconce
