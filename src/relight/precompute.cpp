// SPDX-License-Identifier: Apache-2.0
#include "relight/precompute.h"

#include <fmt/format.h>

#include <atomic>

#include "core/error.h"
#include "core/hash.h"
#include "core/parallel.h"
#include "gather/row_rays.h"
#include "relight/cloud_square.h"
#include "transfer/flatten.h"

namespace sconce {

namespace {

constexpr std::size_t kBlock = WaveletRows::kBlock;
constexpr std::size_t kBlocksPerTask = 16;  // so that scratch is not made for every block
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
  /// @param shift  columns are slots >> shift
  void finish(uint32_t rays, int shift, std::vector<SparseEntry>& row) {
    std::sort(met_.begin(), met_.end());
    entries_.clear();
    for (std::size_t k = 0; k < met_.size();) {
      std::size_t end = k;
      while (end < met_.size() && met_[end] == met_[k]) ++end;
      const std::span<const uint32_t> slots = square_.of(met_[k]);
      const float weight =
          static_cast<float>(end - k) / (static_cast<float>(rays) * static_cast<float>(slots.size()));
      for (const uint32_t slot : slots) entries_.push_back({slot >> shift, weight});
      k = end;
    }
    std::sort(entries_.begin(), entries_.end(),
              [](const SparseEntry& a, const SparseEntry& b) { return a.index < b.index; });
    row.clear();
    for (const SparseEntry& e : entries_) {
      if (!row.empty() && row.back().index == e.index)
        row.back().value += e.value;
      else
        row.push_back(e);
    }
  }

 private:
  const View& view_;
  const GatherCloud& cloud_;
  const CloudSquare& square_;
  std::vector<uint32_t> met_;
  std::vector<SparseEntry> entries_;
};

/// Compresses `rows` rows that make(i, maker, row) makes.
template <class Make>
WaveletRowsBuilder::Result compress(std::size_t rows, uint32_t columns, int coefficients, Weighting weighting,
                                    const RowMaker& prototype, const char* stage, const Progress& progress,
                                    Make&& make) {
  WaveletRowsBuilder builder(static_cast<uint32_t>(rows), columns, static_cast<std::size_t>(coefficients),
                             weighting);
  const std::size_t tasks = (builder.blocks() + kBlocksPerTask - 1) / kBlocksPerTask;
  std::atomic<uint64_t> done = 0;
  progress.at(stage, 0, tasks);
  parallel_for(tasks, 1, [&](std::size_t task) {
    WaveletRowsBuilder::Scratch scratch(builder);
    RowMaker maker = prototype;
    std::vector<std::vector<SparseEntry>> block_rows(kBlock);
    for (std::size_t block = task * kBlocksPerTask;
         block < std::min(builder.blocks(), (task + 1) * kBlocksPerTask); ++block) {
      progress.check();
      const std::size_t first = kBlock * block, count = std::min(kBlock, rows - first);
      for (std::size_t r = 0; r < count; ++r) make(first + r, maker, block_rows[r]);
      builder.set_block(block, std::span(block_rows).first(count), scratch);
    }
    progress.at(stage, ++done, tasks);
  });
  return builder.finish();
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

  int shift = 0;
  for (int side = params.bounce_side; side > 1; side /= 2) shift += 2;
  const uint32_t nodes = n >> shift, slots_per_node = 1u << shift;
  owned->albedo.resize(nodes);
  for (uint32_t node = 0; node < nodes; ++node) {
    Rgb mean;
    for (uint32_t k = 0; k < slots_per_node; ++k)
      mean += cloud->albedo(square.samples[(node << shift) + k]) / static_cast<float>(slots_per_node);
    owned->albedo[node] = {mean.r, mean.g, mean.b, 0};
  }
  const RowMaker maker(view, *cloud, square);
  const uint32_t bounce_rays = std::max(512u, 64 * slots_per_node);
  auto bounce = compress(
      nodes, nodes, params.bounce_coefficients, params.weighting, maker, "bounce rows", progress,
      [&](std::size_t node, RowMaker& rows, std::vector<SparseEntry>& row) {
        const uint32_t stream = mix32(mix32(params.seed, kBounceStream), static_cast<uint32_t>(node));
        rows.start();
        for (uint32_t k = 0; k < slots_per_node; ++k) {
          const uint32_t sample = square.samples[(node << shift) + k];
          const Footprint footprint = cloud->footprint(sample);
          for (uint32_t r = k; r < bounce_rays; r += slots_per_node)
            rows.shoot(cloud->point(sample, footprint, sobol_pair(r, 0, stream)), r, stream);
        }
        rows.finish(bounce_rays, shift, row);
      });
  op.bounce = bounce.rows;
  op.albedo = owned->albedo;
  op.sweeps = enough_sweeps(op.bounce, op.albedo);
  progress.check();

  // Receivers in blocks of neighbours.
  std::vector<SurfacePoint> middles(receivers.source.count);
  parallel_for(middles.size(), 256,
               [&](std::size_t i) { middles[i] = receivers.source.footprint(i).sample(Vec2(0.5f)); });
  const std::vector<uint32_t> order = cluster_order(middles, kBlock, diagonal);
  owned->receivers.resize(order.size());
  owned->places.resize(order.size());
  parallel_for(order.size(), 256, [&](std::size_t i) {
    owned->receivers[i] = pack(middles[order[i]], receivers.albedo(order[i]));
    owned->places[i] = receivers.places[order[i]];
  });
  progress.check();
  const auto rays = static_cast<uint32_t>(params.rays);
  auto gather = compress(order.size(), n, params.coefficients, params.weighting, maker, "gather rows",
                         progress, [&](std::size_t i, RowMaker& rows, std::vector<SparseEntry>& row) {
                           const Footprint footprint = receivers.source.footprint(order[i]);
                           const uint32_t stream =
                               mix32(mix32(params.seed, kGatherStream), receivers.places[order[i]]);
                           rows.start();
                           for (uint32_t r = 0; r < rays; ++r)
                             rows.shoot(footprint.sample(sobol_pair(r, 0, stream)), r, stream);
                           rows.finish(rays, 0, row);
                         });
  op.gather = gather.rows;
  op.kind = receivers.kind;
  op.width = receivers.width, op.height = receivers.height, op.pages = receivers.pages;
  op.camera = receivers.camera.name;
  op.camera_frame = receivers.camera.frame;
  op.camera_yfov = receivers.camera.yfov;
  op.scene = scene;
  op.points_per_slot = points;
  op.lit = owned->lit;
  op.receivers = owned->receivers;
  op.places = owned->places;
  op.owners = {owned, bounce.owner, gather.owner};
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
