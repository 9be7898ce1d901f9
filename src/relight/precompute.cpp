// SPDX-License-Identifier: Apache-2.0
#include "relight/precompute.h"

#include <fmt/format.h>

#include <atomic>

#include "core/error.h"
#include "core/hash.h"
#include "core/parallel.h"
#include "gather/row_rays.h"
#include "relight/cloud_square.h"
#include "relight/training_lights.h"
#include "transfer/flatten.h"

namespace sconce {

namespace {

constexpr uint32_t kNodeCluster = 128;
constexpr uint32_t kGatherStream = 0x66696e61u, kBounceStream = 0x626f756eu, kLitStream = 0x6c697470u;

void check(const TransferParams& p) {
  if (!is_power_of_four(p.gather) || p.gather < 256 || p.gather > 65536)
    throw UsageError("option '--gather'", fmt::format("{} samples", p.gather),
                     "a power of four: 256, 1024, 4096, 16384, 65536");
  const auto positive = [](const char* option, int value, int most) {
    if (value < 1 || value > most)
      throw UsageError(fmt::format("option '{}'", option), std::to_string(value),
                       fmt::format("1 to {}", most));
  };
  positive("--rays", p.rays, 1 << 20);
  positive("--cluster", p.cluster, 65536);
  if (p.cluster % 16 != 0)
    throw UsageError("option '--cluster'", std::to_string(p.cluster), "a multiple of 16");
  positive("--lights", p.lights, 4096);
  positive("--coefficients", p.coefficients, 65536);
  positive("--bounce-coefficients", p.bounce_coefficients, 65536);
  positive("--points", p.points, 256);
}

/// Hits of one receiver's rays as a sparse row.
class RowMaker {
 public:
  RowMaker(const View& view, const GatherCloud& cloud, const CloudSquare& square)
      : view_(view), cloud_(cloud), square_(square) {}

  void start() { met_.clear(); }
  /// Sends ray r of the row.
  void shoot(const SurfacePoint& from, uint32_t r, uint32_t stream) {
    const auto sample = follow_row_ray(view_.world(), view_.tracer(), cloud_, from, r, stream,
                                       [](const SurfacePoint&, uint32_t, uint32_t, const Rgb&) {});
    if (sample) met_.push_back(*sample);
  }
  void finish(uint32_t rays, std::vector<SparseEntry>& row) {
    std::sort(met_.begin(), met_.end());
    row.clear();
    for (std::size_t k = 0; k < met_.size();) {
      std::size_t end = k;
      while (end < met_.size() && met_[end] == met_[k]) ++end;
      const std::span<const uint32_t> slots = square_.of(met_[k]);
      const float weight =
          static_cast<float>(end - k) / (static_cast<float>(rays) * static_cast<float>(slots.size()));
      for (const uint32_t slot : slots) row.push_back({slot, weight});
      k = end;
    }
    std::sort(row.begin(), row.end(),
              [](const SparseEntry& a, const SparseEntry& b) { return a.index < b.index; });
  }

 private:
  const View& view_;
  const GatherCloud& cloud_;
  const CloudSquare& square_;
  std::vector<uint32_t> met_;
};

/// Columns become slots >> shift.
std::vector<SparseEntry> coarsened(std::span<const SparseEntry> row, int shift) {
  std::vector<SparseEntry> out;
  for (const SparseEntry& e : row) {
    if (!out.empty() && out.back().index == e.index >> shift)
      out.back().value += e.value;
    else
      out.push_back({e.index >> shift, e.value});
  }
  return out;
}

/// Calls use(block, rows) for blocks of `block` rows that make(i, maker, row) makes.
template <class Make, class Use>
void for_blocks(std::size_t rows, std::size_t block, const RowMaker& prototype, const char* stage,
                const Progress& progress, Make&& make, Use&& use) {
  const std::size_t blocks = (rows + block - 1) / block;
  std::atomic<uint64_t> done = 0;
  progress.at(stage, 0, blocks);
  parallel_for(blocks, 1, [&](std::size_t b) {
    RowMaker maker = prototype;
    std::vector<std::vector<SparseEntry>> made(std::min(block, rows - block * b));
    for (std::size_t r = 0; r < made.size(); ++r) {
      if (r % 64 == 0) progress.check();
      make(block * b + r, maker, made[r]);
    }
    use(b, made);
    progress.at(stage, ++done, blocks);
  });
}

struct OwnedArrays {
  std::vector<OperatorPoint> lit, receivers;
  std::vector<uint32_t> places;
  std::vector<Rgbx> albedo;
};

OperatorPoint pack(const SurfacePoint& p, const Rgb& albedo) {
  return {{p.position.x, p.position.y, p.position.z},
          pack_normal(p.shading_normal),
          pack_normal(p.geometric_normal),
          pack_albedo(albedo)};
}

/// Transforms of the lights' luminance.
std::vector<std::vector<float>> transformed_luminance(const std::vector<std::vector<Rgbx>>& lights) {
  std::vector<std::vector<float>> out(lights.size());
  parallel_for(lights.size(), 1, [&](std::size_t t) {
    for (const Rgbx& l : lights[t]) out[t].push_back(luminance(Rgb(l[0], l[1], l[2])));
    haar_forward(out[t]);
  });
  return out;
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

Operator make_operator(const View& view, const RelightReceivers& receivers, const TransferParams& params,
                       const std::string& scene, const Progress& progress) {
  check(params);
  if (receivers.source.count == 0) throw Error({}, "nothing receives light here");
  const float diagonal = view.world().bounds.diagonal();
  const auto n = static_cast<uint32_t>(params.gather);
  const auto cloud = make_cloud_of(view.scene(), view.world(), view.tracer(), receivers.source, params.gather,
                                   params.seed, progress);
  progress.check();
  const std::vector<uint8_t> seen =
      seen_samples(view.world(), view.tracer(), *cloud, receivers.source, params.seed);
  progress.check();
  const CloudSquare square = make_cloud_square(*cloud, params.gather, seen, diagonal);
  const auto owned = std::make_shared<OwnedArrays>();
  Operator op;

  const auto points = static_cast<uint32_t>(params.points);
  owned->lit.resize(std::size_t{points} * n);
  parallel_for(n, 256, [&](std::size_t slot) {
    light_points(*cloud, square, static_cast<uint32_t>(slot), points, params.seed,
                 &owned->lit[points * slot]);
  });

  const int shift = 4;  // a node for 4 x 4 slots
  const uint32_t nodes = n >> shift, slots_per_node = 1u << shift;
  owned->albedo.resize(nodes);
  for (uint32_t node = 0; node < nodes; ++node) {
    Rgb mean;
    for (uint32_t k = 0; k < slots_per_node; ++k)
      mean += cloud->albedo(square.samples[(node << shift) + k]) / static_cast<float>(slots_per_node);
    owned->albedo[node] = {mean.r, mean.g, mean.b, 0};
  }
  const RowMaker maker(view, *cloud, square);
  const auto node_row = [&](std::size_t node, RowMaker& rows) {
    constexpr uint32_t kRaysPerSlot = 32;
    const uint32_t stream = mix32(mix32(params.seed, kBounceStream), static_cast<uint32_t>(node)),
                   rays = kRaysPerSlot * slots_per_node;
    rows.start();
    for (uint32_t k = 0; k < slots_per_node; ++k) {
      const uint32_t sample = square.samples[(node << shift) + k];
      const Footprint footprint = cloud->footprint(sample);
      for (uint32_t r = k; r < rays; r += slots_per_node)
        rows.shoot(cloud->point(sample, footprint, sobol_pair(r, 0, stream)), r, stream);
    }
    return rays;
  };
  op.lit = owned->lit;
  op.points_per_slot = points;
  std::vector<SurfacePoint> middles(receivers.source.count);
  parallel_for(middles.size(), 256,
               [&](std::size_t i) { middles[i] = receivers.source.footprint(i).sample(Vec2(0.5f)); });
  std::vector<std::vector<Rgbx>> lights =
      training_lights(view, receivers, middles, op, params.lights, params.seed, progress);

  // From slots to nodes, and from nodes to nodes by the same rays.
  op.albedo = owned->albedo;
  {
    const TrainingLight light(transformed_luminance(lights));
    ClusterRowsBuilder first(nodes, light, {kNodeCluster, static_cast<std::size_t>(params.coefficients)});
    std::vector<std::vector<SparseEntry>> coarse(nodes);
    for_blocks(
        nodes, kNodeCluster, maker, "bounce rows", progress,
        [&](std::size_t node, RowMaker& rows, std::vector<SparseEntry>& row) {
          rows.finish(node_row(node, rows), row);
        },
        [&](std::size_t block, std::vector<std::vector<SparseEntry>>& rows) {
          first.set_cluster(block, rows);
          for (std::size_t k = 0; k < rows.size(); ++k)
            coarse[kNodeCluster * block + k] = coarsened(rows[k], shift);
        });
    auto made = first.finish();
    op.first = made.rows;
    op.owners = {owned, made.owner};

    std::vector<std::vector<Rgbx>> once(lights.size());
    parallel_for(lights.size(), 1, [&](std::size_t t) { once[t] = first_bounce(op, lights[t]); });
    const TrainingLight reflected(transformed_luminance(once));
    ClusterRowsBuilder bounce(nodes, reflected,
                              {kNodeCluster, static_cast<std::size_t>(params.bounce_coefficients)});
    parallel_for(bounce.clusters(), 1, [&](std::size_t c) {
      progress.check();
      bounce.set_cluster(
          c, std::span(coarse).subspan(kNodeCluster * c,
                                       std::min<std::size_t>(kNodeCluster, nodes - kNodeCluster * c)));
    });
    made = bounce.finish();
    op.bounce = made.rows;
    op.owners.push_back(made.owner);
  }
  op.sweeps = enough_sweeps(op.bounce, op.albedo);
  progress.check();

  // Receivers see the training lights after all bounces.
  parallel_for(lights.size(), 1, [&](std::size_t t) {
    bounce_light(op, lights[t]);
    haar_inverse(lights[t]);
  });
  const TrainingLight light(transformed_luminance(lights));
  lights.clear();
  const std::vector<uint32_t> order =
      cluster_order(middles, static_cast<std::size_t>(params.cluster), diagonal);
  owned->receivers.resize(order.size());
  owned->places.resize(order.size());
  parallel_for(order.size(), 256, [&](std::size_t i) {
    owned->receivers[i] = pack(middles[order[i]], receivers.albedo(order[i]));
    owned->places[i] = receivers.places[order[i]];
  });
  const auto rays = static_cast<uint32_t>(params.rays);
  ClusterRowsBuilder gather(
      static_cast<uint32_t>(order.size()), light,
      {static_cast<uint32_t>(params.cluster), static_cast<std::size_t>(params.coefficients)});
  for_blocks(
      order.size(), static_cast<std::size_t>(params.cluster), maker, "gather rows", progress,
      [&](std::size_t i, RowMaker& rows, std::vector<SparseEntry>& row) {
        const Footprint footprint = receivers.source.footprint(order[i]);
        const uint32_t stream = mix32(mix32(params.seed, kGatherStream), receivers.places[order[i]]);
        rows.start();
        for (uint32_t r = 0; r < rays; ++r) rows.shoot(footprint.sample(sobol_pair(r, 0, stream)), r, stream);
        rows.finish(rays, row);
      },
      [&](std::size_t cluster, const std::vector<std::vector<SparseEntry>>& rows) {
        gather.set_cluster(cluster, rows);
      });
  auto made = gather.finish();
  op.gather = made.rows;
  op.owners.push_back(made.owner);
  op.kind = receivers.kind;
  op.width = receivers.width, op.height = receivers.height, op.pages = receivers.pages;
  op.camera = receivers.camera.name;
  op.camera_frame = receivers.camera.frame;
  op.camera_yfov = receivers.camera.yfov;
  op.scene = scene;
  op.receivers = owned->receivers;
  op.places = owned->places;
  return op;
}

std::string operator_scene(const Package& package) {
  ContentHash hash;
  for (const char* file : {"scene.glb", "layout.bin"}) {
    const auto it = package.manifest().hashes.find(file);
    hash.text(it != package.manifest().hashes.end() ? it->second : std::string());
  }
  return hash.hex();
}

}  // namespace sconce
