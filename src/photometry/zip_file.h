// SPDX-License-Identifier: Apache-2.0
// Files inside of a zip: GLDF and L3D are such containers.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

struct zip;

namespace sconce {

class ZipFile {
 public:
  /// @param kind  of container, for errors: "GLDF"
  /// @throws NotMyFormat: no zip; Error: cut short, cannot be opened
  ZipFile(const std::filesystem::path& path, const std::string& kind);

  /// @param name  of a file inside, whatever its case @throws Error: not there, damaged, more than 64 MB
  std::string read(const std::string& name) const;
  /// Of all files inside, folders left out.
  std::vector<std::string> names() const;
  /// The container's own path, for errors.
  const std::string& where() const { return where_; }

 private:
  struct Close {
    void operator()(zip* opened) const;
  };
  std::string where_;
  std::unique_ptr<zip, Close> zip_;
};

}  // namespace sconce
