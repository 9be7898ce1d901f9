// SPDX-License-Identifier: Apache-2.0
#include "checkpoint.h"

#include <algorithm>
#include <cctype>

#include "core/error.h"

namespace fs = std::filesystem;

namespace sconce::app {

fs::path file_of_rank(fs::path path, int rank) {
  return rank == 0 ? path : path += "." + std::to_string(rank);
}

std::map<int, fs::path> files_of_others(const fs::path& path) {
  std::map<int, fs::path> found;
  const std::string start = path.filename().string() + ".";
  for (const auto& entry : fs::directory_iterator(path.has_parent_path() ? path.parent_path() : ".")) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(start) || name.size() > start.size() + 8) continue;
    const std::string number = name.substr(start.size());
    if (!number.empty() &&
        std::all_of(number.begin(), number.end(), [](unsigned char c) { return std::isdigit(c); }))
      found[std::stoi(number)] = entry.path();
  }
  return found;
}

namespace {

BakeState take_up(const fs::path& path, const BakeHeader& header) {
  BakeState state = BakeState::open(path, true);
  if (state.header().hash != header.hash)
    throw Error(path.string(), "belongs to another scene or other options, so it cannot be resumed",
                "the options of the first run, or no --resume");
  if (state.header().isa != header.isa)
    throw Error(path.string(), "was begun on another instruction set (" + state.header().isa + ")",
                header.isa);
  return state;
}

}  // namespace

Checkpoint::Checkpoint(const fs::path& path, const BakeHeader& header, bool resume, RankSession& session,
                       const Progress& progress)
    : path_(path) {
  const Ranks ranks = session.ranks();
  const fs::path own = file_of_rank(path, ranks.index);
  session.together([&] {
    if (ranks.index != 0 || resume) return;
    const auto stale = files_of_others(path);
    if (fs::exists(path) || !stale.empty())
      progress.warn(path.string() + " of an unfinished bake is replaced (--resume would have continued it)");
    std::error_code ignored;  // what stays in the way is its rank's error
    for (const auto& [rank, file] : stale) fs::remove(file, ignored);
  });
  session.together([&] {
    states_.push_back(resume && fs::exists(own) ? take_up(own, header) : BakeState::create(own, header));
    if (ranks.index != 0) return;
    for (const auto& [rank, file] : files_of_others(path))
      if (rank >= ranks.count) states_.push_back(take_up(file, header));
  });
}

std::vector<std::size_t> Checkpoint::todo(const BakeParams& params, Shard shard, const Ranks& ranks) const {
  std::vector<std::size_t> missing = missing_tiles(states_, params, shard);
  if (ranks.count == 1) return missing;
  std::string mine(states_.front().tiles(), 0);
  for (const std::size_t tile : missing) mine[tile] = 1;
  const std::vector<std::string> all = ranks.allgather(mine);
  std::erase_if(missing, [&](std::size_t tile) {
    return std::any_of(all.begin(), all.end(), [&](const std::string& rank) { return rank[tile] == 0; });
  });
  std::vector<std::size_t> share;
  for (std::size_t i = 0; i < missing.size(); ++i)
    if (ranks.mine(i)) share.push_back(missing[i]);
  return share;
}

std::vector<BakeState> Checkpoint::finish(RankSession& session) {
  const Ranks ranks = session.ranks();
  if (ranks.count == 1) return std::move(states_);
  states_.clear();
  session.together([] {});
  std::vector<BakeState> all;
  if (ranks.index != 0) return all;
  all.push_back(BakeState::open(path_, false));
  for (const auto& [rank, file] : files_of_others(path_)) all.push_back(BakeState::open(file, false));
  if (all.size() < static_cast<std::size_t>(ranks.count))
    throw Error(path_.string(), "the other ranks' files beside it cannot be seen",
                "a folder that all machines share");
  return all;
}

}  // namespace sconce::app
