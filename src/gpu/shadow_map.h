// SPDX-License-Identifier: Apache-2.0
// What a lamp sees, as depths: one map, a cube, or parallel light fitted to the scene.
#pragma once

#include <optional>

#include "gpu/geometry.h"
#include "gpu/lamp_shader.h"

namespace sconce::gpu {

/// Draws shadow maps, and reads them in gpu/shadow.glsl.
class ShadowMap {
 public:
  /// @param bounds  of the scene
  /// @throws Error when the device allows no such texture
  ShadowMap(const Context& context, const LampShader& lamp, const Bounds& bounds);

  /// @param shader  shadow_program()
  void draw(const Geometry& geometry, const Program& shader) const;
  void bind(const Program& lamp, int unit) const;

 private:
  /// Texels from the world: (x, y, 1) times depth, or (x, y, depth) for parallel light.
  struct Projection {
    Mat3 to_plane{1.0f};
    Mat3 from_plane() const { return Mat3(glm::inverse(glm::dmat3(to_plane))); }
  };
  Projection perspective(const Vec3& right, const Vec3& up, const Vec3& forward, float tangent) const;
  Projection fitted(const Mat4& frame, const Bounds& bounds);

  int side_;
  Vec3 eye_;
  float near_;
  bool parallel_ = false;
  std::vector<Projection> views_;
  std::optional<Texture> depths_;
};

Program shadow_program();

}  // namespace sconce::gpu
