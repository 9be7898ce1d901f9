// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "asked.h"
#include "mix/settings.h"
#include "rows.h"

namespace sconce::validation {

Section changed_lamps(const std::filesystem::path&) {
  Section out{
      "Lamps dimmed and re-coloured",
      "A bulb of (100, 50, 25) cd in the centre of a sphere of 1.5 m with reflectances (0.6, 0.5, 0.2), "
      "solved once; settings "
      "applied to the layer. Reference: E = I / (R² (1 − ρ)) with the bulb that the setting describes.",
      {}};
  constexpr const char* kChannels[] = {"red", "green", "blue"};
  constexpr double kRho[] = {0.6, 0.5, 0.2}, kBulb[] = {100, 50, 25}, kWeights[] = {0.2126, 0.7152, 0.0722};
  Scene scene;
  add_sphere(scene, "shell", add_material(scene, "tinted", Rgb(0.6f, 0.5f, 0.2f)), Vec3(0), 1.5f, 96, true);
  Light light;
  light.intensity = Rgb(100, 50, 25);
  scene.lights.push_back(light);
  const Asked asked(std::move(scene));
  const Rgb layer = asked.at(Vec3(0, -1.499f, 0), Vec3(0, 1, 0), -1);
  const GroupFlux flux = group_flux(asked.scene, asked.lamps).at(0);
  GroupInfo group;
  group.name = "bulb", group.lumens = flux.lumens, group.color = flux.color;
  double luminance = 0;
  for (int c = 0; c < 3; ++c) luminance += kWeights[c] * kBulb[c];
  // Planck's colour at 2700 K against 6504 K, luminance 1, from published chromaticities
  // (docs/adr/0003-kelvin.md); #ff8000 decoded from sRGB.
  constexpr double kWarm[] = {1.870, 0.8235, 0.1866};
  const double orange[] = {1, std::pow((128 / 255.0 + 0.055) / 1.055, 2.4), 0};
  const double orange_luminance = kWeights[0] * orange[0] + kWeights[1] * orange[1];
  struct Setting {
    const char* text;
    double bulb[3];
    double allowed;
  };
  const double lumens = 800 / (4 * kPiD) / luminance;
  const Setting settings[] = {
      {"on", {100, 50, 25}, 0.01},
      {"50%", {50, 25, 12.5}, 0.01},
      {"+1ev", {200, 100, 50}, 0.01},
      {"800lm", {100 * lumens, 50 * lumens, 25 * lumens}, 0.01},
      {"2700K", {kWarm[0] * luminance, kWarm[1] * luminance, kWarm[2] * luminance}, 0.012},
      {"2700K,25%", {kWarm[0] * luminance / 4, kWarm[1] * luminance / 4, kWarm[2] * luminance / 4}, 0.012},
      {"color:#ff8000",
       {orange[0] * luminance / orange_luminance, orange[1] * luminance / orange_luminance, 0},
       0.01},
      {"#ff8000", {100 * orange[0], 50 * orange[1], 0}, 0.01}};
  for (const Setting& s : settings) {
    const Rgb lit = group_weight(group, parse_setting(s.text), {}) * layer;
    const float channels[] = {lit.r, lit.g, lit.b};
    for (int c = 0; c < 3; ++c) {
      const double reference = s.bulb[c] / (2.25 * (1 - kRho[c])), ours = static_cast<double>(channels[c]);
      const bool dark = reference == 0;
      out.rows.push_back({fmt::format("`{}`, {}, lx", s.text, kChannels[c]), reference, ours,
                          dark ? 1e-9 : s.allowed, dark});
    }
  }
  return out;
}

}  // namespace sconce::validation
