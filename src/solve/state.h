// SPDX-License-Identifier: Apache-2.0
// The state of a bake on disk: one checksummed record per finished tile, appended as tiles finish.
// Checkpoint, shard and input of the final assembly are the same file, so resuming and merging are unions of
// records.
#pragma once

#include <cstdio>
#include <filesystem>
#include <mutex>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "solve/solver.h"

namespace sconce {

/// What must agree for records to belong together, and `job`, free text from which the bake can be set up
/// again.
struct BakeHeader {
  std::string hash;     ///< of scene, seed, solver, bounces, atlas, basis, version (contract.md); not samples
  std::string isa;      ///< instruction set the kernels ran on
  uint32_t layers = 0;  ///< groups x coefficients of the basis
  uint64_t receivers = 0;
  uint32_t tile_size = 0;
  std::string job;
};

class BakeState {
 public:
  /// Starts a new file. @throws Error when it cannot be written
  static BakeState create(const std::filesystem::path& path, const BakeHeader& header);
  /// Opens an existing file; a torn record at the end does not count.
  /// @param append  cut that off and go on; otherwise the file stays as it is
  /// @throws Error: not a bake state, or damaged
  static BakeState open(const std::filesystem::path& path, bool append);

  BakeState(BakeState&&) noexcept;
  ~BakeState();

  const BakeHeader& header() const { return header_; }
  const std::filesystem::path& path() const { return path_; }
  std::size_t tiles() const;
  /// Thread-safe, as made_with().
  bool has(std::size_t tile) const;
  /// Options the tile's record was made with (samples, noise); a record with others must be made again.
  /// @param tile  one that it has
  std::string made_with(std::size_t tile) const;

  /// Appends and flushes a tile's record, values[layer * count + i]. Thread-safe. @throws Error (disk full)
  void append(std::size_t tile, const std::string& made_with, std::span<const GroupValue> values);
  /// One layer's values of a finished tile. Thread-safe.
  std::vector<GroupValue> read(std::size_t tile, uint32_t layer) const;
  std::size_t receivers_of(std::size_t tile) const;

 private:
  BakeState() = default;
  /// @param size  of the file, bytes
  void scan(uint64_t size, bool repair);

  std::filesystem::path path_;
  BakeHeader header_;
  std::FILE* file_ = nullptr;
  mutable std::mutex mutex_;
  struct Record {
    uint64_t values_at = 0;  ///< in the file
    std::string made_with;
  };
  std::unordered_map<std::size_t, Record>
      records_;  // of finished tiles only: a header may promise any number
};

}  // namespace sconce
