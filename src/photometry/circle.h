// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "photometry/photometry.h"

namespace sconce {

/// Gives a type C table of planes within [0, 360] those at 0 and 360, interpolated between its last and
/// first.
inline void close_circle(Photometry& p) {
  const std::size_t rows = p.polars.size();
  const double gap = p.azimuths.front() + 360 - p.azimuths.back();
  if (p.azimuths.back() < 360) {
    const double at = (360 - p.azimuths.back()) / gap;
    const std::vector<double> first(p.candela.begin(), p.candela.begin() + static_cast<std::ptrdiff_t>(rows)),
        last(p.candela.end() - static_cast<std::ptrdiff_t>(rows), p.candela.end());
    for (std::size_t g = 0; g < rows; ++g) p.candela.push_back(last[g] + at * (first[g] - last[g]));
    p.azimuths.push_back(360);
  }
  if (p.azimuths.front() > 0) {
    const std::vector<double> seam(p.candela.end() - static_cast<std::ptrdiff_t>(rows), p.candela.end());
    p.candela.insert(p.candela.begin(), seam.begin(), seam.end());
    p.azimuths.insert(p.azimuths.begin(), 0);
  }
}

}  // namespace sconce
