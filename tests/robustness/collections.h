// SPDX-License-Identifier: Apache-2.0
// Other people's test suites, file by file, and what became of each: docs/robustness.md.
#pragma once

#include <span>

#include "limited_run.h"

namespace sconce::robustness {

struct Collection {
  const char* name;
  const char* place;  ///< below conformance/: a folder or a .tar.xz
  const char* what;
};
std::span<const Collection> collections();

/// What became of the files of a collection.
struct Counts {
  std::size_t files = 0;
  std::size_t read = 0;                    ///< scenes and pictures
  std::size_t baked = 0;                   ///< of the scenes that were read, with 64 x 64 texels
  std::size_t refused = 0;                 ///< in one line that names the file
  std::size_t foreign = 0;                 ///< the same, because it is in no format that sconce reads
  std::size_t valid = 0;                   ///< a report without errors stands beside the file
  std::vector<std::string> valid_refused;  ///< with the reason
  std::vector<std::string> findings;
  double slowest = 0;  ///< seconds

  /// The row of the page's table.
  std::string row(const Collection& collection) const;
};

/// @param data  root of the shared data
/// @throws Error: the collection is not there
Counts try_all(const Collection& collection, const std::filesystem::path& data, const Program& program);

}  // namespace sconce::robustness
