// SPDX-License-Identifier: Apache-2.0
#include "session/remembered.h"

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/files.h"

namespace fs = std::filesystem;

namespace sconce {

void Remembered::opened(const fs::path& file) {
  std::error_code ignored;
  const std::string path = fs::absolute(file, ignored).lexically_normal().string();
  std::erase(recent, path);
  recent.insert(recent.begin(), path);
  recent.resize(std::min(recent.size(), kMostRecent));
}

fs::path remembered_file() {
  const char *state = std::getenv("XDG_STATE_HOME"), *home = std::getenv("HOME");
  if (state != nullptr && *state != '\0') return fs::path(state) / "sconce/view.json";
  return home != nullptr && *home != '\0' ? fs::path(home) / ".local/state/sconce/view.json" : fs::path();
}

Remembered remember(const fs::path& file) {
  Remembered found;
  try {
    const nlohmann::json json = nlohmann::json::parse(read_file(file));
    found.width = std::clamp(json.at("width").get<int>(), 640, 16384);
    found.height = std::clamp(json.at("height").get<int>(), 400, 16384);
    found.panel = std::clamp(json.at("panel").get<float>(), 280.0f, 900.0f);
    json.at("recent").get_to(found.recent);
  } catch (const std::exception&) {
    return {};
  }
  return found;
}

void keep(const Remembered& remembered, const fs::path& file) {
  if (file.empty()) return;
  std::error_code ignored;
  fs::create_directories(file.parent_path(), ignored);
  const nlohmann::json json = {{"width", remembered.width},
                               {"height", remembered.height},
                               {"panel", remembered.panel},
                               {"recent", remembered.recent}};
  try {
    write_file(file, json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
  } catch (const Error&) {
    // A window that cannot be remembered is still a window.
  }
}

}  // namespace sconce
