// SPDX-License-Identifier: Apache-2.0
// Makes a direct-to-indirect operator: cloud, rows of the final gather F and of the cloud's own kernel K by
// cosine-distributed rays that end on the cloud (methods.md 2.4), both as wavelet rows.
#pragma once

#include "relight/receivers.h"

namespace sconce {

struct TransferParams {
  std::size_t gather = 65536;    ///< slots of the cloud's square: a power of four, 256 to 65,536
  int rays = 512;                ///< per receiver
  int coefficients = 100;        ///< per receiver
  int bounce_coefficients = 40;  ///< per sample of the cloud
  int bounce_side = 4;           ///< bounces see the cloud in blocks of side x side slots: 1, 2, 4, ...
  int points = 4;                ///< per slot, where direct light is asked for
  Weighting weighting = Weighting::root_area;
  uint32_t seed = 1;
};

/// Rows stream through compression block by block; F is never held whole. The same bits at any number of
/// threads.
/// @param scene  hash that ties the file to its package: operator_scene()
/// @throws UsageError naming the option; Cancelled
Operator make_operator(const View& view, const RelightReceivers& receivers, const TransferParams& params,
                       const std::string& scene, const Progress& progress = {});

/// Identity of what an operator depends on in a package: geometry, materials, texels.
std::string operator_scene(const Package& package);

}  // namespace sconce
