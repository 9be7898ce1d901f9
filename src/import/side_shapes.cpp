// SPDX-License-Identifier: Apache-2.0
// [[light]] tables of lamps with a shape of their own: panels and projectors.
#include <fmt/format.h>

#include <glm/gtc/matrix_transform.hpp>

#include "core/error.h"
#include "core/finite.h"
#include "image/io.h"
#include "import/side_parts.h"

namespace sconce {

namespace {

/// I = cos(gamma), 1 cd straight ahead, of pi lm in the limit of fine steps; within 3e-5 of it.
Photometry lambert(const Opening& opening) {
  constexpr int kSteps = 90;
  Photometry out;
  out.azimuths = {0, 360};
  for (int g = 0; g <= kSteps; ++g) out.polars.push_back(90.0 * g / kSteps);
  for (int a = 0; a < 2; ++a)
    for (int g = 0; g <= kSteps; ++g)
      out.candela.push_back(g < kSteps ? std::cos(glm::radians(out.polars[static_cast<std::size_t>(g)])) : 0);
  out.opening = opening;
  out.absolute = true;
  out.format = "LM-63-2002";
  return out;
}

Image read_slide(const SideContext& context, const SideTable& table) {
  const auto file = table.text("file");
  if (!file) table.fail({}, "has no slide", "file = a picture beside this file");
  Image slide;
  try {
    slide = rgb_of(read_image(context.path.parent_path() / *file));
  } catch (const Error& e) {
    table.fail("file", e.what(), "a .png, .jpg, .hdr or .exr picture");
  }
  if (!all_light(slide.data)) table.fail("file", "has pixels that are negative or no numbers");
  return slide;
}

}  // namespace

void set_panel(const SideContext& context, const SideTable& table, Light& light) {
  const auto size = table.pair("size");
  const auto radius = table.positive("radius");
  if (size.has_value() == radius.has_value())
    table.fail(size ? "radius" : "", size ? "stands beside size" : "has no extent",
               "size = [width, height] or radius, metres");
  Opening opening;
  std::string name;
  if (size) {
    if (!((*size)[0] > 0 && (*size)[1] > 0))
      table.fail("size", "is not positive", "[width, height] in metres");
    opening.size = Vec3(static_cast<float>((*size)[0]), static_cast<float>((*size)[1]), 0);
    name = fmt::format("panel of {} x {} m", (*size)[0], (*size)[1]);
  } else {
    opening.shape = Opening::Shape::cylinder;
    opening.size = Vec3(2 * static_cast<float>(*radius), 2 * static_cast<float>(*radius), 0);
    name = fmt::format("disk of {} m radius", *radius);
  }
  context.scene.luminaires.push_back({name, lambert(opening)});
  light.shape = LuminaireLight{Id<Luminaire>(context.scene.luminaires.size() - 1)};
}

void set_projector(const SideContext& context, const SideTable& table, Light& light) {
  ProjectorLight out;
  Image slide = read_slide(context, table);
  out.yfov = glm::radians(static_cast<float>(table.positive("fov").value_or(40)));
  if (!(out.yfov < glm::radians(170.0f)))
    table.fail("fov", "is out of range", "degrees, vertical, below 170");
  out.aspect = static_cast<float>(table.positive("aspect").value_or(static_cast<double>(slide.width) /
                                                                    static_cast<double>(slide.height)));
  out.slide = std::make_shared<Image>(std::move(slide));
  light.shape = std::move(out);
}

}  // namespace sconce
