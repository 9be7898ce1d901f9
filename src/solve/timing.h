// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "receive/atlas.h"
#include "solve/solver.h"

namespace sconce {

/// Samples per receiver that a solver gets done in about so many seconds on this machine: from a trial on
/// receivers spread over the atlas, which takes a fiftieth of the time, at most a second.
/// @param solver  takes any number of samples (Solver::set_samples); left with the trial's
/// @param values  of a receiver: groups x coefficients of the basis
/// @param now     seconds of a clock
/// @return a multiple of kBatches, at least that
int samples_within(double seconds, Solver& solver, const TexelReceivers& receivers, std::size_t values,
                   const std::function<double()>& now);

/// Seconds that all receivers take a solver as it was prepared, by a trial of about two seconds on some of
/// them. @param values, now  as above
double seconds_for(const Solver& solver, const TexelReceivers& receivers, std::size_t values,
                   const std::function<double()>& now);

}  // namespace sconce
