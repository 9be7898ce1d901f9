// SPDX-License-Identifier: Apache-2.0
#include "solve/timing.h"

#include <algorithm>

#include "core/parallel.h"

namespace sconce {

namespace {

constexpr int kTrial = 2 * kBatches;

/// Seconds that one receiver takes, from some spread over the atlas; at least so long is tried.
struct Trial {
  double spent = 0, each = 0;

  Trial(double least, const Solver& solver, const TexelReceivers& receivers, std::size_t values,
        const std::function<double()>& now) {
    constexpr std::size_t kBlocks = 64;
    std::size_t tried = 0;
    // Each turn takes other receivers, so that what one is like does not decide.
    for (std::size_t turn = 0; turn == 0 || (spent < least && turn < 1000); ++turn) {
      const std::size_t count = std::min(receivers.size(), kBlocks << std::min<std::size_t>(turn, 8));
      const double start = now();
      parallel_for(count, 4, [&](std::size_t i) {
        std::vector<GroupValue> out(values);
        const std::size_t at = (i * receivers.size() + turn * 977) / count;
        solver.solve(receivers.footprint(at % receivers.size()), out);
      });
      spent += now() - start;
      tried += count;
    }
    each = spent / static_cast<double>(tried);
  }
};

}  // namespace

int samples_within(double seconds, Solver& solver, const TexelReceivers& receivers, std::size_t values,
                   const std::function<double()>& now) {
  constexpr int kMost = 1 << 24;
  constexpr double kMargin = 0.95;  // for the layers that are written afterwards
  solver.set_samples(kTrial);
  const Trial trial(std::min(1.0, seconds / 50), solver, receivers, values, now);
  const double each = trial.each / kTrial;  // a sample of a receiver
  const double samples = kMargin * (seconds - trial.spent) / (each * static_cast<double>(receivers.size()));
  return static_cast<int>(std::clamp(samples, 1.0 * kBatches, 1.0 * kMost)) / kBatches * kBatches;
}

double seconds_for(const Solver& solver, const TexelReceivers& receivers, std::size_t values,
                   const std::function<double()>& now) {
  const double all = static_cast<double>(receivers.size());
  return receivers.size() == 0 ? 0 : Trial(2, solver, receivers, values, now).each * all;
}

}  // namespace sconce
