// SPDX-License-Identifier: Apache-2.0
// [[plane]] of a side file: measuring planes that are baked. No part of the scene, whose light they leave
// alone.
#include "core/error.h"
#include "import/import.h"
#include "import/side_parts.h"

namespace sconce {

namespace {

MeasuringPlane plane_of(const SideTable& table, const Bounds& bounds) {
  const double grid = table.positive("grid").value_or(0.5);
  const auto corner = table.vector("corner"), across = table.vector("across"), along = table.vector("along");
  const auto at = table.text("at");
  const bool spanned = corner && across && along;
  if (at.has_value() == spanned || (at && (corner || across || along)))
    table.fail({}, "has no place", "at = \"floor+0.75\", or corner, across and along = [x, y, z]");
  if (at) {
    const auto height = height_over_floor(*at);
    if (!height) table.fail("at", "'" + *at + "' is no height", "\"floor+0.75\"");
    return horizontal_plane(bounds, *height, static_cast<float>(grid));
  }
  try {
    return spanned_plane(*corner, *across, *along, grid);
  } catch (const UsageError& e) {
    table.fail("across", e.what());
  }
}

}  // namespace

std::vector<std::pair<std::string, MeasuringPlane>> import_planes(const std::filesystem::path& scene,
                                                                  const Bounds& bounds) {
  std::vector<std::pair<std::string, MeasuringPlane>> planes;
  const auto side = side_file_of(scene);
  if (!side) return planes;
  const SideNode root = parse_side_file(*side);
  for (const SideNode* node : side_tables(root, "plane")) {
    const SideTable table(side->string(), "[[plane]]", *node,
                          {"name", "at", "corner", "across", "along", "grid"});
    const auto name = table.text("name");
    if (!name || name->empty()) table.fail({}, "has no name", "name = \"...\"");
    for (const auto& [other, plane] : planes)
      if (other == *name) table.fail("name", "'" + *name + "' is taken", "another name");
    planes.emplace_back(*name, plane_of(table, bounds));
  }
  return planes;
}

}  // namespace sconce
