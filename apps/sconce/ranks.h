// SPDX-License-Identifier: Apache-2.0
// Many processes on one job. ranks_mpi.cpp is the only file that knows MPI; where it was not found at build
// time, ranks_none.cpp stands in and says so to whoever starts several.
#pragma once

#include <functional>
#include <stop_token>

#include "core/ranks.h"

namespace sconce::app {

/// This process and those that mpirun or srun started with it; alone without them. All but the first are
/// silenced: standard output and error lead nowhere.
class RankSession {
 public:
  /// @throws UsageError when several were started and cannot find each other
  RankSession();
  ~RankSession();
  RankSession(const RankSession&) = delete;
  RankSession& operator=(const RankSession&) = delete;

  Ranks ranks();
  /// A stop request ends waiting for other ranks, too.
  void watch(std::stop_token stop) { stop_ = std::move(stop); }

  /// Runs f on every rank and waits for all; f may exchange. Where it threw, so does every rank: its own
  /// error or the first other, named by its rank.
  void together(const std::function<void()>& f);
  /// Runs the job. An error that all ranks know is the first one's to tell; one that only this rank knows is
  /// printed and ends all of them.
  /// @return the exit code, 0 on all but the first rank
  int guard(const std::function<int()>& f);

 private:
  std::vector<std::string> exchange(std::string_view mine);
  std::vector<std::string> allgather(std::string_view mine) const;
  [[noreturn]] void abort(const std::string& line) const;

  int index_ = 0, count_ = 1;
  bool joined_ = false, all_failed_ = false;
  int errors_ = -1;  ///< where standard error led before
  std::stop_token stop_;
};

}  // namespace sconce::app
