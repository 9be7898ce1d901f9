// SPDX-License-Identifier: Apache-2.0
#include "solve/radiosity.h"

#include <atomic>

#include "core/parallel.h"
#include "gather/rows.h"
#include "solve/path_kernel.h"

namespace sconce {

namespace {

constexpr int kDirectSamples = 64;         // per gather sample
constexpr std::size_t kRowRays = 1 << 24;  // in all
constexpr float kShort = 2;                // a ray shorter than so many spacings goes on as a path

/// What receivers' rays read.
struct RadiosityCache {
  static constexpr uint32_t kRaysPerPoint = 4;

  const GatherCloud* cloud = nullptr;
  const std::vector<float>* first = nullptr;   ///< samples x 3 groups: light at the receiver's own hits
  const std::vector<float>* second = nullptr;  ///< one bounce less: at the hits of rays that went on once
  bool all_bounces = false;

  bool read(const Hit& hit, uint32_t depth, const Rgb& throughput, std::span<double> sums) const {
    if (depth >= 2 && !all_bounces) return false;
    const Owner owner = cloud->owner(hit);
    if (!owner.sure || hit.distance < kShort * cloud->spacing(owner.sample)) return false;
    const float* illuminance = (depth == 0 ? first : second)->data() + sums.size() * owner.sample;
    for (std::size_t g = 0; g < sums.size(); g += 3) {
      sums[g] += static_cast<double>(throughput.r * illuminance[g]);
      sums[g + 1] += static_cast<double>(throughput.g * illuminance[g + 1]);
      sums[g + 2] += static_cast<double>(throughput.b * illuminance[g + 2]);
    }
    return true;
  }
};

class RadiositySolver final : public Solver {
 public:
  RadiositySolver(const SolveContext& context, const BakeParams& params, const Progress& progress)
      : context_(context), params_(params) {
    if (params.bounces == 0) return;
    CloudParams cloud;
    cloud.seed = params.seed;
    if (params.cloud > 0)
      cloud.samples = static_cast<std::size_t>(params.cloud);
    else if (context.receivers == nullptr)
      cloud.samples = 2048;
    cloud_ = std::make_unique<GatherCloud>(context.scene, context.world, context.tracer, context.receivers,
                                           cloud, progress);
    const int rays = static_cast<int>(std::clamp<std::size_t>(kRowRays / cloud_->size(), 64, 512));
    const SparseRows rows = make_rows(context.tracer, *cloud_, rays, params.seed, progress);
    const std::vector<float> direct = direct_light(progress);
    if (params.bounces < 0) {
      first_ = bounce(rows, *cloud_, direct, enough_bounces(rows, *cloud_), progress);
    } else {
      second_ = bounce(rows, *cloud_, direct, std::max(0, params.bounces - 2), progress);
      first_ = bounce(rows, *cloud_, direct, params.bounces - 1, progress);
    }
  }

  void solve(const Footprint& receiver, std::span<GroupValue> out) const override {
    RadiosityCache cache;
    cache.cloud = cloud_.get();
    cache.all_bounces = params_.bounces < 0;
    cache.first = &first_;
    cache.second = cache.all_bounces ? &first_ : &second_;
    PathKernel<Tracer, RadiosityCache> kernel(context_.scene, context_.world, context_.tracer, context_.lamps,
                                              params_.bounces, context_.wanted, cache);
    solve_receiver(kernel, receiver, params_, out);
  }

 private:
  /// Direct illuminance on the gather samples, mean over each one's cells.
  std::vector<float> direct_light(const Progress& progress) const {
    const std::size_t groups = context_.scene.groups.size();
    std::vector<float> direct(3 * groups * cloud_->size());
    BakeParams params;
    params.samples = kDirectSamples;
    params.bounces = 0;
    params.seed = mix32(params_.seed, 0x64697265u);
    std::atomic<uint64_t> done = 0;
    constexpr std::size_t kBlock = 256;
    const std::size_t blocks = (cloud_->size() + kBlock - 1) / kBlock;
    parallel_for(blocks, 1, [&](std::size_t block) {
      progress.check();
      PathKernel<Tracer> kernel(context_.scene, context_.world, context_.tracer, context_.lamps, 0,
                                context_.wanted);
      std::vector<GroupValue> values(groups);
      for (std::size_t i = block * kBlock; i < std::min(cloud_->size(), (block + 1) * kBlock); ++i) {
        solve_receiver(kernel, cloud_->footprint(i), params, values);
        for (std::size_t g = 0; g < groups; ++g) {
          float* out = &direct[3 * (i * groups + g)];
          out[0] = values[g].illuminance.r, out[1] = values[g].illuminance.g,
          out[2] = values[g].illuminance.b;
        }
      }
      progress.at("light on the cloud", ++done, blocks);
    });
    return direct;
  }

  SolveContext context_;
  BakeParams params_;
  std::unique_ptr<GatherCloud> cloud_;  ///< null for direct light only
  std::vector<float> first_, second_;
};

}  // namespace

std::unique_ptr<Solver> make_radiosity_solver(const SolveContext& context, const BakeParams& params,
                                              const Progress& progress) {
  return std::make_unique<RadiositySolver>(context, params, progress);
}

}  // namespace sconce
