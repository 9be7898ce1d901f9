// SPDX-License-Identifier: Apache-2.0
// Receivers in, tiles of values out.
#pragma once

#include "receive/atlas.h"
#include "solve/state.h"

namespace sconce {

/// Which tiles this process bakes: those with tile % count == index.
struct Shard {
  uint32_t index = 0, count = 1;
};

/// Solves all tiles of the shard that `state` does not hold yet. Returns when done; what is finished is on
/// disk even when this throws. Same bits at any thread count and for any sharding: a receiver's value depends
/// on the receiver alone.
/// @throws Cancelled, Error (disk full)
void bake_tiles(const Solver& solver, const BakeParams& params, const TexelReceivers& receivers, Shard shard,
                BakeState& state, const Progress& progress);

/// One group's finished layer: RGB lux per page, gaps filled, and the relative standard error per texel.
struct Layer {
  std::vector<Image> pages;
  std::vector<Image> noise;   ///< one channel
  double mean_lux = 0;        ///< area-weighted
  double relative_noise = 0;  ///< area-weighted rms of (error / mean of the layer)
};
/// @param values  per receiver
/// @param areas   per receiver, m2
Layer assemble_layer(std::span<const GroupValue> values, const Atlas& atlas, const TexelReceivers& receivers,
                     std::span<const float> areas);

/// One group's values of all receivers.
/// @param states  their union must hold every tile
std::vector<GroupValue> collect_values(std::span<BakeState> states, uint32_t group);

/// Tiles that none of the states holds with these params.
std::vector<std::size_t> missing_tiles(std::span<BakeState> states, const BakeParams& params);

/// Text that names what a record was made with.
std::string made_with(const BakeParams& params);

}  // namespace sconce
