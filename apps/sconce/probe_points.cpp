// SPDX-License-Identifier: Apache-2.0
#include "probe_points.h"

#include <cmath>
#include <iostream>
#include <iterator>
#include <sstream>

#include "core/error.h"
#include "core/files.h"
#include "core/text.h"
#include "picture_options.h"

namespace sconce::app {

namespace {

const std::string kForms = "floor+HEIGHT, or X,Y,Z/AX,AY,AZ/BX,BY,BZ: a corner and two edges";

/// @return nothing where there are neither three nor six numbers
std::optional<SurfacePoint> point_of(const std::vector<std::string>& words) {
  std::vector<float> v;
  for (const std::string& word : words) {
    const auto number = parse_number(word);
    if (!number || !std::isfinite(*number)) return std::nullopt;
    v.push_back(static_cast<float>(*number));
  }
  if (v.size() != 3 && v.size() != 6) return std::nullopt;
  Vec3 normal(0, 1, 0);
  if (v.size() == 6) {
    normal = {v[3], v[4], v[5]};
    if (!(glm::length(normal) > 0)) return std::nullopt;
    normal = glm::normalize(normal);
  }
  return SurfacePoint{{v[0], v[1], v[2]}, normal, normal};
}

}  // namespace

SurfacePoint parse_probe(const std::string& text, const std::string& where) {
  std::vector<std::string> words;
  for (const std::string& word : split(text, ',')) words.push_back(trim(word));
  const auto point = point_of(words);
  if (!point) throw UsageError(where, "'" + text + "' is no point", "X,Y,Z or X,Y,Z,NX,NY,NZ in metres");
  return *point;
}

std::vector<SurfacePoint> read_probes(const std::string& file) {
  std::string text;
  if (file == "-")
    text.assign(std::istreambuf_iterator<char>(std::cin), {});
  else
    text = read_file(file);
  std::vector<SurfacePoint> points;
  std::istringstream lines(text);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    std::istringstream words(line.substr(0, line.find('#')));
    const std::vector<std::string> all(std::istream_iterator<std::string>(words), {});
    if (all.empty()) continue;
    const auto point = point_of(all);
    if (!point)
      throw Error((file == "-" ? "standard input" : file) + ":" + std::to_string(number), "is no point",
                  "x y z or x y z nx ny nz");
    points.push_back(*point);
  }
  return points;
}

MeasuringPlane parse_plane(const std::string& text, const Bounds& bounds, double spacing,
                           const std::vector<std::string>& names) {
  const std::string where = "option '--plane'";
  if (text.starts_with("floor+")) {
    const auto height = height_over_floor(text);
    if (!height) throw UsageError(where, "'" + text + "' has no height", kForms);
    return horizontal_plane(bounds, *height, static_cast<float>(spacing));
  }
  const std::vector<std::string> parts = split(text, '/');
  if (parts.size() != 3)
    throw UsageError(where, "'" + text + "' is no plane",
                     kForms + (names.empty() ? "" : "; or baked: " + join(names, ", ")));
  return spanned_plane(parse_point(parts[0], "--plane"), parse_point(parts[1], "--plane"),
                       parse_point(parts[2], "--plane"), spacing);
}

}  // namespace sconce::app
