// SPDX-License-Identifier: Apache-2.0
#include "session/look.h"

#include <algorithm>
#include <cmath>

#include "core/find_row.h"

namespace sconce {

namespace {

constexpr LookRow kRows[] = {
    {LookKind::picture, "picture", "Picture", "as a camera sees it", "", true},
    {LookKind::lux, "lux", "Illuminance", "light that arrives at surfaces", "lux"},
    {LookKind::luminance, "cd/m2", "Luminance", "light that leaves towards the eye", "cd/m\u00b2", true},
    {LookKind::lightmap, "lightmap", "Lightmap", "the light alone, on white surfaces", ""},
    {LookKind::noise, "noise", "Noise", "standard error of the mix, groups taken as independent", "%"},
    {LookKind::albedo, "albedo", "Albedo", "what surfaces reflect", ""},
    {LookKind::normals, "normals", "Normals", "where faces look to: x red, y green, z blue", ""},
    {LookKind::charts, "charts", "Charts", "squares of four lightmap texels, a colour for each page", ""},
    {LookKind::reference, "reference", "Reference", "picture left, path-traced right", ""},
};

}  // namespace

std::span<const LookRow> look_rows() {
  return kRows;
}

const LookRow& find_look(std::string_view name) {
  return find_row(look_rows(), name, "look");
}

FalseColor fitting_scale(double bright, bool decades) {
  const double wanted = std::max(bright, 4e-3), decade = std::pow(10.0, std::floor(std::log10(wanted)));
  double high = 10 * decade;
  for (const double round : {5.0, 2.0, 1.0})
    if (wanted <= round * decade) high = round * decade;
  if (decades) high = 10 * decade;
  return {.low = decades ? static_cast<float>(high * 1e-4) : 0.0f,
          .high = static_cast<float>(high),
          .decades = decades};
}

}  // namespace sconce
