// SPDX-License-Identifier: Apache-2.0
// Signed numbers as 8 bits, fine near zero: a code's square is the value (methods.md 2.5, "square-root
// companded").
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace sconce {

inline constexpr float kMostCode = 127;

/// @param scale  no |value| is larger; 0: all are 0
inline int8_t quantise(float value, float scale) {
  if (!(scale > 0)) return 0;
  const float code = std::round(kMostCode * std::sqrt(std::min(std::abs(value) / scale, 1.0f)));
  return static_cast<int8_t>(std::copysign(code, value));
}

inline float dequantise(int8_t code, float scale) {
  const float c = static_cast<float>(code);
  return c * std::abs(c) * (scale / (kMostCode * kMostCode));
}

}  // namespace sconce
