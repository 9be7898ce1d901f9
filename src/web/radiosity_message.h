// SPDX-License-Identifier: Apache-2.0
// What a page and RadiosityService say to each other.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace sconce::web {

/// As bytes: the JSON's length as 32 bits, the JSON, blanks up to a multiple of four bytes, floats; all with
/// the little end first.
struct RadiosityMessage {
  nlohmann::json head;
  std::vector<float> floats;

  std::string text() const;
  /// @throws Error where it is cut off or no JSON
  static RadiosityMessage read(const std::string& text);
};

}  // namespace sconce::web
