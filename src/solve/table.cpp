// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <string>

#include "core/program.h"
#include "solve/external.h"
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
      SolverRow{"external", "another program, once per group (docs/external-solvers.md)",
                &make_external_solver, true},
  };
  return kRows;
}

const SolverRow& find_solver(std::string_view name) {
  std::string names;
  for (const SolverRow& row : solvers()) {
    const std::string shown = std::string(row.name) + (row.runs_program ? ":CMD" : "");
    if (row.runs_program && (name == row.name || name.starts_with(std::string(row.name) + ":"))) {
      if (solver_command(name).empty())
        throw UsageError("--solver", "'" + std::string(name) + "' names no program", shown);
      command_words(solver_command(name));  // a lost quote is found before the work begins
      return row;
    }
    if (row.name == name) return row;
    names += (names.empty() ? "" : ", ") + shown;
  }
  throw UsageError("--solver", "unknown solver '" + std::string(name) + "'", names);
}

std::string solver_command(std::string_view name) {
  const std::size_t colon = name.find(':');
  return colon == std::string_view::npos ? "" : std::string(name.substr(colon + 1));
}

}  // namespace sconce
