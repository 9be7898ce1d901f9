// SPDX-License-Identifier: Apache-2.0
#include "gather/cloud.h"

#include <algorithm>
#include <numeric>

#include "core/parallel.h"
#include "core/sobol.h"
#include "gather/visits.h"

namespace sconce {

namespace {

constexpr std::size_t kSamplesPerPart = 16;

/// Sides whose normals point the same way along the same axis, then a space-filling curve: neighbours in this
/// order are mostly neighbours on a surface.
uint64_t curve_key(const Bounds& bounds, const SurfacePoint& p) {
  const Vec3 n = p.geometric_normal, a = glm::abs(n);
  const int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
  uint64_t key = static_cast<uint64_t>(2 * axis + (n[axis] < 0 ? 1 : 0)) << 60;
  const float scale = 1048575.0f / std::max(1e-6f, bounds.diagonal());
  for (int c = 0; c < 3; ++c) {
    const auto v = static_cast<uint64_t>(std::max(0.0f, (p.position[c] - bounds.lo[c]) * scale));
    for (int b = 0; b < 20; ++b) key |= (v >> b & 1) << (3 * b + c);
  }
  return key;
}

/// Cells that systematic sampling along the curve picks, about `count`, each at most once.
std::vector<uint32_t> pick_seeds(const World& world, const SurfaceCells& cells,
                                 std::span<const float> weights, uint32_t seed) {
  std::vector<uint64_t> keys(cells.size());
  parallel_for(cells.size(), 4096, [&](std::size_t c) {
    keys[c] = curve_key(world.bounds, cells.middle(world, static_cast<uint32_t>(c)));
  });
  std::vector<uint32_t> order(cells.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return keys[a] < keys[b]; });
  std::vector<uint32_t> seeds;
  double sum = 0, next = static_cast<double>(detail::to_unit(mix32(seed, 0x636c6f75u)));
  for (const uint32_t c : order) {
    sum += static_cast<double>(weights[c]);
    if (sum <= next) continue;
    seeds.push_back(c);
    next = std::max(next + 1, std::floor(sum - next) + next);
  }
  if (seeds.empty() && !order.empty()) seeds.push_back(order.front());
  return seeds;
}

}  // namespace

GatherCloud::GatherCloud(const Scene& scene, const World& world, const Tracer& tracer, const Lamps& lamps,
                         const ReceiverSource& receivers, const CloudParams& params, const Progress& progress,
                         const Ranks& ranks)
    : world_(&world) {
  const auto shares = [&](const SurfaceParts& parts, std::size_t rays) {
    return visit_shares(world, tracer, lamps, receivers, parts, rays, params.seed, progress, ranks);
  };
  const SurfaceParts sides = whole_sides(scene, world);
  std::vector<double> mass(2 * world.size());
  const std::vector<double> pilot = shares(sides, 2 * params.samples);
  for (std::size_t s = 0; s < sides.size(); ++s) mass[sides.sides[s]] = pilot[s];
  SurfaceParts parts = make_parts(scene, world, mass, params.samples / kSamplesPerPart);
  mass = shares(parts, 8 * params.samples);
  cells_ = make_cells(world, std::move(parts), mass, params.samples);
  progress.check();

  const double total = std::accumulate(mass.begin(), mass.end(), 0.0);
  std::vector<float> weights(cells_.size()), spacings(cells_.size());
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    const uint32_t part = cells_.part_of[c];
    const double samples = static_cast<double>(params.samples) * mass[part] / total;
    const double n = cells_.cut[part];
    weights[c] = static_cast<float>(samples / (n * n));
    spacings[c] = static_cast<float>(std::sqrt(cells_.parts.area(world, part) / std::max(samples, 1e-9)));
  }
  ownership_ = assign_owners(world, tracer, cells_, pick_seeds(world, cells_, weights, params.seed), spacings,
                             weights, progress, ranks);

  cell_albedos_.resize(cells_.size());
  parallel_for(cells_.size(), 1024, [&](std::size_t i) {
    constexpr uint32_t kPoints = 4;
    const auto cell = static_cast<uint32_t>(i);
    const auto [a, b, c] = cells_.corners(cell);
    for (uint32_t s = 0; s < kPoints; ++s) {
      const Vec2 w = square_to_triangle(sobol_pair(s, 0, mix32(params.seed, cell)));
      cell_albedos_[i] +=
          shade(scene, world, cells_.side(cell) / 2, a + w.x * (b - a) + w.y * (c - a)).base_color;
    }
    cell_albedos_[i] *= 1.0f / kPoints;
  });
  collect();
}

std::vector<uint8_t> GatherCloud::follow(const Tracer& tracer, std::span<Bounds> boxes) {
  const auto inside = [&](const Vec3& p, float more) {
    return std::any_of(boxes.begin(), boxes.end(), [&](const Bounds& box) {
      return glm::all(glm::greaterThanEqual(p, box.lo - more)) &&
             glm::all(glm::lessThanEqual(p, box.hi + more));
    });
  };
  // As far as samples speak, and how high what is between is looked for (owners.cpp).
  constexpr float kReach = 4;
  const Samples& old = *ownership_.samples;
  std::vector<SurfacePoint> points;
  std::vector<float> spacings;
  float reach = 0;
  for (std::size_t s = 0; s < old.size(); ++s) {
    points.push_back(cells_.middle(*world_, ownership_.seeds[s]));
    spacings.push_back(old.spacing(s));
    if (inside(points[s].position, kReach * spacings[s])) reach = std::max(reach, kReach * spacings[s]);
  }
  for (Bounds& box : boxes) box.lo -= reach, box.hi += reach;
  ownership_.samples = std::make_unique<Samples>(tracer, std::move(points), std::move(spacings));
  const Samples& samples = *ownership_.samples;

  parallel_for(cells_.size(), 256, [&](std::size_t c) {
    const auto cell = static_cast<uint32_t>(c);
    const SurfacePoint at = cells_.middle(*world_, cell);
    Owner& owner = ownership_.owners[c];
    if (!inside(at.position, 0) && !inside(samples[owner.sample].position, 0)) return;
    if (ownership_.seeds[owner.sample] != cell && !samples.fits(at, owner.sample)) {
      const auto other = samples.find(at);
      owner.sample = other ? *other : samples.nearest(at);
      if (!other) {
        owner.trust = Trust::guess;
        return;
      }
    }
    owner.trust = trust(*world_, tracer, cells_, cell, samples[owner.sample]);
  });

  const std::vector<uint32_t> first = first_, owned = owned_;
  collect();
  std::vector<uint8_t> changed(samples.size());
  for (std::size_t s = 0; s < changed.size(); ++s) {
    const std::span before(owned.data() + first[s], owned.data() + first[s + 1]), now = this->owned(s);
    changed[s] =
        inside(samples[s].position, 0) || !std::equal(before.begin(), before.end(), now.begin(), now.end());
  }
  return changed;
}

void GatherCloud::collect() {
  const std::size_t n = ownership_.samples->size();
  // Cells in part hidden from their sample (below furniture, beyond a wall) would darken it: where rays end,
  // it is not hidden. They count only for samples that have no others.
  least_.assign(n, Trust::middle);
  for (const Owner& owner : ownership_.owners)
    if (owner.trust == Trust::whole) least_[owner.sample] = Trust::whole;
  first_.assign(n + 1, 0);
  for (const Owner& owner : ownership_.owners)
    if (owner.trust >= least_[owner.sample]) ++first_[owner.sample + 1];
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  owned_.resize(first_.back());
  areas_.assign(n, 0);
  albedos_.assign(n, Rgb());
  std::vector<uint32_t> cursor(first_.begin(), first_.end() - 1);
  shares_ = {};
  double all = 0;
  for (uint32_t c = 0; c < cells_.size(); ++c) {
    const Owner& owner = ownership_.owners[c];
    const float area = cells_.area(*world_, c);
    shares_[static_cast<std::size_t>(owner.trust)] += static_cast<double>(area);
    all += static_cast<double>(area);
    if (owner.trust < least_[owner.sample]) continue;
    owned_[cursor[owner.sample]++] = c;
    areas_[owner.sample] += area;
    albedos_[owner.sample] += area * cell_albedos_[c];
  }
  for (double& share : shares_) share /= std::max(all, 1e-30);
  for (std::size_t i = 0; i < n; ++i) albedos_[i] *= 1 / std::max(areas_[i], 1e-30f);
}

Footprint GatherCloud::cell_footprint(uint32_t cell) const {
  Footprint result;
  result.kind = ReceiverKind::gather;
  result.id = cell;
  result.pieces.push_back(cells_.piece(*world_, cell));
  result.area = cells_.area(*world_, cell);
  return result;
}

Footprint GatherCloud::footprint(std::size_t i) const {
  Footprint result;
  result.kind = ReceiverKind::gather;
  result.id = static_cast<uint32_t>(i);
  double sum = 0;
  for (uint32_t k = first_[i]; k < first_[i + 1]; ++k) {
    result.pieces.push_back(cells_.piece(*world_, owned_[k]));
    sum += static_cast<double>(cells_.area(*world_, owned_[k]));
    result.pieces.back().cumulative = static_cast<float>(sum);
  }
  result.area = static_cast<float>(sum);
  for (FootprintPiece& piece : result.pieces) piece.cumulative /= result.area;
  result.pieces.back().cumulative = 1;
  return result;
}

}  // namespace sconce
