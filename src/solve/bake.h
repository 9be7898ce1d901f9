// SPDX-License-Identifier: Apache-2.0
// Receivers in, tiles of values out.
#pragma once

#include "receive/seams.h"
#include "solve/state.h"

namespace sconce {

/// Which tiles a process bakes: those with tile % count == index.
struct Shard {
  uint32_t index = 0, count = 1;
};

/// Solves these tiles and appends them to `state`. Returns when done; what is finished is on disk even when
/// this throws. Same bits at any thread count and for any choice of tiles: a receiver's value depends on the
/// receiver alone.
/// @param wanted  per scene group: 1 = the state holds it, as SolveContext::wanted. Its values are ordered as
/// the solver's, [coefficient * groups + group].
/// @throws Cancelled, Error (disk full)
void bake_tiles(const Solver& solver, const BakeParams& params, const TexelReceivers& receivers,
                std::span<const uint8_t> wanted, std::span<const std::size_t> tiles, BakeState& state,
                const Progress& progress);

/// One finished layer: RGB lux per page, gaps filled, and the relative standard error per texel.
struct Layer {
  std::vector<Image> pages;
  std::vector<Image> noise;   ///< one channel
  double mean_lux = 0;        ///< area-weighted
  double relative_noise = 0;  ///< area-weighted rms of (error / mean of the layer)
};
/// @param values  per receiver
/// @param areas   per receiver, m2
/// @param seams   of the atlas, closed after that; null: texels stay as they were solved
Layer assemble_layer(std::span<const GroupValue> values, const Atlas& atlas, const TexelReceivers& receivers,
                     std::span<const float> areas, const Seams* seams);

/// One layer's values of all receivers.
/// @param states  their union must hold every tile, made with these params
/// @param layer   its place in the states
std::vector<GroupValue> collect_values(std::span<const BakeState> states, const BakeParams& params,
                                       uint32_t layer);

/// Tiles of the shard that none of the states holds with these params, ascending.
std::vector<std::size_t> missing_tiles(std::span<const BakeState> states, const BakeParams& params,
                                       Shard shard = {});

/// Text that names what a record was made with.
std::string made_with(const BakeParams& params);

}  // namespace sconce
