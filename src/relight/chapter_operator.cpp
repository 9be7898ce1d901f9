// SPDX-License-Identifier: Apache-2.0
#include "relight/chapter_operator.h"

#include "relight/cloud_photons.h"
#include "relight/plain_rows.h"

namespace sconce {

namespace {

PlainRows plain(const TransferParams& params, int coefficients) {
  const auto columns = static_cast<uint32_t>(params.gather);
  return {static_cast<std::size_t>(coefficients), squared_weights(columns, params.choice), RowValues::codes};
}

/// M: one product of all bounces.
void make_photon_bounces(const TracedScene& traced, const TransferParams& params, const OperatorStart& start,
                         const TransferWork& work, Operator& op) {
  const auto slots = static_cast<uint32_t>(params.gather);
  work.progress.at("photons", 0, 1);
  const CloudPhotons photons(traced, *start.cloud, start.square, static_cast<std::size_t>(params.photons),
                             params.seed, work.progress);
  const auto albedo = std::make_shared<std::vector<Rgbx>>(slots);
  make_plain_rows(slots, plain(params, params.bounce_coefficients), "bounce rows", work, nullptr, op,
                  op.first, [&](std::size_t slot, std::vector<SparseEntry>& row) {
                    const uint32_t sample = start.square.samples[slot];
                    const SurfacePoint at =
                        start.cloud->point(sample, start.cloud->footprint(sample), Vec2(0.5f));
                    const Rgb tint = photons.row(at, static_cast<std::size_t>(params.nearest), row),
                              out = start.cloud->albedo(sample) * tint;
                    (*albedo)[slot] = {out.r, out.g, out.b, 0};
                  });
  work.ranks.share(std::span(*albedo), kRowsAtATime);
  op.albedo = *albedo;
  op.owners.push_back(albedo);
  op.sweeps = 1;
  // Nothing is reflected after that.
  auto none = WaveletRowsBuilder(slots, slots, 0, {}).finish();
  op.bounce = {slots, ClusterRows::kLanes, none.rows, {}, {}};
  op.owners.push_back(none.owner);
}

}  // namespace

PointFactors::PointFactors(const Tracer& tracer, const Operator& op, std::vector<float> areas)
    : tracer_(tracer), areas_(std::move(areas)) {
  for (std::size_t slot = 0; slot < areas_.size(); ++slot) {
    const OperatorPoint& p = op.lit[op.points_per_slot * slot];
    positions_.emplace_back(p.position[0], p.position[1], p.position[2]);
    normals_.push_back(unpack_normal(p.geometric));
    starts_.push_back(offset_origin(positions_.back(), normals_.back(), normals_.back()));
  }
}

void PointFactors::row(const SurfacePoint& at, std::vector<SparseEntry>& row) const {
  row.clear();
  const Vec3 start = offset_origin(at.position, at.geometric_normal, at.geometric_normal);
  for (uint32_t slot = 0; slot < areas_.size(); ++slot) {
    const Vec3 to = positions_[slot] - at.position;
    const float here = glm::dot(to, at.shading_normal), there = -glm::dot(to, normals_[slot]);
    if (!(here > 0) || !(there > 0) || !(glm::dot(to, at.geometric_normal) > 0)) continue;
    const float square = glm::dot(to, to), area = areas_[slot];
    const Vec3 way = starts_[slot] - start;
    const float distance = glm::length(way);
    if (!(distance > 0) || tracer_.occluded({start, way / distance, distance})) continue;
    row.push_back({slot, here * there / square * area / (kPi * std::max(square, area * kInvPi))});
  }
}

Operator make_chapter_operator(const TracedScene& traced, const RelightReceivers& receivers,
                               const TransferParams& params, const std::string& scene,
                               const TransferWork& work) {
  OperatorStart start(traced, receivers, params, ClusterRows::kLanes, work.progress);
  Operator op = std::move(start.op);
  op.scene = scene;
  make_photon_bounces(traced, params, start, work, op);
  std::vector<float> areas;
  for (const uint32_t sample : start.square.samples)
    areas.push_back(start.cloud->area(sample) / static_cast<float>(start.square.of(sample).size()));
  const PointFactors factors(traced.tracer, op, std::move(areas));
  make_plain_rows(static_cast<uint32_t>(start.order.size()), plain(params, params.coefficients),
                  "gather rows", work, work.state, op, op.gather,
                  [&](std::size_t i, std::vector<SparseEntry>& row) { factors.row(start.middle(i), row); });
  return op;
}

}  // namespace sconce
