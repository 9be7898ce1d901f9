// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "solve/solver.h"

namespace sconce {

/// Photon map (Jensen 1996, 2001). Default: direct light at the receiver as in the path solver; its rays end
/// at their first hit, where the map's density is the illuminance of all groups. Where that density cannot be
/// trusted (PhotonMap::Density) or the ray is short, the ray goes on as a path.
/// BakeParams::samples = rays per receiver. A receiver's error is the spread of its rays: it holds what the
/// map's noise does to them, but not the map's bias, nor noise that all of them share.
std::unique_ptr<Solver> make_photon_solver(const SolveContext& context, const BakeParams& params,
                                           const Progress& progress);

}  // namespace sconce
