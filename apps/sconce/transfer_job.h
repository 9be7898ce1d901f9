// SPDX-License-Identifier: Apache-2.0
// An operator from a package into it.
#pragma once

#include "picture_options.h"
#include "ranks.h"
#include "relight/package_operator.h"
#include "relight/precompute.h"

namespace sconce::app {

struct TransferJob {
  std::filesystem::path package;
  PictureOptions picture;  ///< its camera's pixels receive; the lightmap, where it names none
  TransferParams params;
  std::string options;  ///< as they were given, for people
  bool resume = false;
  bool lobes = true;  ///< of pixels that mirror, too
};

struct MadeOperator {
  MadeOperators operators;
  std::filesystem::path path, lobes_path;
};

/// Makes the operator, all ranks together, and writes it. @throws Error, UsageError; Cancelled
MadeOperator run_transfer_job(const TransferJob& job, RankSession& session, const Progress& progress);

}  // namespace sconce::app
