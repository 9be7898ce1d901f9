// SPDX-License-Identifier: Apache-2.0
#include "receive/seams.h"

#include <limits>

#include "receive/mesh_graph.h"
#include "receive/raster.h"

namespace sconce {

namespace {

constexpr int kPasses = 8;
constexpr float kDepth = 0.75f;    // texels from a seam within which both charts share their light
constexpr float kReach = 1.5f;     // texels beyond it that a bilinear look-up from there can meet
constexpr float kSmooth = 0.999f;  // cosine between the normals on both sides
constexpr float kSame = 1e-3f;     // texels between the two sides of an edge that is no border

/// Edge k of a triangle's side, on its page.
struct Border {
  std::size_t triangle;
  uint32_t k;
  bool back;
};

class SeamFinder {
 public:
  SeamFinder(const World& world, const Tracer& tracer, const Atlas& atlas)
      : world_(world),
        tracer_(tracer),
        atlas_(atlas),
        graph_(make_mesh_graph(world)),
        page_texels_(static_cast<std::size_t>(atlas.width) * static_cast<std::size_t>(atlas.height)),
        inside_(page_texels_ * static_cast<std::size_t>(atlas.pages), 0),
        owner_(inside_.size(), 0),
        distance_(inside_.size(), std::numeric_limits<float>::max()),
        nearest_(inside_.size()) {
    for (const bool back : {false, true})
      for (std::size_t t = 0; t < world.size(); ++t) cover(side(t, back));
    for (const bool back : {false, true})
      for (std::size_t t = 0; t < world.size(); ++t)
        for (uint32_t k = 0; k < 3; ++k)
          if (side(t, back).page >= 0 && is_border({t, k, back})) claim({t, k, back});
  }

  /// Calls found(texel, four texels, their shares), by texel.
  template <class F>
  void each(const F& found) const {
    for (std::size_t i = 0; i < inside_.size(); ++i)
      if (distance_[i] < std::numeric_limits<float>::max()) look_beyond(i, nearest_[i], found);
  }

 private:
  const TexelTriangle& side(std::size_t t, bool back) const { return (back ? atlas_.back : atlas_.front)[t]; }
  std::size_t index(int page, int x, int y) const {
    return static_cast<std::size_t>(page) * page_texels_ +
           static_cast<std::size_t>(y) * static_cast<std::size_t>(atlas_.width) + static_cast<std::size_t>(x);
  }
  Vec2 middle(std::size_t i) const {
    const std::size_t at = i % page_texels_, width = static_cast<std::size_t>(atlas_.width);
    return Vec2(static_cast<float>(at % width), static_cast<float>(at / width)) + 0.5f;
  }

  /// Which texels a triangle covers, and which with their middle.
  void cover(const TexelTriangle& t) {
    if (t.page < 0) return;
    const auto cross = [](Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; };
    const float turn = cross(t.uv[1] - t.uv[0], t.uv[2] - t.uv[0]) < 0 ? -1.0f : 1.0f;
    cover_texels(t.uv, atlas_.width, atlas_.height, [&](int x, int y) {
      const std::size_t i = index(t.page, x, y);
      owner_[i] = t.chart + 1;
      const Vec2 p(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
      bool in = true;
      for (std::size_t k = 0; k < 3; ++k)
        in = in && turn * cross(t.uv[(k + 1) % 3] - t.uv[k], p - t.uv[k]) >= 0;
      if (in) inside_[i] = 1;
    });
  }

  /// The same edge as the triangle on its other side has it, by ends of `b`; nothing at borders of the mesh.
  struct Beyond {
    const TexelTriangle* side;
    Vec2 a, b, c;  ///< ends, and the corner that faces the edge
    std::size_t triangle;
    uint32_t opposite;
  };
  std::optional<Beyond> beyond(const Border& border) const {
    const uint32_t mate = graph_.mates[3 * border.triangle + border.k];
    if (mate == MeshGraph::kNone) return std::nullopt;
    const std::size_t t = mate / 3;
    const uint32_t j = mate % 3, next = next_corner(j), last = next_corner(next);
    const TexelTriangle& other = side(t, border.back);
    if (other.page < 0) return std::nullopt;
    return Beyond{&other, other.uv[next], other.uv[j], other.uv[last], t, last};
  }

  bool is_border(const Border& border) const {
    const auto there = beyond(border);
    if (!there) return true;
    const TexelTriangle& here = side(border.triangle, border.back);
    return there->side->page != here.page || glm::distance(there->a, here.uv[border.k]) > kSame ||
           glm::distance(there->b, here.uv[next_corner(border.k)]) > kSame;
  }

  /// Texels outside of all charts, and those right inside, belong to the border that is nearest.
  void claim(const Border& border) {
    const TexelTriangle& t = side(border.triangle, border.back);
    const Vec2 a = t.uv[border.k], b = t.uv[next_corner(border.k)], e = b - a;
    const float squared = glm::dot(e, e);
    if (!(squared > 0)) return;
    const Vec2 lo = glm::min(a, b) - kReach, hi = glm::max(a, b) + kReach;
    const int x1 = std::min(atlas_.width - 1, static_cast<int>(hi.x)),
              y1 = std::min(atlas_.height - 1, static_cast<int>(hi.y));
    for (int y = std::max(0, static_cast<int>(lo.y)); y <= y1; ++y)
      for (int x = std::max(0, static_cast<int>(lo.x)); x <= x1; ++x) {
        const std::size_t i = index(t.page, x, y);
        const Vec2 p = middle(i);
        const float away = glm::distance(p, a + std::clamp(glm::dot(p - a, e) / squared, 0.0f, 1.0f) * e);
        if (away > (inside_[i] != 0 ? kDepth : kReach) || away >= distance_[i]) continue;
        distance_[i] = away;
        nearest_[i] = border;
      }
  }

  /// Whose a texel is, covered or beside a border; + 1.
  uint32_t chart_at(std::size_t i) const {
    if (owner_[i] != 0 || !(distance_[i] <= kReach)) return owner_[i];
    return side(nearest_[i].triangle, nearest_[i].back).chart + 1;
  }

  template <class F>
  void look_beyond(std::size_t i, const Border& border, const F& found) const {
    if (graph_.turn[3 * border.triangle + border.k] < kSmooth) return;
    const auto there = beyond(border);
    if (!there) return;
    const TexelTriangle& here = side(border.triangle, border.back);
    const Vec2 a = here.uv[border.k], e = here.uv[next_corner(border.k)] - a, f = there->b - there->a;
    const float length = glm::length(e), length_there = glm::length(f);
    const Vec2 p = middle(i) - a;
    const float along = glm::dot(p, e) / (length * length), off = (inside_[i] != 0 ? -1.0f : 1.0f) *
                                                                  std::abs(e.x * p.y - e.y * p.x) / length *
                                                                  (length_there / length);
    Vec2 inward(-f.y, f.x);
    if (glm::dot(inward, there->c - there->a) < 0) inward = -inward;
    if (!(length_there > 0) || blocked(border, *there, along)) return;
    const Vec2 q = there->a + along * f + off / length_there * inward;
    const int x = static_cast<int>(std::floor(q.x)), y = static_cast<int>(std::floor(q.y));
    if (x < 0 || y < 0 || x >= atlas_.width || y >= atlas_.height ||
        chart_at(index(there->side->page, x, y)) != there->side->chart + 1)
      return;
    std::array<uint32_t, 4> from{};
    std::array<float, 4> share{};
    const Vec2 low = glm::floor(q - 0.5f), part = q - 0.5f - low;
    for (std::size_t c = 0; c < 4; ++c) {
      const int right = static_cast<int>(c & 1), up = static_cast<int>(c >> 1);
      from[c] = static_cast<uint32_t>(index(there->side->page,
                                            std::clamp(static_cast<int>(low.x) + right, 0, atlas_.width - 1),
                                            std::clamp(static_cast<int>(low.y) + up, 0, atlas_.height - 1)));
      share[c] = (right != 0 ? part.x : 1 - part.x) * (up != 0 ? part.y : 1 - part.y);
    }
    found(static_cast<uint32_t>(i), inside_[i] != 0 ? 0.5f : 0.0f, from, share);
  }

  /// Does something stand on the seam, so that light differs across it? Looks half a texel to both sides.
  bool blocked(const Border& border, const Beyond& there, float along) const {
    const auto corner = [&](std::size_t t, uint32_t k) { return world_.positions[world_.triangles[t].v[k]]; };
    const uint32_t next = next_corner(border.k);
    const Vec3 a = corner(border.triangle, border.k), e = corner(border.triangle, next) - a;
    const float length = glm::length(e);
    const Vec2 flat =
        side(border.triangle, border.back).uv[next] - side(border.triangle, border.back).uv[border.k];
    const float half = 0.5f * length / glm::length(flat);
    const Vec3 place = a + std::clamp(along, 0.01f, 0.99f) * e;
    const auto above = [&](std::size_t t, const Vec3& facing) {
      const Vec3 in = facing - a - glm::dot(facing - a, e) / (length * length) * e;
      const Vec3 normal = border.back ? -world_.face_normals[t] : world_.face_normals[t];
      return place + half * normalize_or(in, Vec3(0)) + half * normal;
    };
    const Vec3 from = above(border.triangle, corner(border.triangle, next_corner(next))),
               to = above(there.triangle, corner(there.triangle, there.opposite));
    const float way = glm::distance(from, to);
    return !(way > 0) || tracer_.occluded({from, (to - from) / way, way});
  }

  const World& world_;
  const Tracer& tracer_;
  const Atlas& atlas_;
  MeshGraph graph_;
  std::size_t page_texels_;
  std::vector<uint8_t> inside_;  ///< per texel: its middle is in a chart
  std::vector<uint32_t> owner_;  ///< chart + 1
  std::vector<float> distance_;  ///< texels from the middle to the nearest border, where that is near
  std::vector<Border> nearest_;
};

}  // namespace

Seams::Seams(const World& world, const Tracer& tracer, const Atlas& atlas) {
  SeamFinder(world, tracer, atlas).each([&](uint32_t at, float own, const auto& from, const auto& share) {
    texels_.push_back({at, own, from, share});
  });
}

void Seams::close(std::vector<Image>& pages) const {
  if (texels_.empty()) return;
  const std::size_t stride = pages.front().stride(), page_texels = pages.front().pixels();
  const auto texel = [&](uint32_t i) { return &pages[i / page_texels].data[i % page_texels * stride]; };
  std::vector<float> next(texels_.size() * stride);
  for (int pass = 0; pass < kPasses; ++pass) {
    std::fill(next.begin(), next.end(), 0.0f);
    for (std::size_t t = 0; t < texels_.size(); ++t)
      for (std::size_t c = 0; c < 4; ++c)
        for (std::size_t channel = 0; channel < stride; ++channel)
          next[t * stride + channel] += texels_[t].share[c] * texel(texels_[t].from[c])[channel];
    for (std::size_t t = 0; t < texels_.size(); ++t)
      for (std::size_t channel = 0; channel < stride; ++channel) {
        float& value = texel(texels_[t].at)[channel];
        value = texels_[t].own * value + (1 - texels_[t].own) * next[t * stride + channel];
      }
  }
}

}  // namespace sconce
