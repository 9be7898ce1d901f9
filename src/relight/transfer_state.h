// SPDX-License-Identifier: Apache-2.0
// Finished rows of an operator on disk while it is made, so that an interrupted one goes on where it stopped.
#pragma once

#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>

namespace sconce {

/// Finished records, by cluster.
using TransferRecords = std::map<std::size_t, std::string>;
/// Those of files that other processes left. @throws Error when one belongs to another operator
TransferRecords read_transfer_records(std::span<const std::filesystem::path> files, const std::string& key);

class TransferState {
 public:
  /// @param key     names the operator; records of another one are not taken up
  /// @param resume  take up what is there; else it is replaced
  /// @param more    taken up, too
  /// @throws Error when it belongs to another operator, or cannot be written
  TransferState(const std::filesystem::path& path, const std::string& key, bool resume,
                TransferRecords more = {});
  /// A record that was taken up; empty where there is none.
  std::string_view find(std::size_t cluster) const;
  std::size_t size() const { return records_.size(); }
  /// Thread-safe; on disk when it returns.
  void put(std::size_t cluster, std::string_view bytes);
  /// Deletes the file: the operator stands.
  void remove();

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::filesystem::path path_;
  TransferRecords records_;
  std::unique_ptr<std::FILE, Close> file_;
  std::mutex mutex_;
};

}  // namespace sconce
