// SPDX-License-Identifier: Apache-2.0
// Somebody else's program as a solver. What passes between the two: docs/external-solvers.md.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "solve/solver.h"

namespace sconce {

/// Runs BakeParams::command once per wanted group and keeps what it returns; receivers are texels of
/// SolveContext::atlas. The noise is not known: error = 0.
/// @throws UsageError without a command; Error without an atlas, or when a program fails or returns what
///         cannot be right (its files then stay in BakeParams::work_folder); Cancelled
std::unique_ptr<Solver> make_external_solver(const SolveContext& context, const BakeParams& params,
                                             const Progress& progress);

/// What the program gets and has to write, for one group.
struct ExternalJob {
  std::filesystem::path folder, file;          ///< job.json
  std::vector<std::filesystem::path> outputs;  ///< one per page
};
/// Writes scene, skies and job.json into `folder`; what stood there before goes. @throws Error
ExternalJob write_external_job(const SolveContext& context, const BakeParams& params, Id<LightGroup> group,
                               const std::filesystem::path& folder);

}  // namespace sconce
