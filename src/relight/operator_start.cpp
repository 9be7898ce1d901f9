// SPDX-License-Identifier: Apache-2.0
#include "relight/operator_start.h"

#include "core/error.h"
#include "core/sobol.h"
#include "relight/row_maker.h"
#include "transfer/flatten.h"

namespace sconce {

namespace {

constexpr uint32_t kLitStream = 0x6c697470u;

struct OwnedPoints {
  std::vector<OperatorPoint> lit, receivers;
  std::vector<uint32_t> places;
};

OperatorPoint pack(const SurfacePoint& p, const Rgb& albedo) {
  return {{p.position.x, p.position.y, p.position.z},
          pack_normal(p.shading_normal),
          pack_normal(p.geometric_normal),
          pack_albedo(albedo)};
}

/// Points of a slot, spread over its sample's cells by area.
void light_points(const GatherCloud& cloud, const CloudSquare& square, uint32_t slot, uint32_t points,
                  uint32_t seed, OperatorPoint* out) {
  const uint32_t sample = square.samples[slot];
  const std::span<const uint32_t> cells = cloud.owned(sample);
  const uint32_t stream = mix32(mix32(seed, kLitStream), sample);
  std::vector<Footprint> footprints;
  double area = 0;
  for (const uint32_t cell : cells) {
    footprints.push_back(cloud.cell_footprint(cell));
    area += static_cast<double>(footprints.back().area);
  }
  for (uint32_t p = 0; p < points; ++p) {
    Vec2 u = sobol_pair(square.copies[slot] * points + p, 0, stream);
    double left = static_cast<double>(u.x) * area;
    std::size_t k = 0;
    while (k + 1 < footprints.size() && left >= static_cast<double>(footprints[k].area))
      left -= static_cast<double>(footprints[k++].area);
    u.x = std::clamp(static_cast<float>(left / static_cast<double>(footprints[k].area)), 0.0f, 0.9999999f);
    out[p] = pack(cloud.point(sample, footprints[k], u), cloud.cell_albedo(cells[k]));
  }
}

}  // namespace

OperatorStart::OperatorStart(const TracedScene& traced, const RelightReceivers& receivers,
                             const TransferParams& params, std::size_t leaf, const Progress& progress) {
  if (receivers.source.count == 0) throw Error({}, "nothing receives light here");
  const float diagonal = traced.world.bounds.diagonal();
  cloud = make_cloud_of(traced.scene, traced.world, traced.tracer, receivers.source, params.gather,
                        params.seed, progress);
  progress.check();
  // Of what may move, all: what is hidden today may be seen then.
  const std::vector<uint8_t> seen =
      params.movable ? std::vector<uint8_t>(cloud->size(), 1)
                     : seen_samples(traced.world, traced.tracer, *cloud, receivers.source, params.seed);
  progress.check();
  square = make_cloud_square(*cloud, params.gather, seen, diagonal);
  place_middles(receivers);
  progress.check();
  order = cluster_order(middles, leaf, diagonal);
  place_points(receivers, params);

  op.kind = receivers.kind;
  op.width = receivers.width, op.height = receivers.height, op.pages = receivers.pages;
  op.camera = receivers.camera.name;
  op.camera_frame = receivers.camera.frame;
  op.camera_yfov = receivers.camera.yfov;
}

void OperatorStart::place_middles(const RelightReceivers& receivers) {
  middles.resize(receivers.source.count);
  parallel_for(middles.size(), 256,
               [&](std::size_t i) { middles[i] = receivers.source.footprint(i).sample(Vec2(0.5f)); });
}

void OperatorStart::place_points(const RelightReceivers& receivers, const TransferParams& params) {
  const auto owned = std::make_shared<OwnedPoints>();
  const auto points = static_cast<uint32_t>(params.points);
  owned->lit.resize(points * params.gather);
  parallel_for(params.gather, 256, [&](std::size_t slot) {
    light_points(*cloud, square, static_cast<uint32_t>(slot), points, params.seed,
                 &owned->lit[points * slot]);
  });
  owned->receivers.resize(order.size());
  owned->places.resize(order.size());
  parallel_for(order.size(), 256, [&](std::size_t i) {
    owned->receivers[i] = pack(middle(i), receivers.albedo(order[i]));
    owned->places[i] = receivers.places[order[i]];
  });
  op.points_per_slot = points;
  op.lit = owned->lit, op.receivers = owned->receivers, op.places = owned->places;
  op.owners = {owned};
}

std::vector<uint32_t> OperatorStart::glossy(const RelightReceivers& receivers) const {
  std::vector<uint32_t> out;
  if (receivers.glossy)
    std::copy_if(order.begin(), order.end(), std::back_inserter(out),
                 [&](uint32_t own) { return receivers.glossy(own).has_value(); });
  return out;
}

Operator OperatorStart::lobes(const Operator& whole, const RelightReceivers& receivers,
                              std::span<const uint32_t> own, const TransferParams& params) const {
  const auto owned = std::make_shared<OwnedPoints>();
  owned->receivers.resize(own.size());
  owned->places.resize(own.size());
  parallel_for(own.size(), 256, [&](std::size_t i) {
    const uint32_t place = receivers.places[own[i]];
    const LobeRays rays(*receivers.glossy(own[i]), place, params.seed);
    owned->receivers[i] = pack(rays.seen.at, rays.albedo(static_cast<uint32_t>(params.rays)));
    owned->places[i] = place;
  });
  Operator out = whole;
  out.kind = OperatorReceivers::lobes;
  out.receivers = owned->receivers, out.places = owned->places;
  out.owners.push_back(owned);
  return out;
}

void OperatorStart::place(const RelightReceivers& receivers, const TransferParams& params) {
  place_middles(receivers);
  place_points(receivers, params);
}

}  // namespace sconce
