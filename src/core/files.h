// SPDX-License-Identifier: Apache-2.0
// Write beside, then rename: what stands under a name is always whole.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace sconce {

/// Whole file as bytes. @throws Error naming the file
std::string read_file(const std::filesystem::path& path);

/// Writes beside the target, flushes and checks, renames. @throws Error naming the file; the target is then
/// untouched
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// A folder's path without the slash at its end.
std::filesystem::path without_slash(std::filesystem::path path);

/// A file or folder being written beside `target`. Removed on destruction unless commit() was called, and by
/// the next that is written there where its process was killed.
class Beside {
 public:
  explicit Beside(std::filesystem::path target);
  ~Beside();
  Beside(const Beside&) = delete;
  Beside& operator=(const Beside&) = delete;

  const std::filesystem::path& path() const { return temporary_; }
  /// write(path()). @throws Error as it does, naming the target instead
  void fill(const std::function<void(const std::filesystem::path&)>& write) const;
  /// Replaces the target (a folder, too) by what was written. @throws Error; the old target then still stands
  void commit();

 private:
  std::filesystem::path target_, temporary_;
  bool committed_ = false;
};

}  // namespace sconce
