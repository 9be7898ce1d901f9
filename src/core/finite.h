// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <span>

namespace sconce {

/// Index of the first value that is infinite or not a number.
inline std::optional<std::size_t> first_not_finite(std::span<const float> values) {
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i])) return i;
  return std::nullopt;
}

/// Whether no value is negative, infinite or not a number.
inline bool all_light(std::span<const float> values) {
  for (const float v : values)
    if (!(v >= 0 && std::isfinite(v))) return false;
  return true;
}

}  // namespace sconce
