// SPDX-License-Identifier: Apache-2.0
#include "core/installed.h"

namespace fs = std::filesystem;

namespace sconce {

fs::path installed_file(const fs::path& name) {
  std::error_code ec;
  const fs::path folder = fs::read_symlink("/proc/self/exe", ec).parent_path();
  const fs::path installed = folder.parent_path() / "share/sconce" / name;
  return fs::exists(folder / name, ec) || !fs::exists(installed, ec) ? folder / name : installed;
}

}  // namespace sconce
