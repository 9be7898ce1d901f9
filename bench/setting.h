// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>
#include <initializer_list>
#include <string>
#include <vector>

/// A benchmark's setting from the environment.
inline std::string setting(const char* name, const char* otherwise) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : otherwise;
}

/// The scenes that the command line names, or those of these names below SCONCE_TEST_DATA.
inline std::vector<std::string> scenes_of(int argc, char** argv,
                                          std::initializer_list<const char*> otherwise) {
  std::vector<std::string> scenes(argv + 1, argv + argc);
  if (scenes.empty())
    for (const char* name : otherwise)
      scenes.push_back(setting("SCONCE_TEST_DATA", "../shared/data") + "/glb/" + name + ".glb");
  return scenes;
}
