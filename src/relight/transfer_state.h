// SPDX-License-Identifier: Apache-2.0
// Finished rows of an operator on disk while it is made, so that an interrupted one goes on where it stopped.
#pragma once

#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>

namespace sconce {

class TransferState {
 public:
  /// @param key     names the operator; records of another one are not taken up
  /// @param resume  take up what is there; else it is replaced
  /// @throws Error when it belongs to another operator, or cannot be written
  TransferState(const std::filesystem::path& path, const std::string& key, bool resume);
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
  std::map<std::size_t, std::string> records_;
  std::unique_ptr<std::FILE, Close> file_;
  std::mutex mutex_;
};

}  // namespace sconce
