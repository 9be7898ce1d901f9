// SPDX-License-Identifier: Apache-2.0
// The gather cloud as a square of exactly a power of four of slots, alike ones together.
#pragma once

#include "gather/cloud.h"

namespace sconce {

/// Which sample stands at each slot of the square (along its Z-order curve). Where the cloud has fewer
/// samples than slots, the largest stand in several and share their weight.
struct CloudSquare {
  std::vector<uint32_t> samples;       ///< per slot
  std::vector<uint32_t> copies;        ///< per slot: which of its sample's slots it is
  std::vector<uint32_t> first, slots;  ///< CSR: slots of each sample

  std::span<const uint32_t> of(uint32_t sample) const {
    return {slots.data() + first[sample], slots.data() + first[sample + 1]};
  }
};

/// Samples that some rays from receivers, or from other samples, end on.
/// @return per sample: 1 where seen
std::vector<uint8_t> seen_samples(const World& world, const Tracer& tracer, const GatherCloud& cloud,
                                  const ReceiverSource& receivers, uint32_t seed);

/// @pre cloud.size() <= n
/// @param n         a power of four
/// @param seen      per sample; only these get slots. All, where none is seen
/// @param diagonal  of the scene's bounds, m
CloudSquare make_cloud_square(const GatherCloud& cloud, std::size_t n, std::span<const uint8_t> seen,
                              float diagonal);

/// A cloud of no more than `n` samples, nearly as many where the scene has room for them.
/// @throws UsageError when the scene's surfaces need more
std::unique_ptr<GatherCloud> make_cloud_of(const Scene& scene, const World& world, const Tracer& tracer,
                                           const ReceiverSource& receivers, std::size_t n, uint32_t seed,
                                           const Progress& progress = {});

}  // namespace sconce
