// SPDX-License-Identifier: Apache-2.0
// Light of moved lamps on a lightmap's texels, direct light too: what layers hold of lamps that leave them,
// and what exposure is metered on.
#pragma once

#include "relight/relight.h"

namespace sconce {

/// Direct light at the middles of an operator's receivers, lux: one look at each.
std::vector<Rgb> direct_at_middles(const Operator& op, const MovedLamps& lamps);

/// Direct light over an operator's texels, lux: a mean of many shadow rays for each.
/// @param texels  of the same package, by place
std::vector<Rgb> direct_over_texels(const Operator& op, const RelightReceivers& texels,
                                    const MovedLamps& lamps, const Progress& progress = {});

/// The lamps' direct light and, by the operator, their indirect light. Per receiver, lux.
std::vector<Rgb> with_indirect(std::vector<Rgb> direct, const Package& package, const View& view,
                               const Operator& op, const FoldedBounces& bounces, const MovedLamps& lamps);

/// What layers hold of lamps that stand in them: direct light over texels, by shadow rays, and indirect light
/// by the operator. Per receiver, lux.
/// @param lamps  where they were baked, with the weights of their groups
/// @pre op is of texels
std::vector<Rgb> lightmap_share(const Package& package, const View& view, const Operator& op,
                                const FoldedBounces& bounces, const MovedLamps& lamps,
                                const Progress& progress = {});

/// Takes it out of mixed pages; what noise leaves below zero is darkness.
void take_share(const Atlas& atlas, const Operator& op, std::span<const Rgb> share,
                std::vector<Image>& pages);

}  // namespace sconce
