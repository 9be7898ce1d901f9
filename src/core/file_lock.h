// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace sconce {

/// Keeps other processes from writing the same file or folder: holds TARGET.lock while it lives. The kernel
/// lets go of it when a process dies, however it dies. Where no lock can be made (read-only, file systems
/// without locks) there is none.
class FileLock {
 public:
  /// @throws Error naming the target and the process that holds it
  explicit FileLock(std::filesystem::path target);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  std::filesystem::path path_;
  int file_ = -1;
};

}  // namespace sconce
