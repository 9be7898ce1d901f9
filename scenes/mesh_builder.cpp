// SPDX-License-Identifier: Apache-2.0
#include "mesh_builder.h"

#include <array>
#include <map>
#include <tuple>
#include <utility>

namespace sconce::demo {
namespace {

constexpr float kPositionGrid = 65536, kNormalGrid = 4096, kTexcoordGrid = 4096;
constexpr float kLeastArea = 1e-9f;  ///< square metres, twice that of the triangle

using Key3 = std::array<int32_t, 3>;

Key3 on_grid(const Vec3& v, float grid) {
  return {static_cast<int32_t>(std::lround(v.x * grid)), static_cast<int32_t>(std::lround(v.y * grid)),
          static_cast<int32_t>(std::lround(v.z * grid))};
}

Vec3 off_grid(const Key3& k, float grid) {
  return Vec3(static_cast<float>(k[0]), static_cast<float>(k[1]), static_cast<float>(k[2])) / grid;
}

}  // namespace

void MeshBuilder::part(float crease_degrees) {
  creases_.push_back(std::cos(crease_degrees * kPi / 180));
}

void MeshBuilder::triangle(const Corner& a, const Corner& b, const Corner& c) {
  const Key3 ka = on_grid(a.p, kPositionGrid), kb = on_grid(b.p, kPositionGrid),
             kc = on_grid(c.p, kPositionGrid);
  if (ka == kb || kb == kc || kc == ka) return;
  if (creases_.empty()) part(30);
  faces_.push_back({{a, b, c}, static_cast<uint32_t>(creases_.size() - 1)});
}

void MeshBuilder::quad(const Corner& a, const Corner& b, const Corner& c, const Corner& d) {
  triangle(a, b, c);
  triangle(a, c, d);
}

void MeshBuilder::append(const MeshBuilder& other, const Mat4& transform) {
  const auto base = static_cast<uint32_t>(creases_.size());
  creases_.insert(creases_.end(), other.creases_.begin(), other.creases_.end());
  const bool mirrored = glm::determinant(Mat3(transform)) < 0;
  for (Face face : other.faces_) {
    for (Corner& corner : face.corner) corner.p = Vec3(transform * glm::vec4(corner.p, 1.0f));
    if (mirrored) std::swap(face.corner[1], face.corner[2]);
    face.part += base;
    faces_.push_back(face);
  }
}

Mesh MeshBuilder::finish(std::string name, Id<Material> material, Vec2 metres_per_texture) const {
  const bool textured = metres_per_texture.x > 0;
  std::map<std::pair<uint32_t, Key3>, std::vector<uint32_t>> around;
  std::vector<std::array<Key3, 3>> keys(faces_.size());
  std::vector<Vec3> areas(faces_.size());
  for (uint32_t f = 0; f < faces_.size(); ++f) {
    Vec3 p[3];
    for (int k = 0; k < 3; ++k) {
      keys[f][k] = on_grid(faces_[f].corner[k].p, kPositionGrid);
      p[k] = off_grid(keys[f][k], kPositionGrid);
      around[{faces_[f].part, keys[f][k]}].push_back(f);
    }
    areas[f] = glm::cross(p[1] - p[0], p[2] - p[0]);
  }

  Mesh mesh;
  mesh.name = std::move(name);
  mesh.material = material;
  if (textured) mesh.texcoords.emplace_back();
  std::map<std::tuple<Key3, Key3, std::array<int32_t, 2>>, uint32_t> vertices;
  for (uint32_t f = 0; f < faces_.size(); ++f) {
    const Vec3 own = normalize_or(areas[f], Vec3(0));
    if (glm::length(areas[f]) < kLeastArea) continue;
    Triangle triangle;
    for (int k = 0; k < 3; ++k) {
      Vec3 sum(0);
      for (const uint32_t other : around[{faces_[f].part, keys[f][k]}])
        if (glm::dot(own, normalize_or(areas[other], Vec3(0))) >= creases_[faces_[f].part] - 1e-4f)
          sum += areas[other];
      const Key3 normal = on_grid(normalize_or(sum, own), kNormalGrid);
      const Vec2 uv = textured ? faces_[f].corner[k].uv / metres_per_texture : Vec2(0);
      const std::array<int32_t, 2> texcoord{static_cast<int32_t>(std::lround(uv.x * kTexcoordGrid)),
                                            static_cast<int32_t>(std::lround(uv.y * kTexcoordGrid))};
      const auto [at, fresh] =
          vertices.try_emplace({keys[f][k], normal, texcoord}, static_cast<uint32_t>(mesh.positions.size()));
      if (fresh) {
        mesh.positions.push_back(off_grid(keys[f][k], kPositionGrid));
        mesh.normals.push_back(glm::normalize(off_grid(normal, kNormalGrid)));
        if (textured) mesh.texcoords[0].push_back(Vec2(texcoord[0], texcoord[1]) / kTexcoordGrid);
      }
      triangle.v[k] = at->second;
    }
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

}  // namespace sconce::demo
