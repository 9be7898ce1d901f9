// SPDX-License-Identifier: Apache-2.0
#include "solve/radiosity.h"

#include <atomic>

#include "core/parallel.h"
#include "gather/rows.h"
#include "solve/path_kernel.h"

namespace sconce {

namespace {

constexpr float kShort = 2;  // a ray shorter than so many spacings goes on as a path

// Light on cells and rays of rows: as few as are not seen beside the noise of the receivers' own rays.
constexpr int kLeastDirectSamples = 2, kMostDirectSamples = 4;          // per cell
constexpr std::size_t kLeastRowRays = 1 << 19, kMostRowRays = 1 << 21;  // in all

struct CacheEffort {
  uint32_t direct_samples = kMostDirectSamples;
  std::size_t row_rays = kMostRowRays;

  CacheEffort(const SolveContext& context, const BakeParams& params) {
    if (context.receivers == nullptr) return;
    const int samples = params.cache_samples > 0 ? params.cache_samples : params.samples;
    direct_samples = static_cast<uint32_t>(std::clamp(samples / 16, kLeastDirectSamples, kMostDirectSamples));
    row_rays = std::clamp(context.receivers->size() * static_cast<std::size_t>(samples) / 4, kLeastRowRays,
                          kMostRowRays);
  }
};

/// A sample for four texels, up to where more were not seen to help.
std::size_t cloud_size(const SolveContext& context, const BakeParams& params) {
  if (params.cloud > 0) return static_cast<std::size_t>(params.cloud);
  if (context.receivers == nullptr) return 2048;
  return std::clamp<std::size_t>(context.receivers->size() / 4, 4096, 65536);
}

ReceiverSource source(const TexelReceivers* receivers) {
  if (receivers == nullptr) return {};
  return {receivers->size(), [receivers](std::size_t i) { return receivers->footprint(i); }};
}

/// What receivers' rays read.
struct RadiosityCache {
  const GatherCloud* cloud = nullptr;
  const float* direct = nullptr;  ///< cells x 3 groups
  /// samples x 3 groups: light at the ends of receivers' own rays; at those of rays that went on once
  const float *first = nullptr, *second = nullptr;
  int bounces = -1;

  template <class Sums>
  bool read(const Hit& hit, uint32_t depth, const Rgb& throughput, const Sums& sums) const {
    if (depth >= 2 && bounces >= 0) return false;
    const uint32_t cell = cloud->cell(hit);
    const Owner owner = cloud->owner(cell);
    if (owner.trust != Trust::whole || hit.distance < kShort * cloud->spacing(owner.sample)) return false;
    const float* light = direct + sums.width() * cell;
    const float* more = (depth == 0 ? first : second) + sums.width() * owner.sample;
    for (std::size_t g = 0; g < sums.width(); g += 3)
      sums.add(g, throughput.r * (light[g] + more[g]), throughput.g * (light[g + 1] + more[g + 1]),
               throughput.b * (light[g + 2] + more[g + 2]));
    return true;
  }
};

class RadiositySolver final : public Solver {
 public:
  RadiositySolver(const SolveContext& context, const BakeParams& params, const Progress& progress)
      : context_(context),
        params_(params),
        usual_(usual_light(context.world, context.tracer, context.lamps)) {
    if (params.bounces == 0) return;
    CloudParams cloud;
    cloud.seed = params.seed;
    cloud.samples = cloud_size(context, params);
    cloud_ = std::make_unique<GatherCloud>(context.scene, context.world, context.tracer, context.lamps,
                                           source(context.receivers), cloud, progress, context.ranks);
    const CacheEffort effort(context, params);
    direct_ = direct_light(effort.direct_samples, progress);
    const int rays = static_cast<int>(std::clamp<std::size_t>(effort.row_rays / cloud_->size(), 32, 256));
    DirectLight direct;
    direct.groups = context.scene.groups.size();
    direct.on_cells = direct_;
    direct.make_at_point = [&]() -> DirectAtPoint {
      auto kernel = std::make_shared<PathKernel<Tracer>>(context.scene, context.world, context.tracer,
                                                         context.lamps, 0, context.wanted);
      return [kernel](const SurfacePoint& at, uint32_t stream, std::span<double> sums) {
        kernel->sample(Footprint::point(0, ReceiverKind::gather, at), stream, 0, FlatSums{sums});
      };
    };
    const Gathered gathered =
        gather(context.world, context.tracer, *cloud_, rays, params.seed, direct, progress, context.ranks);
    const auto indirect = [&](int bounces) {
      return bounce(gathered.rows, *cloud_, gathered.once, bounces, progress);
    };
    if (params.bounces < 0) {
      first_ = indirect(enough_bounces(gathered.rows, *cloud_));
    } else {
      first_ = indirect(params.bounces - 1);
      second_ = indirect(params.bounces - 2);
    }
  }

  void solve(const Footprint& receiver, std::span<GroupValue> out) const override {
    RadiosityCache cache;
    cache.cloud = cloud_.get();
    cache.bounces = params_.bounces;
    cache.direct = direct_.data();
    cache.first = first_.data();
    cache.second = params_.bounces < 0 ? first_.data() : second_.data();
    PathKernel<Tracer, RadiosityCache> kernel(context_.scene, context_.world, context_.tracer, context_.lamps,
                                              params_.bounces, context_.wanted, cache, usual_);
    solve_receiver(kernel, receiver, params_, out);
  }
  bool set_samples(int samples) override {
    params_.samples = samples;
    return true;
  }

 private:
  /// Direct illuminance on the cloud's cells, cells x 3 groups; black where they are not trusted wholly.
  std::vector<float> direct_light(uint32_t samples, const Progress& progress) const {
    const std::size_t width = 3 * context_.scene.groups.size();
    std::vector<float> direct(width * cloud_->cells());
    const uint32_t seed = mix32(params_.seed, 0x64697265u);
    std::atomic<uint64_t> done = 0;
    constexpr std::size_t kBlock = 4096;
    const std::size_t blocks = (cloud_->cells() + kBlock - 1) / kBlock;
    const Ranks& ranks = context_.ranks;
    parallel_for(blocks, 1, [&](std::size_t block) {
      if (!ranks.mine(block)) return;
      progress.check();
      PathKernel<Tracer> kernel(context_.scene, context_.world, context_.tracer, context_.lamps, 0,
                                context_.wanted);
      std::vector<double> sums(width);
      for (std::size_t c = block * kBlock; c < std::min(cloud_->cells(), (block + 1) * kBlock); ++c) {
        const auto cell = static_cast<uint32_t>(c);
        if (cloud_->owner(cell).trust != Trust::whole) continue;
        const Footprint footprint = cloud_->cell_footprint(cell);
        std::fill(sums.begin(), sums.end(), 0.0);
        for (uint32_t s = 0; s < samples; ++s) kernel.sample(footprint, mix32(seed, cell), s, FlatSums{sums});
        for (std::size_t g = 0; g < width; ++g) direct[width * c + g] = static_cast<float>(sums[g] / samples);
      }
      progress.at("light on the cloud", ++done, blocks);
    });
    ranks.share(std::span(direct), width * kBlock);
    return direct;
  }

  SolveContext context_;
  BakeParams params_;
  std::vector<double> usual_;           ///< usual_light()
  std::unique_ptr<GatherCloud> cloud_;  ///< null for direct light only
  std::vector<float> direct_;           ///< on its cells
  std::vector<float> first_, second_;   ///< reflected, on its samples
};

}  // namespace

std::unique_ptr<Solver> make_radiosity_solver(const SolveContext& context, const BakeParams& params,
                                              const Progress& progress) {
  return std::make_unique<RadiositySolver>(context, params, progress);
}

}  // namespace sconce
