// SPDX-License-Identifier: Apache-2.0
#include "core/observer.h"

#include <algorithm>
#include <cmath>

namespace sconce {

namespace {

constexpr double kFirst = 380, kStep = 10;  // nm
constexpr double kRec709Red[3] = {3.2404542, -1.5371385, -0.4985314};
constexpr double kRec709Green[3] = {-0.9692660, 1.8760108, 0.0415560};
constexpr double kRec709Blue[3] = {0.0556434, -0.2040259, 1.0572252};

// CIE 1931 2-degree colour matching functions, 380 to 770 nm. The analytic fit of Wyman, Sloan and Shirley
// (2013) is 1 % off in red at 2700 K, so the table it is.
constexpr Xyz kObserver[] = {
    {0.0014, 0.0000, 0.0065}, {0.0042, 0.0001, 0.0201}, {0.0143, 0.0004, 0.0679}, {0.0435, 0.0012, 0.2074},
    {0.1344, 0.0040, 0.6456}, {0.2839, 0.0116, 1.3856}, {0.3483, 0.0230, 1.7471}, {0.3362, 0.0380, 1.7721},
    {0.2908, 0.0600, 1.6692}, {0.1954, 0.0910, 1.2876}, {0.0956, 0.1390, 0.8130}, {0.0320, 0.2080, 0.4652},
    {0.0049, 0.3230, 0.2720}, {0.0093, 0.5030, 0.1582}, {0.0633, 0.7100, 0.0782}, {0.1655, 0.8620, 0.0422},
    {0.2904, 0.9540, 0.0203}, {0.4334, 0.9950, 0.0087}, {0.5945, 0.9950, 0.0039}, {0.7621, 0.9520, 0.0021},
    {0.9163, 0.8700, 0.0017}, {1.0263, 0.7570, 0.0011}, {1.0622, 0.6310, 0.0008}, {1.0026, 0.5030, 0.0003},
    {0.8544, 0.3810, 0.0002}, {0.6424, 0.2650, 0.0000}, {0.4479, 0.1750, 0.0000}, {0.2835, 0.1070, 0.0000},
    {0.1649, 0.0610, 0.0000}, {0.0874, 0.0320, 0.0000}, {0.0468, 0.0170, 0.0000}, {0.0227, 0.0082, 0.0000},
    {0.0114, 0.0041, 0.0000}, {0.0058, 0.0021, 0.0000}, {0.0029, 0.0010, 0.0000}, {0.0014, 0.0005, 0.0000},
    {0.0007, 0.0002, 0.0000}, {0.0003, 0.0001, 0.0000}, {0.0002, 0.0001, 0.0000}, {0.0001, 0.0000, 0.0000},
};

double dot(const double (&row)[3], const Xyz& v) {
  return row[0] * v[0] + row[1] * v[1] + row[2] * v[2];
}

}  // namespace

Xyz observer(double wavelength) {
  constexpr auto kLast = static_cast<double>(std::size(kObserver) - 1);
  const double at = (wavelength - kFirst) / kStep;
  if (!(at >= 0 && at <= kLast)) return {};
  const auto low = static_cast<std::size_t>(std::min(at, kLast - 1));
  const double t = at - static_cast<double>(low);
  Xyz out;
  for (std::size_t i = 0; i < 3; ++i) out[i] = (1 - t) * kObserver[low][i] + t * kObserver[low + 1][i];
  return out;
}

Xyz rec709_of(const Xyz& xyz) {
  return {dot(kRec709Red, xyz), dot(kRec709Green, xyz), dot(kRec709Blue, xyz)};
}

Xyz xyz_of(const Rgb& c) {
  const auto r = static_cast<double>(c.r), g = static_cast<double>(c.g), b = static_cast<double>(c.b);
  return {0.4124564 * r + 0.3575761 * g + 0.1804375 * b, 0.2126729 * r + 0.7151522 * g + 0.0721750 * b,
          0.0193339 * r + 0.1191920 * g + 0.9503041 * b};
}

Rgb color_of(const Xyz& xyz) {
  if (!(xyz[1] > 0)) return Rgb(1);
  const Xyz rgb = rec709_of(xyz);
  const Rgb out(static_cast<float>(rgb[0]), static_cast<float>(rgb[1]), static_cast<float>(rgb[2]));
  return out / luminance(out);
}

}  // namespace sconce
