// SPDX-License-Identifier: Apache-2.0
#include "gather/owners.h"

#include <algorithm>
#include <nanoflann.hpp>
#include <optional>

#include "core/parallel.h"

namespace sconce {

namespace {

constexpr std::size_t kNearest = 8;
constexpr float kLeastShare = 0.125f;

/// Samples as points (place, scale x normal).
struct Points {
  std::vector<std::array<float, 6>> data;

  std::size_t kdtree_get_point_count() const { return data.size(); }
  float kdtree_get_pt(std::size_t i, std::size_t dim) const { return data[i][dim]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};
using Tree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Points>, Points, 6, uint32_t>;

std::array<float, 6> embed(const SurfacePoint& p, float scale) {
  const Vec3 n = scale * p.shading_normal;
  return {p.position.x, p.position.y, p.position.z, n.x, n.y, n.z};
}

/// Nothing between two points of a surface that may bulge a little: tested above it.
bool sees(const Tracer& tracer, const SurfacePoint& p, const SurfacePoint& q) {
  const float distance = glm::distance(p.position, q.position);
  if (!(distance > 1e-6f)) return true;
  const float height = 0.25f * distance;
  const auto lift = [&](const SurfacePoint& s, Vec3& top) {
    const Vec3 start = offset_origin(s.position, s.geometric_normal, s.geometric_normal);
    top = start + height * s.geometric_normal;
    return !tracer.occluded({start, s.geometric_normal, height});
  };
  Vec3 a, b;
  if (!lift(p, a) || !lift(q, b)) return false;
  const float across = glm::distance(a, b);
  return !(across > 1e-6f) || !tracer.occluded({a, (b - a) / across, across});
}

/// Points of one continuous surface, as far as place and normals tell.
bool same_surface(const SurfacePoint& p, const SurfacePoint& q) {
  if (glm::dot(p.shading_normal, q.shading_normal) < 0.5f ||
      glm::dot(p.geometric_normal, q.geometric_normal) < 0.5f)
    return false;
  const Vec3 to = q.position - p.position;
  const float most = 0.5f * glm::length(to) + 1e-6f;
  return std::abs(glm::dot(to, p.geometric_normal)) <= most &&
         std::abs(glm::dot(to, q.geometric_normal)) <= most;
}

class Assigner {
 public:
  Assigner(const World& world, const Tracer& tracer, const SurfaceCells& cells,
           std::span<const float> spacings)
      : world_(world), tracer_(tracer), cells_(cells), spacings_(spacings) {}

  bool fits(const SurfacePoint& cell, const SurfacePoint& sample, float spacing) const {
    return glm::distance(cell.position, sample.position) <= 3 * spacing && same_surface(cell, sample) &&
           sees(tracer_, cell, sample);
  }
  /// Whether every corner of a cell that fits sees the sample too.
  Trust trust(uint32_t cell, const SurfacePoint& sample) const {
    const SurfacePoint middle = cells_.middle(world_, cell);
    const FootprintPiece piece = cells_.piece(world_, cell);
    for (const Vec3& corner : {piece.p0, piece.p1, piece.p2}) {
      SurfacePoint p = middle;
      p.position = corner + 0.1f * (middle.position - corner);
      if (!sees(tracer_, p, sample)) return Trust::middle;
    }
    return Trust::whole;
  }
  SurfacePoint middle(uint32_t cell) const { return cells_.middle(world_, cell); }
  float spacing(uint32_t cell) const { return spacings_[cell]; }

 private:
  const World& world_;
  const Tracer& tracer_;
  const SurfaceCells& cells_;
  std::span<const float> spacings_;
};

float median(std::vector<float> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

Ownership assign_owners(const World& world, const Tracer& tracer, const SurfaceCells& cells,
                        std::vector<uint32_t> seeds, std::span<const float> spacings,
                        std::span<const float> weights) {
  const Assigner assigner(world, tracer, cells, spacings);
  std::vector<float> around;
  for (const uint32_t seed : seeds) around.push_back(spacings[seed]);
  // Normals a right angle apart count as four spacings.
  const float scale = around.empty() ? 1 : 2.8f * median(around);
  std::vector<SurfacePoint> samples;
  Points points;
  for (const uint32_t seed : seeds) {
    samples.push_back(assigner.middle(seed));
    points.data.push_back(embed(samples.back(), scale));
  }
  const Tree tree(6, points, nanoflann::KDTreeSingleIndexAdaptorParams(8));

  Ownership result;
  result.owners.resize(cells.size());
  constexpr uint32_t kOrphan = 0xffffffffu;
  parallel_for(cells.size(), 256, [&](std::size_t c) {
    const auto cell = static_cast<uint32_t>(c);
    const SurfacePoint at = assigner.middle(cell);
    const std::array<float, 6> query = embed(at, scale);
    uint32_t found[kNearest];
    float squares[kNearest];
    const std::size_t count = tree.knnSearch(query.data(), kNearest, found, squares);
    uint32_t guess = kOrphan;
    for (std::size_t k = 0; k < count; ++k) {
      const SurfacePoint& sample = samples[found[k]];
      if (seeds[found[k]] == cell || assigner.fits(at, sample, spacings[seeds[found[k]]])) {
        result.owners[c] = {found[k], assigner.trust(cell, sample)};
        return;
      }
      if (guess == kOrphan && glm::dot(at.shading_normal, sample.shading_normal) > 0 &&
          sees(tracer, at, sample))
        guess = found[k];
    }
    if (weights[c] >= kLeastShare)
      guess = kOrphan;
    else if (guess == kOrphan && count > 0)
      guess = found[0];
    result.owners[c] = {guess, Trust::guess};
  });

  // Orphans become samples, in order; neighbours in the order are often neighbours in space.
  std::vector<uint32_t> added;
  for (uint32_t cell = 0; cell < cells.size(); ++cell) {
    if (result.owners[cell].sample != kOrphan) continue;
    const SurfacePoint at = assigner.middle(cell);
    for (std::size_t k = added.size(); k > 0 && added.size() - k < 4 && result.owners[cell].sample == kOrphan;
         --k) {
      const SurfacePoint& sample = samples[added[k - 1]];
      if (assigner.fits(at, sample, spacings[seeds[added[k - 1]]]))
        result.owners[cell] = {added[k - 1], assigner.trust(cell, sample)};
    }
    if (result.owners[cell].sample != kOrphan) continue;
    const auto index = static_cast<uint32_t>(seeds.size());
    result.owners[cell] = {index, assigner.trust(cell, at)};
    seeds.push_back(cell);
    samples.push_back(at);
    added.push_back(index);
  }
  result.seeds = std::move(seeds);
  return result;
}

}  // namespace sconce
