// SPDX-License-Identifier: Apache-2.0
#include "gather/owners.h"

#include <algorithm>
#include <atomic>
#include <nanoflann.hpp>

#include "core/parallel.h"

namespace sconce {

namespace {

constexpr std::size_t kNearest = 8;
constexpr float kLeastShare = 0.125f;
constexpr float kReach = 3;  // spacings

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

bool may_speak(const Tracer& tracer, const SurfacePoint& at, const SurfacePoint& sample, float spacing) {
  return glm::distance(at.position, sample.position) <= kReach * spacing && same_surface(at, sample) &&
         sees(tracer, at, sample);
}

float median(std::vector<float> values) {
  if (values.empty()) return 1;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

Trust trust(const World& world, const Tracer& tracer, const SurfaceCells& cells, uint32_t cell,
            const SurfacePoint& sample) {
  const SurfacePoint middle = cells.middle(world, cell);
  const FootprintPiece piece = cells.piece(world, cell);
  for (const Vec3& corner : {piece.p0, piece.p1, piece.p2}) {
    SurfacePoint p = middle;
    p.position = corner + 0.1f * (middle.position - corner);
    if (!sees(tracer, p, sample)) return Trust::middle;
  }
  return Trust::whole;
}

/// Samples as points (place, scale x normal).
struct Samples::Tree {
  std::vector<std::array<float, 6>> data;
  float scale;
  using Index =
      nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Tree>, Tree, 6, uint32_t>;
  std::unique_ptr<Index> index;

  Tree(std::span<const SurfacePoint> points, float normal_scale) : scale(normal_scale) {
    for (const SurfacePoint& p : points) data.push_back(embed(p));
    index = std::make_unique<Index>(6, *this, nanoflann::KDTreeSingleIndexAdaptorParams(8));
  }
  std::array<float, 6> embed(const SurfacePoint& p) const {
    const Vec3 n = scale * p.shading_normal;
    return {p.position.x, p.position.y, p.position.z, n.x, n.y, n.z};
  }
  std::span<const uint32_t> search(const SurfacePoint& at, std::array<uint32_t, kNearest>& found,
                                   std::size_t count) const {
    float squares[kNearest];
    const std::array<float, 6> query = embed(at);
    return {found.data(), index->knnSearch(query.data(), count, found.data(), squares)};
  }

  std::size_t kdtree_get_point_count() const { return data.size(); }
  float kdtree_get_pt(std::size_t i, std::size_t dim) const { return data[i][dim]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

Samples::Samples(const Tracer& tracer, std::vector<SurfacePoint> points, std::vector<float> spacings)
    : tracer_(tracer),
      points_(std::move(points)),
      spacings_(std::move(spacings)),
      // Normals a right angle apart count as four spacings.
      tree_(std::make_unique<Tree>(points_, 2.8f * median(spacings_))) {}

Samples::~Samples() = default;

bool Samples::fits(const SurfacePoint& at, std::size_t sample) const {
  return may_speak(tracer_, at, points_[sample], spacings_[sample]);
}

std::optional<uint32_t> Samples::find(const SurfacePoint& at) const {
  std::array<uint32_t, kNearest> found;
  for (const uint32_t sample : tree_->search(at, found, kNearest))
    if (fits(at, sample)) return sample;
  return std::nullopt;
}

uint32_t Samples::nearest(const SurfacePoint& at) const {
  std::array<uint32_t, kNearest> found{};
  tree_->search(at, found, 1);
  return found[0];
}

Ownership assign_owners(const World& world, const Tracer& tracer, const SurfaceCells& cells,
                        std::vector<uint32_t> seeds, std::span<const float> spacings,
                        std::span<const float> weights, const Progress& progress, const Ranks& ranks) {
  std::vector<SurfacePoint> points;
  std::vector<float> around;
  for (const uint32_t seed : seeds) {
    points.push_back(cells.middle(world, seed));
    around.push_back(spacings[seed]);
  }
  const Samples first(tracer, points, around);
  std::vector<Owner> owners(cells.size());
  constexpr uint32_t kOrphan = 0xffffffffu;
  constexpr std::size_t kGrain = 256;
  std::atomic<uint64_t> begun = 0;
  parallel_for(cells.size(), kGrain, [&](std::size_t c) {
    if (c % kGrain == 0) {
      progress.check();
      progress.at("gather cloud", begun++, cells.size() / kGrain + 1);
    }
    if (!ranks.mine(c / kGrain)) return;
    const auto cell = static_cast<uint32_t>(c);
    const SurfacePoint at = cells.middle(world, cell);
    if (const auto sample = first.find(at))
      owners[c] = {*sample, trust(world, tracer, cells, cell, first[*sample])};
    else
      owners[c].sample = weights[c] >= kLeastShare ? kOrphan : first.nearest(at);
  });
  ranks.share(std::span(owners), kGrain);
  for (uint32_t s = 0; s < seeds.size(); ++s)
    owners[seeds[s]] = {s, trust(world, tracer, cells, seeds[s], points[s])};

  // Orphans become samples, in order; neighbours in the order are often neighbours in space.
  const std::size_t old = points.size();
  for (uint32_t cell = 0; cell < cells.size(); ++cell) {
    Owner& owner = owners[cell];
    if (owner.sample != kOrphan) continue;
    const SurfacePoint at = cells.middle(world, cell);
    for (std::size_t s = points.size(); s > old && points.size() - s < 4; --s) {
      if (!may_speak(tracer, at, points[s - 1], around[s - 1])) continue;
      owner.sample = static_cast<uint32_t>(s - 1);
      break;
    }
    if (owner.sample == kOrphan) {
      owner.sample = static_cast<uint32_t>(points.size());
      points.push_back(at);
      around.push_back(spacings[cell]);
      seeds.push_back(cell);
    }
    owner.trust = trust(world, tracer, cells, cell, points[owner.sample]);
  }
  return {std::make_unique<Samples>(tracer, std::move(points), std::move(around)), std::move(seeds),
          std::move(owners)};
}

}  // namespace sconce
