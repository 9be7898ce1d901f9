// SPDX-License-Identifier: Apache-2.0
// Triangles in, an indexed mesh with normals out.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace sconce::demo {

struct Corner {
  Vec3 p;
  Vec2 uv{0};  ///< metres on the surface
};

/// Collects triangles in parts. Edges within a part that bend less than its crease angle are smooth; parts
/// never share normals. Positions, normals and texture coordinates are rounded to binary fractions when
/// finished, so that the result does not depend on the last bits of sin and cos.
class MeshBuilder {
 public:
  void part(float crease_degrees);
  void triangle(const Corner& a, const Corner& b, const Corner& c);
  /// Counter-clockwise from the front.
  void quad(const Corner& a, const Corner& b, const Corner& c, const Corner& d);
  /// Copies `other`, moved; a mirroring transform turns the faces round so that fronts stay fronts.
  void append(const MeshBuilder& other, const Mat4& transform);
  std::size_t size() const { return faces_.size(); }

  /// @param metres_per_texture  size of one texture repetition; 0 = no texture coordinates
  Mesh finish(std::string name, Id<Material> material, Vec2 metres_per_texture) const;

 private:
  struct Face {
    Corner corner[3];
    uint32_t part;
  };
  std::vector<Face> faces_;
  std::vector<float> creases_;  ///< cosine, per part
};

}  // namespace sconce::demo
