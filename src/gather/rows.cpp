// SPDX-License-Identifier: Apache-2.0
#include "gather/rows.h"

#include <algorithm>
#include <atomic>

#include "core/parallel.h"
#include "gather/row_rays.h"

namespace sconce {

namespace {

/// Rows of one block of samples.
class RowGatherer {
 public:
  RowGatherer(const World& world, const Tracer& tracer, const GatherCloud& cloud, const DirectLight& direct)
      : world_(world),
        tracer_(tracer),
        cloud_(cloud),
        on_cells_(direct.on_cells),
        at_point_(direct.groups > 0 ? direct.make_at_point() : DirectAtPoint()),
        sums_(3 * direct.groups),
        once_(3 * direct.groups) {}

  /// Appends row i.
  /// @param once  3 x groups, set
  void gather(std::size_t i, uint32_t rays, uint32_t seed, SparseRows& rows, std::span<float> once) {
    const Footprint footprint = cloud_.footprint(i);
    const uint32_t stream = mix32(mix32(seed, 0x726f7773u), footprint.id);
    std::fill(once_.begin(), once_.end(), 0.0);
    met_.clear();
    for (uint32_t r = 0; r < rays; ++r) {
      const auto end = follow_row_ray(
          world_, tracer_, cloud_, cloud_.point(i, footprint, sobol_pair(r, 0, stream)), r, stream,
          [&](const SurfacePoint& at, uint32_t cell, uint32_t step, const Rgb& throughput) {
            if (!once_.empty()) add_direct(at, cell, mix32(stream, r) ^ step, throughput);
          });
      if (end) met_.push_back(*end);
    }
    for (std::size_t c = 0; c < once.size(); ++c) once[c] = static_cast<float>(once_[c] / rays);
    std::stable_sort(met_.begin(), met_.end(),
                     [](const RowEnd& a, const RowEnd& b) { return a.sample < b.sample; });
    for (std::size_t k = 0; k < met_.size();) {
      std::size_t end = k;
      Rgb tint;
      for (; end < met_.size() && met_[end].sample == met_[k].sample; ++end) tint += met_[end].tint;
      rows.columns.push_back(met_[k].sample);
      if (tracer_.has_panes()) rows.tints.push_back(tint / static_cast<float>(end - k));
      rows.counts.push_back(static_cast<uint16_t>(end - k));
      k = end;
    }
    rows.first.push_back(rows.columns.size());
  }

 private:
  void add_direct(const SurfacePoint& at, uint32_t cell, uint32_t stream, const Rgb& factor) {
    const std::size_t width = once_.size();
    if (cloud_.owner(cell).trust == Trust::whole) {
      for (std::size_t c = 0; c < width; ++c) sums_[c] = static_cast<double>(on_cells_[width * cell + c]);
    } else {
      std::fill(sums_.begin(), sums_.end(), 0.0);
      at_point_(at, stream, sums_);
    }
    for (std::size_t c = 0; c < width; c += 3) {
      once_[c] += static_cast<double>(factor.r) * sums_[c];
      once_[c + 1] += static_cast<double>(factor.g) * sums_[c + 1];
      once_[c + 2] += static_cast<double>(factor.b) * sums_[c + 2];
    }
  }

  const World& world_;
  const Tracer& tracer_;
  const GatherCloud& cloud_;
  std::span<const float> on_cells_;
  DirectAtPoint at_point_;
  std::vector<double> sums_, once_;
  std::vector<RowEnd> met_;
};

}  // namespace

Gathered gather(const World& world, const Tracer& tracer, const GatherCloud& cloud, int rays, uint32_t seed,
                const DirectLight& direct, const Progress& progress, const Ranks& ranks) {
  constexpr std::size_t kBlock = 256;
  const std::size_t blocks = (cloud.size() + kBlock - 1) / kBlock;
  std::vector<SparseRows> parts(blocks);
  const std::size_t width = 3 * direct.groups;
  Gathered result;
  result.rows.unit = 1.0f / static_cast<float>(rays);
  result.once.assign(width * cloud.size(), 0.0f);
  std::atomic<uint64_t> done = 0;
  parallel_for(blocks, 1, [&](std::size_t block) {
    if (!ranks.mine(block)) return;
    progress.check();
    RowGatherer gatherer(world, tracer, cloud, direct);
    for (std::size_t i = block * kBlock; i < std::min(cloud.size(), (block + 1) * kBlock); ++i)
      gatherer.gather(i, static_cast<uint32_t>(rays), seed, parts[block],
                      std::span(result.once).subspan(width * i, width));
    progress.at("gather rows", ++done, blocks);
  });
  ranks.share(
      blocks,
      [&](std::size_t block, std::string& bytes) {
        const SparseRows& part = parts[block];
        put_span<uint64_t>(bytes, part.first);
        put_span<uint32_t>(bytes, part.columns);
        put_span<uint16_t>(bytes, part.counts);
        put_span<Rgb>(bytes, part.tints);
      },
      [&](std::size_t block, std::string_view& bytes) {
        SparseRows& part = parts[block];
        part.first.resize(std::min(cloud.size(), (block + 1) * kBlock) - block * kBlock + 1);
        take_span<uint64_t>(bytes, part.first);
        part.columns.resize(part.first.back());
        part.counts.resize(part.first.back());
        take_span<uint32_t>(bytes, part.columns);
        take_span<uint16_t>(bytes, part.counts);
        if (tracer.has_panes()) part.tints.resize(part.first.back());
        take_span<Rgb>(bytes, part.tints);
      });
  ranks.share(std::span(result.once), width * kBlock);
  SparseRows& rows = result.rows;
  for (SparseRows& part : parts) {
    const uint64_t base = rows.columns.size();
    for (std::size_t i = 1; i < part.first.size(); ++i) rows.first.push_back(base + part.first[i]);
    rows.columns.insert(rows.columns.end(), part.columns.begin(), part.columns.end());
    rows.counts.insert(rows.counts.end(), part.counts.begin(), part.counts.end());
    rows.tints.insert(rows.tints.end(), part.tints.begin(), part.tints.end());
    part = {};
  }
  return result;
}

namespace {

/// next = add + K (rho light), `width` numbers per sample, three channels in turn.
void sweep(const SparseRows& rows, const GatherCloud& cloud, std::span<const float> add,
           std::vector<float>& light, std::vector<float>& exitance) {
  const std::size_t n = cloud.size(), width = light.size() / n;
  parallel_for(n, 512, [&](std::size_t i) {
    const Rgb& albedo = cloud.albedo(i);
    for (std::size_t c = i * width; c < (i + 1) * width; c += 3) {
      exitance[c] = albedo.r * light[c];
      exitance[c + 1] = albedo.g * light[c + 1];
      exitance[c + 2] = albedo.b * light[c + 2];
    }
  });
  parallel_for(n, 64, [&](std::size_t i) {
    rows.apply(i, exitance, std::span(light).subspan(i * width, width));
    if (!add.empty())
      for (std::size_t c = i * width; c < (i + 1) * width; ++c) light[c] += add[c];
  });
}

}  // namespace

int enough_bounces(const SparseRows& rows, const GatherCloud& cloud, double tolerance) {
  constexpr int kMost = 1000;
  std::vector<float> light(3 * cloud.size(), 1.0f), exitance(light.size());
  double before[3] = {0, 0, 0};
  for (int bounces = 0; bounces < kMost; ++bounces) {
    double still = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      double left = 0;
      for (std::size_t i = 0; i < cloud.size(); ++i) left += static_cast<double>(light[3 * i + c]);
      left /= static_cast<double>(cloud.size());
      // All that is still to come, were it to fall off from now on as in the last bounce.
      const double ratio = before[c] > 0 ? left / before[c] : 1;
      still = std::max(still, ratio < 1 ? left / (1 - ratio) : left > 0 ? 1.0 : 0.0);
      before[c] = left;
    }
    if (still <= tolerance) return bounces;
    sweep(rows, cloud, {}, light, exitance);
  }
  return kMost;
}

std::vector<float> bounce(const SparseRows& rows, const GatherCloud& cloud, std::span<const float> once,
                          int bounces, const Progress& progress) {
  std::vector<float> light(once.size()), exitance(once.size());
  if (bounces > 0) light.assign(once.begin(), once.end());
  for (int i = 1; i < bounces; ++i) {
    progress.check();
    progress.at("bounces", static_cast<uint64_t>(i), static_cast<uint64_t>(bounces));
    sweep(rows, cloud, once, light, exitance);
  }
  return light;
}

}  // namespace sconce
