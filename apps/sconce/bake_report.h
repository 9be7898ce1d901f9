// SPDX-License-Identifier: Apache-2.0
// What `bake` and `merge` print.
#pragma once

#include "bake_job.h"

namespace sconce::app {

/// What a bake would do, for `--dry-run`: lines for a person, or JSON.
/// @param seconds  that it would take here; not known = a program would bake
void print_plan(const PreparedBake& bake, std::optional<double> seconds, bool json);

/// "name: 5 groups, 13 lamps, ..." lines for a person, or JSON.
void print_result(const PreparedBake& bake, const Manifest& manifest, const std::filesystem::path& output,
                  double seconds, bool json);

}  // namespace sconce::app
