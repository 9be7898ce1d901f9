// SPDX-License-Identifier: Apache-2.0
#include "receive/clip.h"

#include <algorithm>

#include "receive/mesh_graph.h"

namespace sconce {

namespace {

struct Corner {
  Vec2 uv;
  Vec3 weights;  // of the triangle's corners
};

/// A triangle clipped by four half planes has at most seven corners.
struct Polygon {
  std::array<Corner, 8> corners;
  std::size_t size = 0;
  void add(const Corner& c) {
    if (size < corners.size()) corners[size++] = c;
  }
};

/// Sutherland-Hodgman, one half plane: sign * (coordinate - limit) >= 0.
Polygon clip(const Polygon& in, int axis, float limit, float sign) {
  Polygon out;
  for (std::size_t i = 0; i < in.size; ++i) {
    const Corner &a = in.corners[i], &b = in.corners[i + 1 == in.size ? 0 : i + 1];
    const float da = sign * (a.uv[axis] - limit), db = sign * (b.uv[axis] - limit);
    if (da >= 0) out.add(a);
    if ((da > 0 && db < 0) || (da < 0 && db > 0)) {
      const float s = da / (da - db);
      out.add({a.uv + s * (b.uv - a.uv), a.weights + s * (b.weights - a.weights)});
    }
  }
  return out;
}

struct Side {
  std::array<Vec3, 3> positions, normals;
  Vec3 geometric;

  Side(const World& world, uint32_t side) {
    const uint32_t t = side / 2;
    const float sign = (side & 1) != 0 ? -1.0f : 1.0f;
    geometric = sign * world.face_normals[t];
    for (std::size_t k = 0; k < 3; ++k) {
      positions[k] = world.positions[world.triangles[t].v[k]];
      normals[k] = sign * corner_normal(world, t, k);
    }
  }
  Vec3 position(const Vec3& w) const { return w.x * positions[0] + w.y * positions[1] + w.z * positions[2]; }
  Vec3 normal(const Vec3& w) const { return w.x * normals[0] + w.y * normals[1] + w.z * normals[2]; }

  FootprintPiece piece(const Vec3& a, const Vec3& b, const Vec3& c) const {
    FootprintPiece p;
    p.p0 = position(a), p.p1 = position(b), p.p2 = position(c);
    p.n0 = normal(a), p.n1 = normal(b), p.n2 = normal(c);
    p.geometric_normal = geometric;
    p.cumulative = 0.5f * glm::length(glm::cross(p.p1 - p.p0, p.p2 - p.p0));
    return p;
  }
};

}  // namespace

void clip_to_rect(const World& world, const Atlas& atlas, std::span<const uint32_t> sides,
                  const TexelRect& rect, std::vector<FootprintPiece>& pieces) {
  for (const uint32_t side : sides) {
    const auto& uv = side_of(atlas, side).uv;
    Polygon polygon;
    polygon.add({uv[0], Vec3(1, 0, 0)});
    polygon.add({uv[1], Vec3(0, 1, 0)});
    polygon.add({uv[2], Vec3(0, 0, 1)});
    polygon = clip(polygon, 0, rect.lo.x, 1.0f);
    polygon = clip(polygon, 0, rect.hi.x, -1.0f);
    polygon = clip(polygon, 1, rect.lo.y, 1.0f);
    polygon = clip(polygon, 1, rect.hi.y, -1.0f);
    if (polygon.size < 3) continue;
    const Side source(world, side);
    for (std::size_t i = 2; i < polygon.size; ++i) {
      const FootprintPiece piece = source.piece(polygon.corners[0].weights, polygon.corners[i - 1].weights,
                                                polygon.corners[i].weights);
      if (piece.cumulative > 0) pieces.push_back(piece);
    }
  }
}

float finish(std::vector<FootprintPiece>& pieces) {
  double total = 0;
  for (const FootprintPiece& piece : pieces) total += static_cast<double>(piece.cumulative);
  double sum = 0;
  for (FootprintPiece& piece : pieces) {
    sum += static_cast<double>(piece.cumulative);
    piece.cumulative = static_cast<float>(sum / total);
  }
  if (!pieces.empty()) pieces.back().cumulative = 1;
  return static_cast<float>(total);
}

FootprintPiece whole_side(const World& world, uint32_t side) {
  return Side(world, side).piece(Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1));
}

}  // namespace sconce
