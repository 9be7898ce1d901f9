// SPDX-License-Identifier: Apache-2.0
// The state files of a bake: PATH of the first rank, PATH.1, PATH.2, ... of the others, on a file system that
// all of them see. Any number of ranks can go on with what another number left.
#pragma once

#include <filesystem>
#include <map>

#include "ranks.h"
#include "solve/bake.h"

namespace sconce::app {

/// What a rank of many writes: PATH itself for the first, PATH.N for the others.
std::filesystem::path file_of_rank(std::filesystem::path path, int rank);
/// Files PATH.N that are there, by N.
std::map<int, std::filesystem::path> files_of_others(const std::filesystem::path& path);

class Checkpoint {
 public:
  /// Takes up what is there (`resume`) or replaces it with a warning. All ranks together.
  /// @throws Error when it belongs to another bake
  Checkpoint(const std::filesystem::path& path, const BakeHeader& header, bool resume, RankSession& session,
             const Progress& progress);

  /// This rank's share of the shard's tiles that nobody has finished. All ranks together.
  std::vector<std::size_t> todo(const BakeParams& params, Shard shard, const Ranks& ranks) const;
  BakeState& own() { return states_.front(); }
  /// Closes the files; the first rank gets all of them back, to be read. All ranks together.
  std::vector<BakeState> finish(RankSession& session);

 private:
  std::filesystem::path path_;
  std::vector<BakeState> states_;  ///< this rank's, then, on the first rank, those without a rank
};

}  // namespace sconce::app
