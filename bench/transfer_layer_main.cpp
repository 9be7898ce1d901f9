// SPDX-License-Identifier: Apache-2.0
// What a baked layer's indirect light has that an operator's has not, one term after the other, as Markdown:
// the solver `radiosity` as it bakes, then without what it does more finely than the cloud, then the
// operator. Usage: transfer_layer PACKAGE OPERATOR [TEXELS SAMPLES]: OPERATOR of texels, by 'transfer
// --method exact'. The table: docs/adr/0042-exact-operator.md.
#include <fmt/format.h>

#include <map>

#include "core/parallel.h"
#include "gather/rows.h"
#include "relight/cloud_square.h"
#include "relight/texel_light.h"
#include "solve/path_kernel.h"
#include "transfer/folded_bounces.h"
#include "words.h"

using namespace sconce;

namespace {

/// What receivers' rays read: as the solver's, but for two of its refinements.
struct Cache {
  const GatherCloud* cloud;
  const float *direct, *more;  ///< per cell; per sample
  float short_rays;            ///< in spacings: they go on as paths

  template <class Sums>
  bool read(const Hit& hit, uint32_t, const Rgb& throughput, const Sums& sums) const {
    const uint32_t cell = cloud->cell(hit);
    const Owner owner = cloud->owner(cell);
    if (owner.trust != Trust::whole || hit.distance < short_rays * cloud->spacing(owner.sample)) return false;
    const float *a = direct + sums.width() * cell, *b = more + sums.width() * owner.sample;
    for (std::size_t g = 0; g < sums.width(); g += 3)
      sums.add(g, throughput.r * (a[g] + b[g]), throughput.g * (a[g + 1] + b[g + 1]),
               throughput.b * (a[g + 2] + b[g + 2]));
    return true;
  }
};

using Lights = std::vector<std::vector<Rgb>>;  ///< per group, per texel: indirect, lux

class Layers {
 public:
  Layers(const View& view, const Operator& op, int texels, int samples)
      : view_(view), op_(op), lamps_(view.scene(), view.world()), groups_(view.scene().groups.size()) {
    params_.samples = samples;
    const std::size_t step = std::max<std::size_t>(1, op.places.size() / static_cast<std::size_t>(texels));
    for (uint32_t i = 0; i < op.places.size(); i += static_cast<uint32_t>(step)) chosen_.push_back(i);
  }

  /// @param direct  taken off
  Lights solve(const Solver& solver, const Lights& direct = {}) const {
    return each([&](const Footprint& f, std::span<GroupValue> out) { solver.solve(f, out); }, direct);
  }
  Lights by_solver(const char* name, int bounces, int samples, const Lights& direct = {}) const {
    BakeParams params = params_;
    params.bounces = bounces, params.samples = samples, params.cloud = static_cast<int>(op_.slots());
    const auto solver = find_solver(name).prepare(context(), params, {});
    return solve(*solver, direct);
  }

  /// Light on the cells of a cloud, and all bounces on its samples. @param even  one value for a sample
  struct OnCloud {
    std::vector<float> cells, samples;
  };
  OnCloud light(const GatherCloud& cloud, int rays, bool even) const {
    const std::size_t width = 3 * groups_;
    OnCloud out;
    out.cells.resize(width * cloud.cells());
    const auto at_point = [&]() -> DirectAtPoint {
      auto kernel =
          std::make_shared<PathKernel<Tracer>>(view_.scene(), view_.world(), view_.tracer(), lamps_, 0);
      return [kernel](const SurfacePoint& at, uint32_t stream, std::span<double> sums) {
        kernel->sample(Footprint::point(0, ReceiverKind::gather, at), stream, 0, FlatSums{sums});
      };
    };
    parallel_for(cloud.cells(), 1024, [&](std::size_t cell) {
      if (cloud.owner(static_cast<uint32_t>(cell)).trust != Trust::whole) return;
      PathKernel<Tracer> kernel(view_.scene(), view_.world(), view_.tracer(), lamps_, 0);
      std::vector<double> sums(width);
      constexpr uint32_t kSamples = 4;
      const Footprint footprint = cloud.cell_footprint(static_cast<uint32_t>(cell));
      for (uint32_t s = 0; s < kSamples; ++s)
        kernel.sample(footprint, mix32(1, static_cast<uint32_t>(cell)), s, FlatSums{sums});
      for (std::size_t g = 0; g < width; ++g)
        out.cells[width * cell + g] = static_cast<float>(sums[g] / kSamples);
    });
    if (even) {
      std::vector<float> sums(width);
      for (std::size_t i = 0; i < cloud.size(); ++i) {
        std::fill(sums.begin(), sums.end(), 0.0f);
        float area = 0;
        for (const uint32_t cell : cloud.owned(i)) {
          const float own = cloud.cell_footprint(cell).area;
          area += own;
          for (std::size_t g = 0; g < width; ++g) sums[g] += own * out.cells[width * cell + g];
        }
        for (const uint32_t cell : cloud.owned(i))
          for (std::size_t g = 0; g < width; ++g) out.cells[width * cell + g] = sums[g] / area;
      }
    }
    const Gathered gathered =
        gather(view_.world(), view_.tracer(), cloud, rays, 1, {groups_, out.cells, at_point});
    out.samples = bounce(gathered.rows, cloud, gathered.once, enough_bounces(gathered.rows, cloud));
    return out;
  }
  Lights by_cloud(const GatherCloud& cloud, const OnCloud& light, float short_rays,
                  const Lights& direct) const {
    const Cache cache{&cloud, light.cells.data(), light.samples.data(), short_rays};
    return each(
        [&](const Footprint& f, std::span<GroupValue> out) {
          PathKernel<Tracer, Cache> kernel(view_.scene(), view_.world(), view_.tracer(), lamps_, -1, {},
                                           cache);
          solve_receiver(kernel, f, params_, out);
        },
        direct);
  }
  Lights by_operator() const {
    const FoldedBounces bounces(op_);
    Lights out(groups_);
    std::vector<Rgb> all(op_.gather.rows);
    for (std::size_t g = 0; g < groups_; ++g) {
      const MovedGroup one{Id<LightGroup>(g), Rgb(1)};
      std::vector<Rgbx> light =
          light_cloud(op_, MovedLamps(view_.scene(), view_.world(), view_.tracer(), {}, {&one, 1}));
      bounces.indirect(light, all);
      for (const uint32_t i : chosen_) out[g].push_back(all[i]);
    }
    return out;
  }

  void texels(const RelightReceivers& receivers) {
    std::map<uint32_t, uint32_t> by_place;
    for (uint32_t i = 0; i < receivers.places.size(); ++i) by_place[receivers.places[i]] = i;
    for (const uint32_t i : chosen_)
      footprints_.push_back(receivers.source.footprint(by_place.at(op_.places[i])));
  }
  std::size_t count() const { return chosen_.size(); }

 private:
  SolveContext context() const { return {view_.scene(), view_.world(), view_.tracer(), lamps_}; }
  template <class Solve>
  Lights each(const Solve& solve, const Lights& direct) const {
    Lights out(groups_, std::vector<Rgb>(chosen_.size()));
    parallel_for(chosen_.size(), 4, [&](std::size_t k) {
      std::vector<GroupValue> values(groups_);
      solve(footprints_[k], values);
      for (std::size_t g = 0; g < groups_; ++g)
        out[g][k] = values[g].illuminance - (direct.empty() ? Rgb() : direct[g][k]);
    });
    return out;
  }

  const View& view_;
  const Operator& op_;
  Lamps lamps_;
  std::size_t groups_;
  BakeParams params_;
  std::vector<uint32_t> chosen_;  ///< receivers of the operator
  std::vector<Footprint> footprints_;
};

/// Relative RMSE over texels, mean over groups; and the ratio of means.
std::string beside(const Lights& have, const Lights& want) {
  double rmse = 0, ratio = 0;
  for (std::size_t g = 0; g < want.size(); ++g) {
    double squares = 0, sum = 0, expected = 0;
    for (std::size_t k = 0; k < want[g].size(); ++k) {
      const auto a = static_cast<double>(luminance(have[g][k])),
                 b = static_cast<double>(luminance(want[g][k]));
      squares += (a - b) * (a - b), sum += a, expected += b;
    }
    const auto n = static_cast<double>(want[g].size()), groups = static_cast<double>(want.size());
    rmse += std::sqrt(squares / n) / (expected / n) / groups, ratio += sum / expected / groups;
  }
  return fmt::format("{:.4f}, {:.2f} %", ratio, 100 * rmse);
}

void report(const Words& words) {
  const Package package = Package::open(words.name(1));
  const View view(package);
  const Operator op = open_operator(words.name(2));
  if (op.kind != OperatorReceivers::texels || op.gather.basis.values.empty())
    throw UsageError(words.name(2), "is not what this compares", "texels, by transfer --method exact");
  const int samples = words.number(4, 1024);
  Layers layers(view, op, words.number(3, 1000), samples);
  const RelightReceivers receivers = texel_receivers(package, view);
  layers.texels(receivers);

  const Lights direct = layers.by_solver("path", 0, samples),
               truth = layers.by_solver("path", -1, 4 * samples);
  Lights paths = truth;
  const Lights more = layers.by_solver("path", 0, 4 * samples);
  for (std::size_t g = 0; g < paths.size(); ++g)
    for (std::size_t k = 0; k < paths[g].size(); ++k) paths[g][k] = truth[g][k] - more[g][k];
  fmt::print("{}, {} texels, {} samples; mean and relative RMSE of indirect light\n\n", words.name(1),
             layers.count(), samples);
  fmt::print("| indirect light by | beside the row above | beside paths |\n|---|---|---|\n");
  Lights last;
  const auto row = [&](const char* name, Lights now) {
    fmt::print("| {} | {} | {} |\n", name, last.empty() ? "" : beside(now, last), beside(now, paths));
    std::fflush(stdout);
    last = std::move(now);
  };
  row("`radiosity`, as it bakes", layers.by_solver("radiosity", -1, samples, direct));
  const auto cloud =
      make_cloud_of(view.scene(), view.world(), view.tracer(), receivers.source, op.slots(), 1);
  constexpr int kRowRays = 256;
  constexpr float kShort = 2;  // as the solver
  const Layers::OnCloud fine = layers.light(*cloud, kRowRays, false);
  row("on the operator's cloud", layers.by_cloud(*cloud, fine, kShort, direct));
  row("short rays read it, too", layers.by_cloud(*cloud, fine, 0, direct));
  const Layers::OnCloud even = layers.light(*cloud, kRowRays, true);
  row("one value for a sample", layers.by_cloud(*cloud, even, 0, direct));
  row("the operator: its own rays, and light at some points of a sample", layers.by_operator());
}

}  // namespace

int main(int argc, char** argv) {
  return run_with_words(argc, argv, 2, "transfer_layer PACKAGE OPERATOR [TEXELS [SAMPLES]]", report);
}
