// SPDX-License-Identifier: Apache-2.0
#include "scene/daylight.h"

#include <array>
#include <cmath>

#include "core/rgb.h"

namespace sconce {

namespace {

constexpr int kWidth = 512, kHeight = 256;
constexpr double kHalfPi = static_cast<double>(kPi) / 2;

double elevation(const Daylight& daylight) {
  return std::asin(std::clamp(static_cast<double>(daylight.sun.y), -1.0, 1.0));
}
double angle(const Vec3& a, const Vec3& b) {
  return std::acos(std::clamp(static_cast<double>(glm::dot(a, b)), -1.0, 1.0));
}
Rgb grey(double v) {
  return Rgb(static_cast<float>(v));
}

/// Moon and Spencer 1942; ISO 15469, CIE S 011 type 16: three times as bright at the zenith as at the
/// horizon.
Rgb overcast(const Daylight&, const Vec3& d) {
  return grey((1 + 2 * static_cast<double>(d.y)) / 3);
}
// IES Lighting Handbook, 9th ed., ch. 8: horizontal illuminance of skies over the sun's elevation.
constexpr double kOvercast = 10000;  // a common design value, whatever the sun
double overcast_lux(const Daylight&) {
  return kOvercast;
}
double clear_lux(const Daylight& daylight) {
  return 800 + 15500 * std::sqrt(std::max(0.0, std::sin(elevation(daylight))));
}

/// ISO 15469:2004 type 12, CIE standard clear sky of low turbidity: gradation and indicatrix.
Rgb clear(const Daylight& daylight, const Vec3& d) {
  constexpr double a = -1, b = -0.32, c = 10, e = 0.45, decay = -3;
  const double cosine = std::max(1e-3, static_cast<double>(d.y)), chi = angle(d, daylight.sun);
  const double gradation = 1 + a * std::exp(b / cosine);
  const double indicatrix =
      1 + c * (std::exp(decay * chi) - std::exp(decay * kHalfPi)) + e * std::cos(chi) * std::cos(chi);
  return grey(gradation * indicatrix);
}

using Perez = std::array<double, 5>;

double perez(const Perez& p, double cosine, double gamma) {
  const double c = std::cos(gamma);
  return (1 + p[0] * std::exp(p[1] / cosine)) * (1 + p[2] * std::exp(p[3] * gamma) + p[4] * c * c);
}

/// Preetham, Shirley, Smits 1999, appendix A.2: luminance in cd/m2 and chromaticity.
Rgb preetham(const Daylight& daylight, const Vec3& d) {
  const double t = daylight.turbidity, sun = kHalfPi - std::max(0.0, elevation(daylight));
  const Perez luminance = {0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251,
                           0.1206 * t - 2.5771, -0.0670 * t + 0.3703};
  const Perez in_x = {-0.0193 * t - 0.2592, -0.0665 * t + 0.0008, -0.0004 * t + 0.2125, -0.0641 * t - 0.8989,
                      -0.0033 * t + 0.0452};
  const Perez in_y = {-0.0167 * t - 0.2608, -0.0950 * t + 0.0092, -0.0079 * t + 0.2102, -0.0441 * t - 1.6537,
                      -0.0109 * t + 0.0529};
  const double chi = (4.0 / 9 - t / 120) * (2 * kHalfPi - 2 * sun);
  const double zenith = 1000 * ((4.0453 * t - 4.9710) * std::tan(chi) - 0.2155 * t + 2.4192);
  const double s2 = sun * sun, s3 = s2 * sun;
  const double x_zenith = t * t * (0.00166 * s3 - 0.00375 * s2 + 0.00209 * sun) +
                          t * (-0.02903 * s3 + 0.06377 * s2 - 0.03202 * sun + 0.00394) + 0.11693 * s3 -
                          0.21196 * s2 + 0.06052 * sun + 0.25886;
  const double y_zenith = t * t * (0.00275 * s3 - 0.00610 * s2 + 0.00317 * sun) +
                          t * (-0.04214 * s3 + 0.08970 * s2 - 0.04153 * sun + 0.00516) + 0.15346 * s3 -
                          0.26756 * s2 + 0.06670 * sun + 0.26688;
  const double cosine = std::max(1e-3, static_cast<double>(d.y)), gamma = angle(d, daylight.sun);
  const auto at = [&](const Perez& p, double value) {
    return value * perez(p, cosine, gamma) / perez(p, 1, sun);
  };
  const double level = std::max(0.0, at(luminance, zenith)), x = at(in_x, x_zenith), y = at(in_y, y_zenith);
  const double X = level * x / y, Z = level * (1 - x - y) / y;
  return {static_cast<float>(std::max(0.0, 3.2404542 * X - 1.5371385 * level - 0.4985314 * Z)),
          static_cast<float>(std::max(0.0, -0.9692660 * X + 1.8760108 * level + 0.0415560 * Z)),
          static_cast<float>(std::max(0.0, 0.0556434 * X - 0.2040259 * level + 1.0572252 * Z))};
}

constexpr SkyKind kKinds[] = {
    {"cie-overcast", "no sun, three times as bright at the zenith as at the horizon", overcast, overcast_lux,
     false},
    {"cie-clear", "ISO 15469 type 12: low turbidity, bright around the sun", clear, clear_lux, true},
    {"preetham", "clear to hazy by turbidity, in colour", preetham, nullptr, true},
};

Vec3 direction_of(int x, int y) {
  const double theta = static_cast<double>(kPi) * (y + 0.5) / kHeight;
  const double phi = 2 * static_cast<double>(kPi) * ((x + 0.5) / kWidth - 0.5);
  return {static_cast<float>(std::sin(theta) * std::sin(phi)), static_cast<float>(std::cos(theta)),
          static_cast<float>(-std::sin(theta) * std::cos(phi))};
}

}  // namespace

std::span<const SkyKind> sky_kinds() {
  return kKinds;
}

double horizontal_illuminance(const Image& sky) {
  double sum = 0;
  for (int y = 0; y < sky.height / 2; ++y) {
    const double top = std::cos(static_cast<double>(kPi) * y / sky.height);
    const double bottom = std::cos(static_cast<double>(kPi) * (y + 1) / sky.height);
    double row = 0;
    for (int x = 0; x < sky.width; ++x) row += static_cast<double>(luminance(sky.rgb_at(x, y)));
    sum += row / sky.width * static_cast<double>(kPi) * (top * top - bottom * bottom);
  }
  return sum;
}

Image sky_picture(const SkyKind& kind, const Daylight& daylight, double lux) {
  Image out = Image::rgb(kWidth, kHeight);
  for (int y = 0; y < kHeight / 2; ++y)
    for (int x = 0; x < kWidth; ++x) out.set_rgb(x, y, kind.radiance(daylight, direction_of(x, y)));
  if (lux == 0 && kind.illuminance != nullptr) lux = kind.illuminance(daylight);
  double given = horizontal_illuminance(out);
  if (lux > 0 && given > 0) {
    for (float& v : out.data) v = static_cast<float>(v * lux / given);
    given = lux;
  }
  const Rgb ground = grey(daylight.ground * given / static_cast<double>(kPi));
  for (int y = kHeight / 2; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) out.set_rgb(x, y, ground);
  return out;
}

double clear_sun_illuminance(double elevation_degrees) {
  constexpr double kOutside = 127500, kExtinction = 0.21;
  const double s = std::sin(elevation_degrees * static_cast<double>(kPi) / 180);
  return s > 0 ? kOutside * std::exp(-kExtinction / s) : 0;
}

}  // namespace sconce
