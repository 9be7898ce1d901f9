// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/rgb.h"

namespace sconce::test {

/// What the fake solver writes in lux; no two texels, pages or groups (of names of different length) alike.
inline Rgb fake_value(const std::string& group, int page, int x, int y) {
  return {static_cast<float>(x) + 1, static_cast<float>(y) + 1,
          static_cast<float>(100 * page) + static_cast<float>(group.size())};
}

}  // namespace sconce::test
