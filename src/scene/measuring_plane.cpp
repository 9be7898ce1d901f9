// SPDX-License-Identifier: Apache-2.0
#include "scene/measuring_plane.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/text.h"

namespace sconce {

void MeasuringPlane::check() const {
  if (columns < 1 || rows < 1 || columns > 1000 || rows > 1000)
    throw UsageError({}, "a measuring plane needs points", "1 to 1000 columns and rows");
  if (!(glm::length(glm::cross(across, along)) > 1e-6f))
    throw UsageError({}, "a measuring plane needs an area");
}

Vec3 MeasuringPlane::point(int column, int row) const {
  const float u = (static_cast<float>(column) + 0.5f) / static_cast<float>(columns);
  const float v = (static_cast<float>(row) + 0.5f) / static_cast<float>(rows);
  return corner + u * across + v * along;
}

std::vector<SurfacePoint> MeasuringPlane::points() const {
  check();
  std::vector<SurfacePoint> all;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) all.push_back({point(column, row), normal(), normal()});
  return all;
}

MeasuringPlane horizontal_plane(const Bounds& bounds, float height, float spacing) {
  const Vec3 size = bounds.hi - bounds.lo;
  const auto margin = [](float side) { return std::min(0.5f, 0.1f * side); };
  const auto count = [&](float side) {
    return std::clamp(static_cast<int>(std::ceil(side / std::max(spacing, 0.01f))), 1, 200);
  };
  MeasuringPlane plane;
  plane.corner = {bounds.lo.x + margin(size.x), bounds.lo.y + height, bounds.hi.z - margin(size.z)};
  plane.across = {size.x - 2 * margin(size.x), 0, 0};
  plane.along = {0, 0, -(size.z - 2 * margin(size.z))};
  plane.columns = count(plane.across.x), plane.rows = count(-plane.along.z);
  return plane;
}

MeasuringPlane spanned_plane(const Vec3& corner, const Vec3& across, const Vec3& along, double spacing) {
  const float a = glm::length(across), b = glm::length(along);
  if (!(a > 0 && b > 0) || std::abs(glm::dot(across, along)) > 1e-3f * a * b)
    throw UsageError({}, "the plane's edges are not at right angles");
  const auto count = [&](float side) {
    return std::max(1, static_cast<int>(std::ceil(static_cast<double>(side) / spacing - 1e-4)));
  };
  MeasuringPlane plane{corner, across, along, count(a), count(b)};
  plane.check();
  return plane;
}

std::optional<float> height_over_floor(std::string_view text) {
  if (!text.starts_with("floor+")) return std::nullopt;
  const auto height = parse_number(text.substr(6));
  if (!height) return std::nullopt;
  return static_cast<float>(*height);
}

}  // namespace sconce
