// SPDX-License-Identifier: Apache-2.0
#include "core/kelvin.h"

#include <cmath>

#include "core/error.h"
#include "core/observer.h"

namespace sconce {

namespace {

constexpr double kSecondRadiation = 1.438776877e7;  // c2 = h c / k in nm K (CODATA 2018)
/// Unscaled Rec. 709 triple of a black body.
Xyz planck_rgb(double kelvin) {
  Xyz xyz{};
  for (int wavelength = 380; wavelength <= 770; wavelength += 10) {
    const double radiance =
        std::pow(wavelength / 560.0, -5) / std::expm1(kSecondRadiation / (wavelength * kelvin));
    const Xyz eye = observer(wavelength);
    for (std::size_t i = 0; i < 3; ++i) xyz[i] += eye[i] * radiance;
  }
  return rec709_of(xyz);
}

}  // namespace

Rgb kelvin_color(double kelvin) {
  if (!(kelvin >= kKelvinMin && kelvin <= kKelvinMax))
    throw UsageError({}, "colour temperature " + std::to_string(kelvin) + " K is out of range",
                     "1000 to 11000 K");
  const Xyz warm = planck_rgb(kelvin), white = planck_rgb(6504);
  Xyz c;
  for (std::size_t i = 0; i < 3; ++i) c[i] = std::max(0.0, warm[i] / white[i]);
  const double scale = 1 / (0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]);
  return {static_cast<float>(c[0] * scale), static_cast<float>(c[1] * scale),
          static_cast<float>(c[2] * scale)};
}

}  // namespace sconce
