// SPDX-License-Identifier: Apache-2.0
// The lightmap denoiser: one linear filter, the same for all light groups, so that the denoised layers still
// add up.
#pragma once

#include <span>
#include <vector>

#include "core/progress.h"
#include "solve/solver.h"
#include "solve/texel_graph.h"

namespace sconce {

/// Every texel becomes a weighted mean of its neighbourhood (TexelGraph), weights at least 0 with sum 1. They
/// depend on distance, normals and, as in a cross-bilateral filter, on guides: the groups' own luminances,
/// filtered before, whose differences are measured in their standard errors. The group that differs most
/// decides, so a shadow edge of any group stops the filter for all, and
///   sum of denoised groups = denoised sum of groups
/// to float rounding. Where the noise is 0 the values stay; as it goes to 0 so does the filter.
/// @param values  per layer and receiver: illuminance and its standard error
/// @param guides  so many layers, from the first on, make the weights (the groups' E); the others, further
/// coefficients of a basis, are filtered with them
/// @return        of the same form; the error is what the weights leave of the noise, sqrt(sum w^2 error^2),
///                without the filter's own bias. Same bits at any thread count.
/// @throws Cancelled
std::vector<std::vector<GroupValue>> denoise(const TexelGraph& graph,
                                             std::span<const std::vector<GroupValue>> values,
                                             const Progress& progress = {},
                                             std::size_t guides = std::size_t(-1));

}  // namespace sconce
