// SPDX-License-Identifier: Apache-2.0
// What every way to make an operator begins with: the cloud in its square, and what the file says of slots
// and receivers.
#pragma once

#include <atomic>

#include "core/parallel.h"
#include "relight/cloud_square.h"
#include "relight/precompute.h"

namespace sconce {

struct OperatorStart {
  /// @param leaf  receivers that stay together are multiples of it
  OperatorStart(const TracedScene& traced, const RelightReceivers& receivers, const TransferParams& params,
                std::size_t leaf, const Progress& progress);

  /// After samples or receivers moved: points of slots, middles and what the file says of them.
  void place(const RelightReceivers& receivers, const TransferParams& params);

  /// Receiver i of the file, which is `order[i]` of the source, at its middle.
  SurfacePoint middle(std::size_t i) const { return middles[order[i]]; }

  std::unique_ptr<GatherCloud> cloud;
  CloudSquare square;
  std::vector<uint32_t> order;        ///< of receivers: alike ones together
  std::vector<SurfacePoint> middles;  ///< of the source's receivers
  Operator op;                        ///< all but the matrices, their albedos and the scene's hash

  /// Those of receivers that mirror, in the same order: glossy(i) of each is there.
  std::vector<uint32_t> glossy(const RelightReceivers& receivers) const;
  /// An operator of the lobes of some receivers, by the same cloud and bounces: all but `gather`.
  /// @param whole  with its bounces
  Operator lobes(const Operator& whole, const RelightReceivers& receivers, std::span<const uint32_t> own,
                 const TransferParams& params) const;

 private:
  void place_middles(const RelightReceivers& receivers);
  void place_points(const RelightReceivers& receivers, const TransferParams& params);
};

/// Calls f(block) for this rank's blocks on all threads, and tells how many are done.
template <class F>
void for_blocks(std::size_t blocks, const char* stage, const TransferWork& work, const F& f) {
  const Progress& progress = work.progress;
  std::atomic<uint64_t> done = 0;
  progress.at(stage, 0, blocks);
  parallel_for(blocks, 1, [&](std::size_t b) {
    if (!work.ranks.mine(b)) return;
    progress.check();
    f(b);
    progress.at(stage, std::min<uint64_t>(done += static_cast<uint64_t>(work.ranks.count), blocks), blocks);
  });
}

}  // namespace sconce
