// SPDX-License-Identifier: Apache-2.0
#include "relight/precompute.h"

#include <fmt/format.h>

#include "core/error.h"
#include "core/hash.h"
#include "gather/row_rays.h"
#include "relight/chapter_operator.h"
#include "relight/operator_start.h"
#include "relight/training_lights.h"

namespace sconce {

namespace {

// Slots that share a basis: for direct light, which differs from one to the next, and for what was reflected
// and is even. The latter's number of bases is the order of FoldedBounces' matrix.
constexpr uint32_t kFirstCluster = 256, kBounceCluster = 2048;
constexpr uint32_t kGatherStream = 0x66696e61u, kBounceStream = 0x626f756eu;

/// Hits of one receiver's rays as a sparse row.
class RowMaker {
 public:
  /// @param transmission  per Scene material, or empty
  RowMaker(const TracedScene& traced, const GatherCloud& cloud, const CloudSquare& square,
           std::span<const float> transmission)
      : traced_(traced), cloud_(cloud), square_(square), transmission_(transmission) {}

  void start() { met_.clear(); }
  /// Sends ray r of the row, and through what lets it through.
  void shoot(const SurfacePoint& from, uint32_t r, uint32_t stream) {
    constexpr uint32_t kMostPanes = 8, kPanePair = 32, kTintPair = 48;  // pairs that no step of a ray uses
    auto ray = row_ray(from, r, 0, stream);
    for (uint32_t pane = 0; ray && pane <= kMostPanes; ++pane) {
      const Passage met = follow_row_panes(traced_.tracer, *ray, r, 0, stream ^ pane);
      const Hit& hit = met.hit;
      const auto end = follow_row_hit(traced_.world, traced_.tracer, cloud_, met, r, stream,
                                      [](const SurfacePoint&, uint32_t, uint32_t, const Rgb&) {});
      // Rows are without colour: what is tinted counts by its mean.
      if (end && (end->tint == Rgb(1) ||
                  sobol_pair(r, kTintPair + pane, stream).x < (end->tint.r + end->tint.g + end->tint.b) / 3))
        met_.push_back(end->sample);
      if (!hit || transmission_.empty() ||
          !(sobol_pair(r, kPanePair + pane, stream).x <
            transmission_[traced_.world.materials[hit.triangle].value]))
        return;
      const SurfacePoint at = surface_point(traced_.world, hit);
      ray->origin = offset_origin(at.position, at.geometric_normal, ray->direction);
    }
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
  const TracedScene& traced_;
  const GatherCloud& cloud_;
  const CloudSquare& square_;
  std::span<const float> transmission_;
  std::vector<uint32_t> met_;
};

/// Transforms of the lights' luminance.
std::vector<std::vector<float>> transformed_luminance(std::span<const std::vector<Rgbx>> lights) {
  std::vector<std::vector<float>> out(lights.size());
  parallel_for(lights.size(), 1, [&](std::size_t t) {
    for (const Rgbx& l : lights[t]) out[t].push_back(luminance(Rgb(l[0], l[1], l[2])));
    haar_forward(out[t]);
  });
  return out;
}

/// Rows of a cluster, one after the other.
template <class Make>
std::vector<std::vector<SparseEntry>> make_rows(const RowMaker& prototype, std::size_t first,
                                                std::size_t count, const Progress& progress, Make&& make) {
  RowMaker maker = prototype;
  std::vector<std::vector<SparseEntry>> rows(count);
  for (std::size_t r = 0; r < count; ++r) {
    if (r % 64 == 0) progress.check();
    make(first + r, maker, rows[r]);
  }
  return rows;
}

/// Clusters that ranks made, to all of them.
void share(ClusterRowsBuilder& builder, const Ranks& ranks) {
  ranks.share(
      builder.clusters(), [&](std::size_t c, std::string& bytes) { builder.pack(c, bytes); },
      [&](std::size_t c, std::string_view& bytes) { builder.unpack(c, bytes); });
}

/// The cloud's own light: `first` and `bounce`, their albedos and sweeps.
/// @param lights  per lamp: b_d per slot
void make_bounces(const TracedScene& traced, const TransferParams& params, const OperatorStart& start,
                  std::span<const std::vector<Rgbx>> lights, const TransferWork& work, Operator& op) {
  const auto slots = static_cast<uint32_t>(params.gather);
  const auto albedo = std::make_shared<std::vector<Rgbx>>(slots);
  for (uint32_t slot = 0; slot < slots; ++slot) {
    const Rgb& a = start.cloud->albedo(start.square.samples[slot]);
    (*albedo)[slot] = {a.r, a.g, a.b, 0};
  }
  op.albedo = *albedo;
  op.owners.push_back(albedo);

  const RowMaker maker(traced, *start.cloud, start.square, params.transmission);
  const auto slot_row = [&](std::size_t slot, RowMaker& rows, std::vector<SparseEntry>& row) {
    constexpr uint32_t kRays = 32;
    const uint32_t stream = mix32(mix32(params.seed, kBounceStream), static_cast<uint32_t>(slot)),
                   sample = start.square.samples[slot];
    const Footprint footprint = start.cloud->footprint(sample);
    rows.start();
    for (uint32_t r = 0; r < kRays; ++r)
      rows.shoot(start.cloud->point(sample, footprint, sobol_pair(r, 0, stream)), r, stream);
    rows.finish(kRays, row);
  };
  constexpr std::size_t kRowBlock = 256;
  std::vector<std::vector<SparseEntry>> rows(slots);
  const std::size_t blocks = (slots + kRowBlock - 1) / kRowBlock;
  for_blocks(blocks, "bounce rows", work, [&](std::size_t block) {
    auto made = make_rows(maker, kRowBlock * block, std::min(kRowBlock, slots - kRowBlock * block),
                          work.progress, slot_row);
    std::move(made.begin(), made.end(), rows.begin() + static_cast<std::ptrdiff_t>(kRowBlock * block));
  });
  const auto rows_of = [&](std::size_t block) {
    return std::span(rows).subspan(kRowBlock * block, std::min(kRowBlock, slots - kRowBlock * block));
  };
  work.ranks.share(
      blocks,
      [&](std::size_t block, std::string& bytes) {
        for (const std::vector<SparseEntry>& row : rows_of(block)) put_vector(bytes, row);
      },
      [&](std::size_t block, std::string_view& bytes) {
        for (std::vector<SparseEntry>& row : rows_of(block)) take_vector(bytes, row);
      });
  // The same rows twice: for direct light, whose edges are sharp, and for what was reflected and is even.
  const auto fit = [&](std::span<const std::vector<Rgbx>> lit, uint32_t cluster, int coefficients,
                       ClusterRows& out) {
    const TrainingLight light(transformed_luminance(lit));
    ClusterRowsBuilder builder(slots, light,
                               {cluster, static_cast<std::size_t>(coefficients), params.keep_sums});
    for_blocks(builder.clusters(), "bounces", work, [&](std::size_t c) {
      const std::size_t first = cluster * c;
      builder.set_cluster(c, std::span(rows).subspan(first, std::min<std::size_t>(cluster, slots - first)));
    });
    share(builder, work.ranks);
    auto made = builder.finish();
    out = made.rows;
    op.owners.push_back(made.owner);
  };
  fit(lights, kFirstCluster, params.coefficients, op.first);
  std::vector<std::vector<Rgbx>> once(lights.size());
  parallel_for(lights.size(), 1, [&](std::size_t t) { once[t] = first_bounce(op, lights[t]); });
  fit(once, kBounceCluster, params.bounce_coefficients, op.bounce);
  op.sweeps = enough_sweeps(op.bounce, op.albedo);
}

/// F, fitted to the lights after all bounces.
void make_gather(const TracedScene& traced, const RelightReceivers& receivers, const TransferParams& params,
                 const OperatorStart& start, const TrainingLight& light, const TransferWork& work,
                 Operator& op) {
  const RowMaker maker(traced, *start.cloud, start.square, params.transmission);
  const auto rays = static_cast<uint32_t>(params.rays);
  const auto row = [&](std::size_t i, RowMaker& rows, std::vector<SparseEntry>& out) {
    const uint32_t own = start.order[i];
    const Footprint footprint = receivers.source.footprint(own);
    const uint32_t stream = mix32(mix32(params.seed, kGatherStream), receivers.places[own]);
    rows.start();
    for (uint32_t r = 0; r < rays; ++r) rows.shoot(footprint.sample(sobol_pair(r, 0, stream)), r, stream);
    rows.finish(rays, out);
  };
  const auto cluster = static_cast<std::size_t>(params.cluster);
  const std::size_t count = start.order.size();
  ClusterRowsBuilder gather(
      static_cast<uint32_t>(count), light,
      {static_cast<uint32_t>(cluster), static_cast<std::size_t>(params.coefficients), params.keep_sums});
  for_blocks(gather.clusters(), "gather rows", work, [&](std::size_t c) {
    if (work.state != nullptr)
      if (std::string_view bytes = work.state->find(c); !bytes.empty()) return gather.unpack(c, bytes);
    gather.set_cluster(
        c, make_rows(maker, cluster * c, std::min(cluster, count - cluster * c), work.progress, row));
    if (work.state == nullptr) return;
    std::string bytes;
    gather.pack(c, bytes);
    work.state->put(c, bytes);
  });
  share(gather, work.ranks);
  auto made = gather.finish();
  op.gather = made.rows;
  op.owners.push_back(made.owner);
}

}  // namespace

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
  positive("--photons", p.photons, 1 << 30);
  positive("--nearest", p.nearest, 1 << 20);
}

Operator make_operator(const TracedScene& traced, const RelightReceivers& receivers,
                       const TransferParams& params, const std::string& scene, const TransferWork& work) {
  check(params);
  if (!params.transmission.empty() && params.transmission.size() != traced.scene.materials.size())
    throw UsageError("transmission", std::to_string(params.transmission.size()) + " values",
                     "one for each material: " + std::to_string(traced.scene.materials.size()));
  if (params.method == TransferMethod::chapter)
    return make_chapter_operator(traced, receivers, params, scene, work);
  OperatorStart start(traced, receivers, params, static_cast<std::size_t>(params.cluster), work.progress);
  Operator op = std::move(start.op);
  op.scene = scene;
  std::vector<std::vector<Rgbx>> lights =
      training_lights(traced, receivers, start.middles, op, params.lights, params.seed, work.progress);
  make_bounces(traced, params, start, lights, work, op);
  work.progress.check();

  // Receivers see the training lights after all bounces.
  parallel_for(lights.size(), 1, [&](std::size_t t) {
    bounce_light(op, lights[t]);
    haar_inverse(lights[t]);
  });
  const TrainingLight light(transformed_luminance(lights));
  lights = {};
  make_gather(traced, receivers, params, start, light, work, op);
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
