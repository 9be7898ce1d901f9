// SPDX-License-Identifier: Apache-2.0
// What is wrong or odd with a photometric file, beyond what its reader refuses.
#pragma once

#include <string>
#include <vector>

#include "photometry/photometry.h"

namespace sconce {

struct Finding {
  bool warning;  ///< else a remark
  std::string text;
};

/// Flux between what two ways of integrating the same table give: linear between its angles, and by the
/// trapezoid rule on I sin(gamma). Where the table's steps are too wide for its beam they differ. lm
struct FluxBounds {
  double low, high;
};
FluxBounds flux_bounds(const Photometry& photometry);

/// Reader's notes; flux stated against flux integrated (0.5 %); more light than the lamps have; gaps; planes
/// that disagree at nadir or zenith; tables that end while bright; a lamp without size.
std::vector<Finding> examine(const Photometry& photometry);

}  // namespace sconce
