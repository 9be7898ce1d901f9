// SPDX-License-Identifier: Apache-2.0
#include "shapes.h"

#include <glm/gtc/matrix_transform.hpp>

namespace sconce::demo {
namespace {

/// Metres on the face of a box that looks along `axis`: horizontal and vertical as one would hang wallpaper.
Vec2 box_uv(const Vec3& p, int axis) {
  if (axis == 0) return {p.z, p.y};
  if (axis == 1) return {p.x, p.z};
  return {p.x, p.y};
}

}  // namespace

void add_box(MeshBuilder& out, Vec3 lo, Vec3 hi, float bevel, unsigned open) {
  out.part(bevel > 0 ? 65.0f : 20.0f);
  const auto is_open = [&](int axis, int side) { return (open >> (2 * axis + side) & 1u) != 0; };
  // The corner of the face that looks along `axis`; the chamfer insets it along the other two axes.
  const auto corner = [&](int axis, const glm::ivec3& side) {
    Vec3 p;
    for (int k = 0; k < 3; ++k) {
      const float inset = k == axis || is_open(k, side[k]) ? 0.0f : bevel;
      p[k] = side[k] ? hi[k] - inset : lo[k] + inset;
    }
    return Corner{p, box_uv(p, axis)};
  };
  const auto face_out = [&](Corner a, Corner b, Corner c, Corner d, const Vec3& outward) {
    if (glm::dot(glm::cross(b.p - a.p, c.p - a.p), outward) < 0) std::swap(b, d);
    out.quad(a, b, c, d);
  };
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (int side = 0; side < 2; ++side) {
      if (is_open(axis, side)) continue;
      glm::ivec3 s;
      s[axis] = side;
      const auto at = [&](int su, int sv) {
        s[u] = su, s[v] = sv;
        return corner(axis, s);
      };
      Vec3 outward(0);
      outward[axis] = side ? 1.0f : -1.0f;
      face_out(at(0, 0), at(1, 0), at(1, 1), at(0, 1), outward);
    }
    if (bevel <= 0) continue;
    // Chamfers along `axis`, between the faces of u and v.
    for (int su = 0; su < 2; ++su)
      for (int sv = 0; sv < 2; ++sv) {
        if (is_open(u, su) || is_open(v, sv)) continue;
        glm::ivec3 s0, s1;
        s0[u] = s1[u] = su, s0[v] = s1[v] = sv, s0[axis] = 0, s1[axis] = 1;
        Vec3 outward(0);
        outward[u] = su ? 1.0f : -1.0f, outward[v] = sv ? 1.0f : -1.0f;
        face_out(corner(u, s0), corner(u, s1), corner(v, s1), corner(v, s0), outward);
      }
  }
  for (int i = 0; bevel > 0 && i < 8; ++i) {
    const glm::ivec3 s(i & 1, i >> 1 & 1, i >> 2 & 1);
    if (is_open(0, s.x) || is_open(1, s.y) || is_open(2, s.z)) continue;
    const Corner a = corner(0, s), b = corner(1, s), c = corner(2, s);
    const Vec3 outward = Vec3(s) * 2.0f - 1.0f;
    if (glm::dot(glm::cross(b.p - a.p, c.p - a.p), outward) > 0)
      out.triangle(a, b, c);
    else
      out.triangle(a, c, b);
  }
}

void add_rectangle(MeshBuilder& out, Vec3 origin, Vec3 u, Vec3 v) {
  out.part(1);
  const float lu = glm::length(u), lv = glm::length(v);
  out.quad({origin, {0, 0}}, {origin + u, {lu, 0}}, {origin + u + v, {lu, lv}}, {origin + v, {0, lv}});
}

void add_wall(MeshBuilder& out, Vec3 origin, Vec3 u, Vec3 v, const std::vector<float>& us,
              const std::vector<float>& vs, const std::function<bool(std::size_t, std::size_t)>& skip) {
  out.part(1);
  const auto at = [&](std::size_t i, std::size_t j) {
    return Corner{origin + us[i] * u + vs[j] * v, {us[i], vs[j]}};
  };
  for (std::size_t j = 0; j + 1 < vs.size(); ++j)
    for (std::size_t i = 0; i + 1 < us.size(); ++i)
      if (!skip || !skip(i, j)) out.quad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
}

template <class V>
std::vector<V> smooth_curve(const std::vector<V>& p, int steps) {
  std::vector<V> out;
  const int n = static_cast<int>(p.size());
  for (int i = 0; i + 1 < n; ++i) {
    const V a = p[std::max(i - 1, 0)], b = p[i], c = p[i + 1], d = p[std::min(i + 2, n - 1)];
    for (int k = 0; k < steps; ++k) {
      const float t = static_cast<float>(k) / static_cast<float>(steps);
      out.push_back(0.5f * (2.0f * b + (c - a) * t + (2.0f * a - 5.0f * b + 4.0f * c - d) * (t * t) +
                            (3.0f * b - a - 3.0f * c + d) * (t * t * t)));
    }
  }
  out.push_back(p.back());
  return out;
}
template std::vector<Vec2> smooth_curve(const std::vector<Vec2>&, int);
template std::vector<Vec3> smooth_curve(const std::vector<Vec3>&, int);

void add_lathe(MeshBuilder& out, const std::vector<Vec2>& profile, int segments, float crease_degrees) {
  std::vector<std::vector<Vec3>> rings;
  for (const Vec2& p : profile) {
    auto& ring = rings.emplace_back();
    for (int k = 0; k < segments; ++k) {
      const float a = 2 * kPi * static_cast<float>(k) / static_cast<float>(segments);
      ring.emplace_back(p.x * std::cos(a), p.y, -p.x * std::sin(a));
    }
  }
  add_loft(out, rings, crease_degrees);
}

void add_loft(MeshBuilder& out, const std::vector<std::vector<Vec3>>& rings, float crease_degrees) {
  out.part(crease_degrees);
  float v0 = 0;
  for (std::size_t r = 0; r + 1 < rings.size(); ++r) {
    const auto &a = rings[r], &b = rings[r + 1];
    const float v1 = v0 + glm::length(b[0] - a[0]);
    float u0 = 0;
    for (std::size_t k = 0; k < a.size(); ++k) {
      const std::size_t next = (k + 1) % a.size();
      const float u1 = u0 + std::max(glm::length(a[next] - a[k]), glm::length(b[next] - b[k]));
      out.quad({a[k], {u0, v0}}, {a[next], {u1, v0}}, {b[next], {u1, v1}}, {b[k], {u0, v1}});
      u0 = u1;
    }
    v0 = v1;
  }
}

void add_tube(MeshBuilder& out, const std::vector<Vec3>& path, float radius, int segments, bool cap_start,
              bool cap_end) {
  std::vector<std::vector<Vec3>> rings;
  Vec3 side = Frame(glm::normalize(path[1] - path[0])).x;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Vec3 before = path[i] - path[i > 0 ? i - 1 : 0],
               after = path[std::min(i + 1, path.size() - 1)] - path[i];
    const Vec3 along =
        normalize_or(normalize_or(before, Vec3(0)) + normalize_or(after, Vec3(0)), Vec3(0, 1, 0));
    side = glm::normalize(side - along * glm::dot(side, along));  // parallel transport: no twist
    const Vec3 other = glm::cross(along, side);
    auto& ring = rings.emplace_back();
    for (int k = 0; k < segments; ++k) {
      const float a = 2 * kPi * static_cast<float>(k) / static_cast<float>(segments);
      ring.push_back(path[i] + radius * (std::cos(a) * side + std::sin(a) * other));
    }
  }
  if (cap_start) rings.insert(rings.begin(), std::vector<Vec3>(rings.front().size(), path.front()));
  if (cap_end) rings.emplace_back(rings.back().size(), path.back());
  add_loft(out, rings, 50);
}

void add_extrusion(MeshBuilder& out, const std::vector<Vec2>& outline, float depth, float bevel) {
  const std::size_t n = outline.size();
  std::vector<std::vector<Vec3>> rings(3);
  Vec2 middle(0);
  for (std::size_t k = 0; k < n; ++k) {
    const Vec2 p = outline[k], a = p - outline[(k + n - 1) % n], b = outline[(k + 1) % n] - p;
    const Vec2 edge = glm::normalize(glm::normalize(a) + glm::normalize(b));
    const Vec2 inner = p + bevel * Vec2(-edge.y, edge.x);
    rings[0].emplace_back(p, 0.0f);
    rings[1].emplace_back(p, depth - bevel);
    rings[2].emplace_back(inner, depth);
    middle += p / static_cast<float>(n);
  }
  add_loft(out, rings, 50);
  out.part(1);
  for (std::size_t k = 0; k < n; ++k) {
    const Vec3 a = rings[2][k], b = rings[2][(k + 1) % n];
    out.triangle({Vec3(middle, depth), middle}, {a, Vec2(a)}, {b, Vec2(b)});
  }
}

void add_sheet(MeshBuilder& out, int nu, int nv, const std::function<Vec3(float, float)>& at, Vec2 size,
               float crease_degrees) {
  out.part(crease_degrees);
  const auto corner = [&](int i, int j) {
    const Vec2 t(static_cast<float>(i) / static_cast<float>(nu),
                 static_cast<float>(j) / static_cast<float>(nv));
    return Corner{at(t.x, t.y), t * size};
  };
  for (int j = 0; j < nv; ++j)
    for (int i = 0; i < nu; ++i)
      out.quad(corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1));
}

void add_disk(MeshBuilder& out, float radius, int segments) {
  out.part(1);
  const auto rim = [&](int k) {
    const float a = 2 * kPi * static_cast<float>(k) / static_cast<float>(segments);
    const Vec3 p(radius * std::cos(a), 0, -radius * std::sin(a));
    return Corner{p, {p.x, p.z}};
  };
  for (int k = 0; k < segments; ++k) out.triangle({Vec3(0), {0, 0}}, rim(k), rim(k + 1));
}

Mat4 move(Vec3 by) {
  return glm::translate(Mat4(1.0f), by);
}
Mat4 scale(Vec3 by) {
  return glm::scale(Mat4(1.0f), by);
}
Mat4 turn(float degrees, Vec3 axis) {
  return glm::rotate(Mat4(1.0f), degrees * kPi / 180, axis);
}

}  // namespace sconce::demo
