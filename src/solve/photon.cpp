// SPDX-License-Identifier: Apache-2.0
#include "solve/photon.h"

#include "solve/path_kernel.h"
#include "solve/photon_map.h"

namespace sconce {

namespace {

constexpr std::size_t kGathered = 64;  // photons per density where a ray ends: more blur, less noise
constexpr std::size_t kSeen = 400;     // where the receiver shows the density itself
// A density whose centroid is off by more than this (in radii) is not used. 64 photons in a full disk exceed
// it once in 170, in half a disk (0.42) nearly always.
constexpr float kLopsided = 0.2f;
constexpr float kShort =
    3;  // rays shorter than so many radii go on: their end sees the receiver's own corner

/// Photons to emit: four per texel, which land some ten times, so that a density of 64 spans about two
/// texels.
std::size_t photon_count(const SolveContext& context, const BakeParams& params) {
  if (params.photons > 0) return params.photons;
  if (context.receivers == nullptr) return 1 << 17;
  return std::clamp<std::size_t>(4 * context.receivers->size(), 1 << 19, 1 << 22);
}

/// Adds flux x scale x throughput of the photons. @tparam Sums  of solve/sums.h
template <class Sums>
void add(const PhotonMap& map, const PhotonMap::Density& density, const Rgb& throughput, const Sums& sums) {
  const Rgb factor = throughput * density.scale;
  for (const auto& [distance2, i] : density.nearest) {
    const Photon& photon = map[i];
    sums.add(3 * static_cast<std::size_t>(photon.group.value), factor.r * photon.flux.r,
             factor.g * photon.flux.g, factor.b * photon.flux.b);
  }
}

/// The map as a path reads it. One per thread.
class MapReader {
 public:
  MapReader(const World& world, const PhotonMap& map, int bounces)
      : world_(world), map_(map), bounces_(bounces) {}

  template <class Sums>
  bool read(const Hit& hit, uint32_t depth, const Rgb& throughput, const Sums& sums) {
    const Vec3 normal = world_.face_normals[hit.triangle];
    PhotonMap::Query query{world_.position(hit.triangle, hit.barycentric), hit.back ? -normal : normal,
                           kGathered};
    if (bounces_ >= 0) query.most_reflections = static_cast<uint32_t>(bounces_) - depth - 1;
    map_.density(query, density_);
    if (density_.sparse || density_.offset > kLopsided || hit.distance < kShort * density_.radius)
      return false;
    add(map_, density_, throughput, sums);
    return true;
  }

 private:
  const World& world_;
  const PhotonMap& map_;
  int bounces_;
  PhotonMap::Density density_;
};

class PhotonSolver final : public Solver {
 public:
  PhotonSolver(const SolveContext& context, const BakeParams& params, const Progress& progress)
      : context_(context),
        params_(params),
        usual_(usual_light(context.world, context.tracer, context.lamps)),
        map_(context,
             // With n bounces a gather ray's end needs light reflected at most n - 1 times, a receiver n
             // times.
             params.bounces < 0 ? -1 : params.bounces + (params.final_gather || params.bounces == 0 ? 0 : 1),
             photon_count(context, params), params.seed, progress) {}

  void solve(const Footprint& receiver, std::span<GroupValue> out) const override {
    PathKernel<Tracer, MapReader> kernel(context_.scene, context_.world, context_.tracer, context_.lamps,
                                         params_.final_gather ? params_.bounces : 0, context_.wanted,
                                         MapReader(context_.world, map_, params_.bounces), usual_);
    solve_receiver(kernel, receiver, params_, out);
    if (!params_.final_gather && params_.bounces != 0) add_indirect(receiver, out);
  }
  bool set_samples(int samples) override {
    params_.samples = samples;
    return true;
  }

 private:
  /// Adds the density of reflected light at one point of the receiver per batch.
  void add_indirect(const Footprint& receiver, std::span<GroupValue> out) const {
    PhotonMap::Density density;
    std::vector<double> sums(3 * out.size()), mean(3 * out.size()), squares(out.size());
    const auto luma = [](const std::vector<double>& s, std::size_t g) {
      return 0.2126 * s[3 * g] + 0.7152 * s[3 * g + 1] + 0.0722 * s[3 * g + 2];
    };
    for (uint32_t b = 0; b < kBatches; ++b) {
      const SurfacePoint at = receiver.sample(sobol_pair(b, 0, mix32(params_.seed, receiver.id)));
      map_.density({at.position, at.geometric_normal, kSeen, 1}, density);
      std::fill(sums.begin(), sums.end(), 0.0);
      add(map_, density, Rgb(1.0f), FlatSums{sums});
      for (std::size_t i = 0; i < sums.size(); ++i) mean[i] += sums[i] / kBatches;
      for (std::size_t g = 0; g < out.size(); ++g) squares[g] += luma(sums, g) * luma(sums, g) / kBatches;
    }
    for (std::size_t g = 0; g < out.size(); ++g) {
      out[g].illuminance += Rgb(static_cast<float>(mean[3 * g]), static_cast<float>(mean[3 * g + 1]),
                                static_cast<float>(mean[3 * g + 2]));
      const double l = luma(mean, g), variance = std::max(0.0, squares[g] - l * l) / (kBatches - 1);
      out[g].error = static_cast<float>(std::hypot(static_cast<double>(out[g].error), std::sqrt(variance)));
    }
  }

  SolveContext context_;
  BakeParams params_;
  std::vector<double> usual_;  ///< usual_light()
  PhotonMap map_;
};

}  // namespace

std::unique_ptr<Solver> make_photon_solver(const SolveContext& context, const BakeParams& params,
                                           const Progress& progress) {
  return std::make_unique<PhotonSolver>(context, params, progress);
}

}  // namespace sconce
