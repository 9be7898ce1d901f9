// SPDX-License-Identifier: Apache-2.0
// One path of the path tracer. A template over the rays, so that a benchmark can record them.
#pragma once

#include <span>

#include "core/sobol.h"
#include "solve/pick.h"
#include "solve/shadow_rates.h"
#include "solve/solver.h"
#include "solve/sums.h"

namespace sconce {

/// What a path knows of the light at its hits besides what it finds itself: nothing.
struct NoCache {
  /// Adds to the sums throughput times the illuminance at the end of ray number `depth` (0: the receiver's),
  /// in place of the rest of the path. False: it cannot tell, the path goes on.
  template <class Sums>
  bool read(const Hit&, uint32_t /*depth*/, const Rgb& /*throughput*/, const Sums& /*sums*/) {
    return false;
  }
};

/// Estimates E_g at a point for all groups from one path: next-event estimation at every vertex, emitters met
/// by the path's own rays, both weighted by the balance heuristic (Veach 1997). One path serves every group.
/// @tparam Rays   has follow() and transmittance() as Tracer
/// @tparam Cache  NoCache, or one of the same form
template <class Rays, class Cache = NoCache>
class PathKernel {
 public:
  /// @param wanted  SolveContext::wanted
  /// @param usual   usual_light(): batch() samples each lamp as often as is worth it; empty: as sample() does
  PathKernel(const Scene& scene, const World& world, const Rays& rays, const Lamps& lamps, int bounces,
             std::span<const uint8_t> wanted = {}, const Cache& cache = {},
             std::span<const double> usual = {})
      : scene_(scene),
        world_(world),
        rays_(rays),
        lamps_(lamps),
        picker_(lamps),
        bounces_(bounces),
        cache_(cache),
        budget_(shadow_ray_budget(lamps.size())),
        rates_(usual),
        apart_(!usual.empty()) {
    for (const Lamp& lamp : lamps.all()) {
      wanted_.push_back(wanted.empty() ? 1 : wanted[lamp.group.value]);
      area_lights_ |= wanted_.back() != 0 && (std::holds_alternative<MeshLamp>(lamp.shape) ||
                                              std::holds_alternative<SkyLamp>(lamp.shape));
    }
  }

  /// Adds one sample of E_g, lux; at a probe of e = 1/4 the integral of L over the whole sphere, whose g is
  /// 1/2 the integral of L w, as a surface's (docs/adr/0038-probes.md). @tparam Sums  of solve/sums.h
  template <class Sums>
  void sample(const Footprint& receiver, uint32_t stream, uint32_t index, Sums sums) {
    path(receiver, stream, index, false, sums);
  }

  /// Adds samples [first, first + count); a kernel takes batches of one receiver only, in order. Lamps are
  /// sampled apart from the paths, as often as what was met so far says.
  template <class Sums>
  void batch(const Footprint& receiver, uint32_t stream, uint32_t first, uint32_t count, Sums sums) {
    if (apart_) rates_.decide(first, count);
    for (uint32_t i = 0; i < count; ++i) path(receiver, stream, first + i, apart_, sums);
    for (uint32_t level = 0; apart_ && level < ShadowRates::kLevels; ++level)
      for (uint32_t i = 0; i < rates_.count(level); ++i)
        direct(receiver, stream, rates_.first(level) + i, level, sums);
  }

 private:
  static constexpr uint32_t kFootprintPair = 0xffffff00u, kPanePair = kFootprintPair - 1;
  /// What a probe has in place of the cosine; its rays' density is that over pi, as a surface's.
  static constexpr float kProbe = 0.25f;
  /// g divides by the cosine that the receiver's rays are sampled with: light that comes in flatter than this
  /// (2.9 degrees) counts less in g, so that its noise stays finite. Lamps that are sampled need no such
  /// bound.
  static constexpr float kGrazing = 0.05f;

  /// One path. @param apart  lamps at the receiver are left to direct()
  template <class Sums>
  void path(const Footprint& receiver, uint32_t stream, uint32_t index, bool apart, Sums& sums) {
    const uint32_t reversed = detail::reverse_bits(index);
    SurfacePoint at = receiver.sample(sobol_bits(reversed, kFootprintPair, stream).unit());
    Rgb throughput{1.0f};
    for (uint32_t depth = 0;; ++depth) {
      const auto bits = [&](uint32_t slot) { return sobol_bits(reversed, 3 * depth + slot, stream); };
      const bool probe = depth == 0 && receiver.kind == ReceiverKind::probe, picked = depth > 0 || !apart;
      const Vec2 choice = picked ? bits(1).unit() : Vec2(0);
      const Start start(at, probe);
      if (picked) {
        aim(at, probe, depth == 0 ? budget_.receiver : budget_.bounce);
        const SobolBits on_lamps = bits(2);
        picker_.pick(choice.x, [&](uint32_t lamp, float expected) {
          next_event(at, start, lamp, expected, on_lamps.scrambled(stream ^ (lamp << 16 | depth)).unit(),
                     throughput, depth == 0, probe, sums);
        });
      }
      // How often a lamp that the path meets is sampled otherwise.
      const auto expected = [&](std::size_t lamp) {
        if (picked) return picker_.expected(lamp);
        aim(at, probe, static_cast<int>(lamps_.size()));
        return picker_.expected(lamp) * rates_.rate(lamp);
      };
      const bool last = bounces_ >= 0 && depth >= static_cast<uint32_t>(bounces_);
      if (last && !area_lights_) return;

      const Vec3 direction = probe ? square_to_sphere(bits(0).unit())
                                   : Frame(at.shading_normal).to_world(square_to_cosine(bits(0).unit()));
      const float cosine = probe ? kProbe : glm::dot(direction, at.shading_normal);
      if (!(cosine > 0) || (!probe && !(glm::dot(direction, at.geometric_normal) > 0))) return;
      if (depth == 0) sums.aim(direction, std::max(cosine, kGrazing));
      const auto [hit, passed] = rays_.follow({start.origin, direction}, [&] {
        return sobol_bits(reversed, kPanePair - depth, stream).unit().x;
      });
      throughput *= passed;
      if (!hit) {
        for (const uint32_t sky : lamps_.skies()) {
          const float other = expected(sky) * lamps_.sky_pdf(sky, direction);
          add(sums, sky,
              throughput * lamps_.sky_radiance(sky, direction) * (cosine / (other + cosine * kInvPi)));
        }
        return;
      }
      const int lamp = lamps_.lamp_of(hit.triangle);
      if (lamp >= 0) {
        const Rgb emission = lamps_.emission(hit.triangle, hit.barycentric, hit.back);
        if (!emission.is_black()) {
          const float other = expected(static_cast<std::size_t>(lamp)) *
                              lamps_.pdf(hit.triangle, hit.barycentric, hit.distance, direction);
          add(sums, static_cast<uint32_t>(lamp),
              throughput * emission * (cosine / (other + cosine * kInvPi)));
        }
      }
      if (last) return;
      const Material& material = scene_[world_.materials[hit.triangle]];
      if (hit.back && !material.double_sided) return;
      throughput *= shade(scene_, world_, hit.triangle, hit.barycentric).base_color;
      if (cache_.read(hit, depth, throughput, sums)) return;
      if (depth >= 1) {
        const float survival = std::min(1.0f, throughput.max());
        if (!(choice.y < survival)) return;
        throughput *= 1 / survival;
      }
      if (throughput.is_black()) return;
      at = surface_point(world_, hit);
    }
  }

  /// One sample of each lamp of a level, at the receiver.
  template <class Sums>
  void direct(const Footprint& receiver, uint32_t stream, uint32_t index, uint32_t level, Sums& sums) {
    const auto own = [&](std::size_t lamp) { return rates_.level(lamp) == level && wanted_[lamp] != 0; };
    std::size_t lamp = 0;
    while (lamp < lamps_.size() && !own(lamp)) ++lamp;
    if (lamp == lamps_.size()) return;
    const uint32_t reversed = detail::reverse_bits(index);
    const SurfacePoint at = receiver.sample(sobol_bits(reversed, kFootprintPair, stream).unit());
    const bool probe = receiver.kind == ReceiverKind::probe;
    aim(at, probe, static_cast<int>(lamps_.size()));
    const Start start(at, probe);
    const SobolBits on_lamps = sobol_bits(reversed, 2, stream);
    for (; lamp < lamps_.size(); ++lamp) {
      if (!own(lamp)) continue;
      Seen seen;
      if (picker_.expected(lamp) > 0)
        seen = next_event(at, start, static_cast<uint32_t>(lamp), rates_.rate(lamp),
                          on_lamps.scrambled(stream ^ (static_cast<uint32_t>(lamp) << 16)).unit(), Rgb(1.0f),
                          true, probe, sums);
      rates_.note(lamp, seen.light, seen.passed);
    }
  }

  void aim(const SurfacePoint& at, bool probe, int rays) {
    picker_.aim(at.position, probe ? Vec3(0) : at.shading_normal, rays);
  }

  /// Where rays leave a surface.
  struct Start {
    Vec3 origin;
    float offset;  ///< of `origin` from the point

    /// @param probe  which has no surface
    Start(const SurfacePoint& at, bool probe)
        : origin(probe ? at.position : offset_origin(at.position, at.geometric_normal, at.geometric_normal)),
          offset(glm::distance(origin, at.position)) {}
  };
  /// Of a lamp: what would come of radiance 1, and how much of it is not held back.
  struct Seen {
    float light = 0, passed = 0;
  };

  /// @param expected  number of samples of the lamp for one of the path
  /// @param first     at the receiver itself
  /// @param probe     which has no horizon
  template <class Sums>
  Seen next_event(const SurfacePoint& at, const Start& start, uint32_t lamp, float expected, Vec2 u,
                  const Rgb& throughput, bool first, bool probe, Sums& sums) {
    if (wanted_[lamp] == 0) return {};
    LightSample light;
    if (!lamps_.sample(lamp, at.position, u, light) || light.radiance.is_black()) return {};
    const float cosine = probe ? kProbe : glm::dot(light.direction, at.shading_normal);
    if (!(cosine > 0) || (!probe && !(glm::dot(light.direction, at.geometric_normal) > 0))) return {};
    const float unit = unit_light(light, cosine);
    const float end = shadow_end(light, start.offset);
    const Rgb passed = end > 0 ? rays_.transmittance({start.origin, light.direction, end}) : Rgb(1.0f);
    if (passed.is_black()) return {unit, 0};
    if (first) sums.aim(light.direction, cosine);
    const float density = light.delta ? expected : expected * light.pdf + cosine * kInvPi;
    add(sums, lamp, throughput * passed * light.radiance * (cosine / density));
    return {unit, luminance(passed)};
  }

  template <class Sums>
  void add(const Sums& sums, uint32_t lamp, const Rgb& value) {
    if (wanted_[lamp] != 0)
      sums.add(3 * static_cast<std::size_t>(lamps_.all()[lamp].group.value), value.r, value.g, value.b);
  }

  const Scene& scene_;
  const World& world_;
  const Rays& rays_;
  const Lamps& lamps_;
  LampPicker picker_;
  int bounces_;
  Cache cache_;
  RayBudget budget_;
  ShadowRates rates_;
  bool apart_;
  std::vector<uint8_t> wanted_;  ///< per lamp; which are sampled never depends on it, so bits stay
  bool area_lights_ = false;
};

/// All samples of one receiver, in batches; shared by the solver and the benchmark that replays its rays.
/// @param out  as Solver::solve
template <class Kernel>
void solve_receiver(Kernel& kernel, const Footprint& receiver, const BakeParams& params,
                    std::span<GroupValue> out) {
  const Basis basis = receiver.kind == ReceiverKind::probe ? Basis::sh1 : params.basis;
  const std::size_t values = out.size(), groups = values / coefficients(basis);
  const uint32_t most = static_cast<uint32_t>(std::max(1, (params.samples + kBatches - 1) / kBatches));
  std::vector<double> sums(kBatches * 3 * values, 0.0);
  std::vector<double> luma(kBatches * values);
  const auto batch = [&](int b) {
    return std::span(sums).subspan(static_cast<std::size_t>(b) * 3 * values, 3 * values);
  };
  const uint32_t stream = mix32(params.seed, receiver.id);
  const auto add = [&](uint32_t first, uint32_t count, std::span<double> into) {
    if (basis == Basis::flat)
      kernel.batch(receiver, stream, first, count, FlatSums{into});
    else
      kernel.batch(receiver, stream, first, count, Sh1Sums(into));
  };
  // Where few paths find light, the first samples find none and differ by nothing.
  constexpr uint32_t kDark = 512 / kBatches;
  uint32_t done = 0;
  // Rounds double, so that every stop leaves a whole power of two per batch.
  for (uint32_t round = params.noise > 0 ? std::min(most, 2u) : most;; round = std::min(most, 2 * round)) {
    for (int b = 0; b < kBatches; ++b) {
      // Batches are neighbouring parts of one sequence: each is a net, and so are all together.
      const uint32_t part = round - done;
      add(kBatches * done + static_cast<uint32_t>(b) * part, part, batch(b));
    }
    done = round;
    double mean_total = 0, squares_total = 0;
    for (std::size_t g = 0; g < values; ++g) {
      double rgb[3] = {0, 0, 0}, squares = 0;
      for (int b = 0; b < kBatches; ++b) {
        const auto s = batch(b);
        double& l = luma[static_cast<std::size_t>(b) * values + g];
        for (std::size_t c = 0; c < 3; ++c) rgb[c] += s[3 * g + c];
        l = (0.2126 * s[3 * g] + 0.7152 * s[3 * g + 1] + 0.0722 * s[3 * g + 2]) / done;
      }
      const double n = static_cast<double>(done) * kBatches;
      const double mean = (0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]) / n;
      for (int b = 0; b < kBatches; ++b) {
        const double d = luma[static_cast<std::size_t>(b) * values + g] - mean;
        squares += d * d;
      }
      out[g].illuminance =
          Rgb(static_cast<float>(rgb[0] / n), static_cast<float>(rgb[1] / n), static_cast<float>(rgb[2] / n));
      out[g].error = static_cast<float>(std::sqrt(squares / (kBatches * (kBatches - 1))));
      if (g < groups) mean_total += mean;
    }
    for (int b = 0; b < kBatches; ++b) {
      double l = -mean_total;
      for (std::size_t g = 0; g < groups; ++g) l += luma[static_cast<std::size_t>(b) * values + g];
      squares_total += l * l;
    }
    const double error_total = std::sqrt(squares_total / (kBatches * (kBatches - 1)));
    const bool dark = mean_total == 0 && done < kDark;
    if (done >= most || (!dark && error_total <= params.noise * mean_total)) return;
  }
}

}  // namespace sconce
