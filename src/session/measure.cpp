// SPDX-License-Identifier: Apache-2.0
#include "session/measure.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.h"
#include "core/parallel.h"
#include "core/sobol.h"
#include "picture/seen.h"
#include "solve/points.h"

namespace sconce {

namespace {

constexpr uint32_t kGatherStream = 0x67617468u;
constexpr float kLeak = 0.01f;  // of the brightest point: what texels at edges let through walls

}  // namespace

Rgb MeasuredLight::mixed(std::size_t point, const MixSpec& mix) const {
  Rgb sum;
  for (std::size_t g = 0; g < groups; ++g) sum += mix.weights.at(g) * values[point * groups + g];
  return sum;
}

MeasuredLight part_of(const MeasuredLight& light, std::size_t first, std::size_t end) {
  const auto at = [&](std::size_t point) {
    return light.values.begin() + static_cast<std::ptrdiff_t>(point * light.groups);
  };
  return {light.groups, light.samples, {at(first), at(end)}};
}

struct PointMeter::World {
  explicit World(const View& view)
      : scene(view.scene()), world(view.world()), tracer(view.tracer()), lamps(scene, world) {}
  explicit World(std::shared_ptr<const StandingScene> standing)
      : kept(std::move(standing)),
        scene(kept->scene()),
        world(kept->world()),
        tracer(kept->tracer()),
        lamps(scene, world) {}
  std::shared_ptr<const StandingScene> kept;
  const Scene& scene;
  const sconce::World& world;
  const Tracer& tracer;
  Lamps lamps;
};

PointMeter::PointMeter(std::unique_ptr<World> world, std::vector<SurfacePoint> points, ReceiverKind kind)
    : world_(std::move(world)), points_(std::move(points)), kind_(kind) {
  light_.groups = world_->scene.groups.size();
  light_.values.resize(points_.size() * light_.groups);
}
PointMeter::PointMeter(const View& view, std::vector<SurfacePoint> points, ReceiverKind kind)
    : PointMeter(std::make_unique<World>(view), std::move(points), kind) {}
PointMeter::PointMeter(std::shared_ptr<const StandingScene> scene, std::vector<SurfacePoint> points,
                       ReceiverKind kind)
    : PointMeter(std::make_unique<World>(std::move(scene)), std::move(points), kind) {}
PointMeter::PointMeter(PointMeter&&) noexcept = default;
PointMeter::~PointMeter() = default;

void PointMeter::add(const View& view, std::vector<KnownLamp> lamps) {
  view_ = &view;
  added_ = std::move(lamps);
}

void PointMeter::add_known(const KnownLamp& lamp, int samples, const SolveContext& context,
                           const Progress& progress, std::vector<Rgb>& sum) const {
  std::vector<Rgb> light(points_.size());
  parallel_for(light.size(), 16, [&](std::size_t i) {
    progress.check();
    light[i] = lamp.direct[i] +
               final_gather(*view_, lamp.pages, points_[i], mix32(kGatherStream, static_cast<uint32_t>(i)),
                            static_cast<uint32_t>(light_.samples), static_cast<uint32_t>(samples));
  });
  float most = 0;
  for (const Rgb& e : light) most = std::max(most, luminance(e));
  for (std::size_t i = 0; i < light.size(); ++i) {
    const auto first = sum.begin() + static_cast<std::ptrdiff_t>(i * light_.groups);
    const bool reached = std::any_of(first, first + static_cast<std::ptrdiff_t>(light_.groups),
                                     [](const Rgb& e) { return !e.is_black(); });
    const bool leaks =
        !reached && (luminance(light[i]) < kLeak * most || !is_free(context, points_[i].position));
    if (!leaks) first[static_cast<std::ptrdiff_t>(lamp.group)] += light[i];
  }
}

void PointMeter::pass(int samples, const Progress& progress) {
  const World& w = *world_;
  BakeParams params;
  params.samples = samples;
  params.seed = ++passes_;
  const int taken = (samples + kBatches - 1) / kBatches * kBatches;
  const SolveContext context{w.scene, w.world, w.tracer, w.lamps};
  const auto solver = find_solver("path").prepare(context, params, progress);
  std::vector<Rgb> fresh(light_.values.size());
  parallel_for(points_.size(), 16, [&](std::size_t i) {
    progress.check();
    std::vector<GroupValue> values(light_.groups);
    solver->solve(Footprint::point(static_cast<uint32_t>(i), kind_, points_[i]), values);
    for (std::size_t g = 0; g < values.size(); ++g) fresh[i * light_.groups + g] = values[g].illuminance;
  });
  for (const KnownLamp& lamp : added_) add_known(lamp, taken, context, progress, fresh);
  const float share = static_cast<float>(taken) / static_cast<float>(light_.samples + taken);
  for (std::size_t i = 0; i < fresh.size(); ++i)
    light_.values[i] = (1 - share) * light_.values[i] + share * fresh[i];
  light_.samples += taken;
}

LuxStatistics lux_statistics(std::span<const float> lux) {
  if (lux.empty()) return {};
  const auto [low, high] = std::minmax_element(lux.begin(), lux.end());
  return {static_cast<double>(*low),
          std::accumulate(lux.begin(), lux.end(), 0.0) / static_cast<double>(lux.size()),
          static_cast<double>(*high)};
}

std::vector<float> lux_of(const MeasuredLight& light, const MixSpec& mix, std::span<const uint8_t> left_out) {
  std::vector<float> lux;
  for (std::size_t point = 0; point < light.points(); ++point)
    if (left_out.empty() || left_out[point] == 0) lux.push_back(luminance(light.mixed(point, mix)));
  return lux;
}

LuxStatistics plane_statistics(const MeasuredLight& light, const MixSpec& mix) {
  return lux_statistics(lux_of(light, mix, unreached(light)));
}

std::vector<MeasuredPlane> baked_planes(const Package& package) {
  std::vector<MeasuredPlane> planes;
  for (PlaneLight& baked : read_planes(package))
    planes.push_back({baked.name,
                      baked.plane,
                      {package.manifest().groups.size(), baked.samples, std::move(baked.values)}});
  return planes;
}

std::vector<uint8_t> unreached(const MeasuredLight& light) {
  std::vector<uint8_t> dark;
  for (std::size_t point = 0; point < light.points(); ++point) {
    const auto first = light.values.begin() + static_cast<std::ptrdiff_t>(point * light.groups);
    dark.push_back(std::all_of(first, first + static_cast<std::ptrdiff_t>(light.groups),
                               [](const Rgb& e) { return e.is_black(); })
                       ? 1
                       : 0);
  }
  return dark;
}

}  // namespace sconce
