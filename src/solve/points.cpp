// SPDX-License-Identifier: Apache-2.0
#include "solve/points.h"

#include <fmt/format.h>

#include <atomic>
#include <cmath>

#include "core/error.h"
#include "core/parallel.h"
#include "solve/path.h"
#include "solve/path_kernel.h"

namespace sconce {

namespace {

constexpr int kSamples = 2048;  // as `sconce probe` takes
constexpr double kNoise = 0.01;
constexpr uint32_t kLooks = 64;  // rays that find out where a probe is
constexpr std::size_t kMostProbes = 1'000'000;

/// The path tracer's parameters. Points differ in their random numbers from texels of the same number.
BakeParams points_params(const BakeParams& params) {
  BakeParams own = params;
  own.seed = mix32(params.seed, 0x706f696eu);
  own.basis = Basis::flat;
  return own;
}

/// A plane's least value is a figure by itself: noise would lower it.
BakeParams plane_params(const BakeParams& params) {
  BakeParams own = points_params(params);
  own.samples = std::max(own.samples, kSamples);
  own.noise = std::min(own.noise, kNoise);
  return own;
}

template <class Point>
void solve_points(std::size_t count, std::size_t values, const SolveContext& context,
                  const BakeParams& params, const char* stage, const Progress& progress, const Point& point) {
  const auto solver = make_path_solver(context, params, progress);
  std::atomic<uint64_t> done = 0;
  progress.at(stage, 0, count);
  parallel_for(count, 4, [&](std::size_t i) {
    progress.check();
    std::vector<GroupValue> out(values);
    point(i, *solver, out);
    progress.at(stage, ++done, count);
  });
}

/// Where the probes are along an axis: the first, and how many.
struct Stand {
  float first;
  double count;
};

/// The middle of a flat scene is its floor, where no probe may be.
Stand stand(const World& world, const Scene& scene, int axis, float spacing) {
  const float low = world.bounds.lo[axis], length = world.bounds.hi[axis] - low;
  if (length >= spacing / 4) {
    const double count = std::max(1.0, std::round(static_cast<double>(length / spacing)));
    return {low + (length - spacing * static_cast<float>(count - 1)) / 2, count};
  }
  double along = 0, against = 0;  // area that faces so, m2
  for (std::size_t t = 0; t < world.size(); ++t) {
    const auto faced = static_cast<double>(world.area(t) * world.face_normals[t][axis]);
    (faced > 0 ? along : against) += std::abs(faced);
    if (scene[world.materials[t]].double_sided) (faced > 0 ? against : along) += std::abs(faced);
  }
  const float middle = low + length / 2;
  if (against <= along / 2) return {middle + spacing / 2, 1};
  if (along <= against / 2) return {middle - spacing / 2, 1};
  return {middle - spacing / 2, 2};
}

}  // namespace

bool is_free(const SolveContext& context, const Vec3& position) {
  uint32_t backs = 0;
  for (uint32_t i = 0; i < kLooks; ++i) {
    const Hit hit = context.tracer.closest({position, square_to_sphere(sobol_pair(i, 0, 0))});
    if (hit && hit.back && !context.scene[context.world.materials[hit.triangle]].double_sided) ++backs;
  }
  return 2 * backs < kLooks;
}

void bake_plane(PlaneLight& plane, const SolveContext& context, const BakeParams& params,
                const Progress& progress) {
  const std::size_t groups = context.scene.groups.size();
  const std::vector<SurfacePoint> points = plane.plane.points();
  const BakeParams own = plane_params(params);
  plane.samples = own.samples;
  plane.values.resize(points.size() * groups);
  solve_points(points.size(), groups, context, own, "planes", progress,
               [&](std::size_t i, const Solver& solver, std::span<GroupValue> out) {
                 solver.solve(Footprint::point(static_cast<uint32_t>(i), ReceiverKind::plane, points[i]),
                              out);
                 for (std::size_t g = 0; g < groups; ++g) plane.values[i * groups + g] = out[g].illuminance;
               });
}

ProbeGrid bake_probes(float spacing, const SolveContext& context, const BakeParams& params,
                      const Progress& progress) {
  ProbeGrid grid;
  grid.spacing = spacing;
  grid.groups = context.scene.groups.size();
  double count = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const Stand along = stand(context.world, context.scene, axis, spacing);
    if (!((count *= along.count) <= static_cast<double>(kMostProbes)))
      throw UsageError("--probes", fmt::format("{} m gives too many probes", spacing),
                       fmt::format("a spacing that gives at most {}", kMostProbes));
    grid.size[static_cast<std::size_t>(axis)] = static_cast<int>(along.count);
    grid.origin[axis] = along.first;
  }
  grid.valid.resize(static_cast<std::size_t>(count));
  grid.values.resize(grid.valid.size() * grid.groups);
  solve_points(
      grid.probes(), 4 * grid.groups, context, points_params(params), "probes", progress,
      [&](std::size_t i, const Solver& solver, std::span<GroupValue> out) {
        const Vec3 up(0, 1, 0), at = grid.position(i);
        grid.valid[i] = is_free(context, at) ? 1 : 0;
        if (grid.valid[i] == 0) return;
        solver.solve(Footprint::point(static_cast<uint32_t>(i), ReceiverKind::probe, {at, up, up}), out);
        for (std::size_t g = 0; g < grid.groups; ++g)
          for (std::size_t k = 0; k < 4; ++k)
            grid.values[i * grid.groups + g][k] = out[k * grid.groups + g].illuminance;
      });
  return grid;
}

}  // namespace sconce
