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
  float far = 1e30f;
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

/// Rays against a World, watertight (Embree's robust mode). Surfaces block from both sides; alpha-masked
/// texels do not. Thread-safe. The scene and world must outlive it.
class Tracer {
 public:
  Tracer(const Scene& scene, const World& world);
  ~Tracer();
  Tracer(Tracer&&) noexcept;
  Tracer& operator=(Tracer&&) noexcept;

  /// @pre origin and direction finite (asserted), direction unit
  Hit closest(const Ray& ray) const;
  bool occluded(const Ray& ray) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
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
