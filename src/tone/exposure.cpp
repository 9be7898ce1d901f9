// SPDX-License-Identifier: Apache-2.0
#include "tone/exposure.h"

#include <algorithm>
#include <cmath>

namespace sconce {

namespace {

constexpr double kSaturation = 1.2;  // cd/m2 at EV100 0; see ev100_exposure()
constexpr double kDarkest = 1e-4;  // cd/m2; the metering's own offset

Exposure scaled(double scale, double maximum) {
  Exposure e;
  e.scale = static_cast<float>(std::clamp(scale, 1e-30, 1e30));
  e.params.maximum = static_cast<float>(std::clamp(scale * std::max(maximum, kDarkest), 1e-30, 1e30));
  return e;
}

}  // namespace

Exposure auto_exposure(double log_mean, double maximum, double stops) {
  return scaled(double{kMiddleGrey} * std::exp2(stops) / std::max(log_mean, kDarkest), maximum);
}

Exposure ev100_exposure(double ev100, double maximum) {
  return scaled(1.0 / (kSaturation * std::exp2(ev100)), maximum);
}

double ev100_of(const Exposure& exposure) {
  return -std::log2(kSaturation * static_cast<double>(exposure.scale));
}

Exposure unit_exposure(double maximum) {
  return scaled(1.0, maximum);
}

}  // namespace sconce
