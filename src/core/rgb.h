// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

namespace sconce {

/// A linear Rec. 709 colour triple. The unit (lux, cd/m2, reflectance) is its owner's.
struct Rgb {
  float r = 0, g = 0, b = 0;

  constexpr Rgb() = default;
  constexpr explicit Rgb(float v) : r(v), g(v), b(v) {}
  constexpr Rgb(float r_, float g_, float b_) : r(r_), g(g_), b(b_) {}

  constexpr Rgb& operator+=(const Rgb& o) { return r += o.r, g += o.g, b += o.b, *this; }
  constexpr Rgb& operator-=(const Rgb& o) { return r -= o.r, g -= o.g, b -= o.b, *this; }
  constexpr Rgb& operator*=(const Rgb& o) { return r *= o.r, g *= o.g, b *= o.b, *this; }
  constexpr Rgb& operator*=(float s) { return r *= s, g *= s, b *= s, *this; }
  friend constexpr Rgb operator+(Rgb a, const Rgb& o) { return a += o; }
  friend constexpr Rgb operator-(Rgb a, const Rgb& o) { return a -= o; }
  friend constexpr Rgb operator*(Rgb a, const Rgb& o) { return a *= o; }
  friend constexpr Rgb operator*(Rgb a, float s) { return a *= s; }
  friend constexpr Rgb operator*(float s, Rgb a) { return a *= s; }
  friend constexpr Rgb operator/(Rgb a, float s) { return a *= 1.0f / s; }
  friend constexpr bool operator==(const Rgb&, const Rgb&) = default;

  constexpr bool is_black() const { return r == 0 && g == 0 && b == 0; }
  constexpr float max() const { return std::max({r, g, b}); }
};

inline constexpr Rgb kRec709{0.2126f, 0.7152f, 0.0722f};
inline constexpr Rgb kRec601{0.299f, 0.587f, 0.114f};  ///< for gamma-coded video; system A's paper uses it

/// Luminance weight of a triple; with lux per channel in, lux out.
constexpr float luminance(const Rgb& c, const Rgb& weights = kRec709) {
  return c.r * weights.r + c.g * weights.g + c.b * weights.b;
}

/// IEC 61966-2-1 transfer, one channel, [0,1] both ways.
inline float srgb_to_linear(float v) {
  return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}
inline float linear_to_srgb(float v) {
  return v <= 0.0031308f ? v * 12.92f : 1.055f * std::pow(v, 1.0f / 2.4f) - 0.055f;
}

}  // namespace sconce
