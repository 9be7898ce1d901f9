// SPDX-License-Identifier: Apache-2.0
#include "measure/virtual_bench.h"

#include <atomic>
#include <cmath>

#include "core/error.h"
#include "core/parallel.h"
#include "core/sobol.h"

namespace sconce {

namespace {

constexpr uint32_t kPanePair = 0xfffffeffu;
constexpr uint64_t kChunk = 1 << 14;  // rays of one lamp at a time
constexpr std::size_t kWave = 64;     // chunks held at once

struct Chunk {
  std::size_t lamp;
  uint64_t first, count;  ///< of the lamp's rays
};

class BenchTracer {
 public:
  BenchTracer(const Scene& scene, const World& world, const Tracer& tracer, const Lamps& lamps,
              const BenchParams& params)
      : scene_(scene), world_(world), tracer_(tracer), lamps_(lamps), params_(params) {}

  /// One of `count` rays of a lamp; no flux where it stays inside.
  SourceRay trace(std::size_t lamp, uint64_t index, uint64_t count) const {
    const uint32_t stream = mix32(params_.seed, static_cast<uint32_t>(lamp));
    const uint32_t reversed = detail::reverse_bits(static_cast<uint32_t>(index));
    const auto pair = [&](uint32_t slot) { return sobol_bits(reversed, slot, stream).unit(); };
    const EmittedLight light = lamps_.emit(lamp, pair(0), pair(1));
    Vec3 start = offset_origin(light.position, light.normal, light.direction), direction = light.direction;
    Rgb flux = light.flux * (1 / static_cast<float>(count));
    float kept = 1;  // of the ray relative to what left the lamp: decides how it ends
    for (uint32_t depth = 0; depth <= static_cast<uint32_t>(params_.reflections); ++depth) {
      const auto [hit, passed] =
          tracer_.follow({start, direction}, [&] { return pair(kPanePair - depth).x; });
      flux *= passed, kept *= passed.max();
      if (!hit) return hanging(start, direction, flux);
      if (hit.back && !scene_[world_.materials[hit.triangle]].double_sided) break;
      const SurfacePoint at = surface_point(world_, hit);
      const Shade surface = shade(scene_, world_, hit.triangle, hit.barycentric);
      const Vec2 choice = pair(2 + 2 * depth);
      flux *= surface.base_color;
      kept *= surface.base_color.max();
      const float survival = std::min(1.0f, kept);
      if (!(choice.y < survival)) break;
      flux *= 1 / survival, kept /= survival;
      if (choice.x < surface.metallic) {
        direction = glm::reflect(direction, at.shading_normal);
        if (!(glm::dot(direction, at.geometric_normal) > 0)) break;
      } else {
        direction = Frame(at.geometric_normal).to_world(square_to_cosine(pair(3 + 2 * depth)));
      }
      start = offset_origin(at.position, at.geometric_normal, at.geometric_normal);
    }
    return hanging(start, direction, Rgb(0));
  }

 private:
  static SourceRay hanging(const Vec3& p, const Vec3& d, const Rgb& flux) {
    const float lumens = luminance(flux);
    const bool grey = flux.r == flux.g && flux.g == flux.b;
    return {Vec3(p.x, -p.z, p.y), glm::normalize(Vec3(d.x, -d.z, d.y)), lumens,
            grey || !(lumens > 0) ? Rgb(1) : flux / lumens};
  }

  const Scene& scene_;
  const World& world_;
  const Tracer& tracer_;
  const Lamps& lamps_;
  BenchParams params_;
};

}  // namespace

void trace_luminaire(const Scene& scene, const World& world, const Tracer& tracer, const Lamps& lamps,
                     const BenchParams& params, const std::function<void(std::span<const SourceRay>)>& sink,
                     const Progress& progress) {
  double total = 0;
  for (const Lamp& lamp : lamps.all()) {
    if (lamp.infinite)
      throw Error(scene.name, "has the light '" + lamp.name + "' at infinity, which no luminaire sends");
    total += static_cast<double>(luminance(lamp.flux));
  }
  if (!(total > 0))
    throw Error(scene.name, "has no light that could leave it", "emissive materials or lamps");
  std::vector<Chunk> chunks;
  std::vector<uint64_t> counts;
  for (std::size_t i = 0; i < lamps.size(); ++i) {
    const double share = static_cast<double>(luminance(lamps.all()[i].flux)) / total;
    counts.push_back(static_cast<uint64_t>(std::ceil(share * static_cast<double>(params.rays))));
    for (uint64_t first = 0; first < counts[i]; first += kChunk)
      chunks.push_back({i, first, std::min(kChunk, counts[i] - first)});
  }
  const BenchTracer bench(scene, world, tracer, lamps, params);
  std::vector<std::vector<SourceRay>> left(std::min(chunks.size(), kWave));
  std::atomic<uint64_t> done = 0;
  for (std::size_t first = 0; first < chunks.size(); first += kWave) {
    const std::size_t count = std::min(kWave, chunks.size() - first);
    parallel_for(count, 1, [&](std::size_t c) {
      progress.check();
      const Chunk& chunk = chunks[first + c];
      left[c].clear();
      for (uint64_t i = chunk.first; i < chunk.first + chunk.count; ++i) {
        const SourceRay ray = bench.trace(chunk.lamp, i, counts[chunk.lamp]);
        if (ray.flux > 0) left[c].push_back(ray);
      }
      progress.at("trace the luminaire", ++done, chunks.size());
    });
    for (std::size_t c = 0; c < count; ++c) sink(left[c]);
  }
}

std::vector<SourceRay> trace_luminaire(const Scene& scene, const World& world, const Tracer& tracer,
                                       const Lamps& lamps, const BenchParams& params,
                                       const Progress& progress) {
  std::vector<SourceRay> rays;
  trace_luminaire(
      scene, world, tracer, lamps, params,
      [&](std::span<const SourceRay> some) { rays.insert(rays.end(), some.begin(), some.end()); }, progress);
  return rays;
}

}  // namespace sconce
