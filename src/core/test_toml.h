// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace sconce {

/// Files that are no TOML, for every reader of it: the first three made toml++ 3.3 stop or read wrongly.
inline std::vector<std::string> broken_toml() {
  return {"[!\n",
          "\u00a1 = 1\n",
          "a =\u0499 1\n",
          "a = \n",
          "a = [1, 2\n",
          "a = {b = 1\n",
          "[t\n",
          "[t]\n[t]\n",
          "a = 1\na = 2\n",
          "a = \"x\n",
          "a = \"\\q\"\n",
          "a = 0x\n",
          "a = 99999999999999999999\n",
          "a = 2020-13-40\n",
          "a = 1 2\n",
          "= 1\n",
          "\xff = 1\n",
          "a = \"\xc3\"\n",
          std::string("a = \"\0\"\n", 8),
          "a = " + std::string(100000, '[') + "\n"};
}

}  // namespace sconce
