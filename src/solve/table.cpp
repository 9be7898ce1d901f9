// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <string>

#include "solve/path.h"
#include "solve/photon.h"
#include "solve/radiosity.h"

namespace sconce {

std::span<const SolverRow> solvers() {
  static constexpr std::array kRows{
      SolverRow{"radiosity", "final gather over a radiosity solution on a gather cloud, all groups at once",
                &make_radiosity_solver},
      SolverRow{"path", "unbiased path tracing with next-event estimation, all groups in one pass",
                &make_path_solver},
      SolverRow{"photon", "photon map with final gather: one map and one set of rays for all groups",
                &make_photon_solver},
  };
  return kRows;
}

const SolverRow& find_solver(std::string_view name) {
  std::string names;
  for (const SolverRow& row : solvers()) {
    if (row.name == name) return row;
    names += (names.empty() ? "" : ", ") + std::string(row.name);
  }
  throw UsageError("--solver", "unknown solver '" + std::string(name) + "'", names);
}

}  // namespace sconce
