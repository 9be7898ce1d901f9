// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "solve/solver.h"

namespace sconce {

std::unique_ptr<Solver> make_path_solver(const SolveContext& context, const BakeParams& params,
                                         const Progress& progress);

}  // namespace sconce
