// SPDX-License-Identifier: Apache-2.0
#include "solve/timing.h"

#include <algorithm>

#include "core/parallel.h"

namespace sconce {

int samples_within(double seconds, Solver& solver, const TexelReceivers& receivers, std::size_t values,
                   const std::function<double()>& now) {
  constexpr int kTrial = 2 * kBatches, kMost = 1 << 24;
  constexpr std::size_t kBlocks = 64;
  constexpr double kMargin = 0.95;  // for the layers that are written afterwards
  solver.set_samples(kTrial);
  const double trial = std::min(1.0, seconds / 50);
  std::size_t tried = 0;
  double spent = 0;
  // Each turn takes other receivers, so that what one is like does not decide.
  for (std::size_t turn = 0; turn == 0 || (spent < trial && turn < 1000); ++turn) {
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
  const double each = spent / static_cast<double>(tried) / kTrial;  // a sample of a receiver
  const double samples = kMargin * (seconds - spent) / (each * static_cast<double>(receivers.size()));
  return static_cast<int>(std::clamp(samples, 1.0 * kBatches, 1.0 * kMost)) / kBatches * kBatches;
}

}  // namespace sconce
