// SPDX-License-Identifier: Apache-2.0
#include "import/l3d_obj.h"

#include <fmt/format.h>

#include "core/error.h"
#include "core/text.h"
#include "photometry/lines.h"

namespace sconce {

namespace {

bool holds(const L3dSurface& surface, int group, int face) {
  for (const auto& [of, range] : surface.faces)
    if (of == group && range.first <= face && face <= range.second) return true;
  return false;
}

}  // namespace

std::string l3d_material(std::size_t surface) {
  return fmt::format("sconce_emits_{}", surface);
}

std::string marked_obj(std::string_view text, const std::vector<L3dSurface>& surfaces,
                       const std::string& where) {
  std::string out, material = "sconce_grey", in_use;
  std::vector<int> counts{0};  // faces of each group
  const auto use = [&](const std::string& wanted) {
    if (wanted != in_use) out += "usemtl " + wanted + "\n";
    in_use = wanted;
  };
  for (const std::string& raw : lines_of(text)) {
    const std::string line = trim(raw), keyword = line.substr(0, line.find_first_of(" \t"));
    // An `o` and the `g` after it are one group.
    if ((keyword == "g" || keyword == "o") && counts.back() > 0) counts.push_back(0);
    if (keyword == "usemtl") {
      material = trim(line.substr(keyword.size()));
      continue;
    }
    if (keyword == "f") {
      const int group = static_cast<int>(counts.size()) - 1, face = counts.back()++;
      std::string wanted = material;
      for (std::size_t i = 0; i < surfaces.size(); ++i)
        if (holds(surfaces[i], group, face)) wanted = l3d_material(i);
      use(wanted);
    }
    out += line + "\n";
  }
  for (const L3dSurface& surface : surfaces)
    for (const auto& [group, range] : surface.faces) {
      const int count =
          static_cast<std::size_t>(group) < counts.size() ? counts[static_cast<std::size_t>(group)] : 0;
      if (range.second >= count)
        throw Error(where, fmt::format("has {} faces in group {}, but '{}' names face {}", count, group,
                                       surface.name, range.second));
    }
  return out;
}

}  // namespace sconce
