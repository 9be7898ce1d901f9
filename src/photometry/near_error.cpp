// SPDX-License-Identifier: Apache-2.0
#include "photometry/near_error.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sconce {

namespace {

/// Of the widths of opening and lit place together: how far apart errors and changes lie.
constexpr double kReach = 1.0 / 8;
/// Of the mean size of the changes: covers 95 % of the errors of mirrors (ADR 39).
constexpr double kFactor = 2.6;

}  // namespace

NearError::NearError(const NearLamp& lamp) : lamp_(lamp), wide_(widened(lamp.field())) {}

double NearError::change(const Vec3& x, const Vec3& n) const {
  return wide_.approximate(x, n) - lamp_.approximate(x, n);
}

std::array<Vec3, NearError::kPlaces> NearError::places(const Vec3& x) const {
  const LightField& field = lamp_.field();
  const glm::dvec2 from = opening(field), to = field.pixel * glm::dvec2(field.width, field.height);
  const double depth = static_cast<double>(-x.z) / field.distance, narrow = std::max(from.x, from.y),
               reach = kReach * (2 * narrow + depth * (std::max(to.x, to.y) - narrow)),
               golden = std::numbers::pi * (3 - std::sqrt(5.0));
  std::array<Vec3, kPlaces> out;
  for (std::size_t i = 0; i < kPlaces; ++i) {  // a sunflower's seeds: even over the disk
    const double r = reach * std::sqrt((static_cast<double>(i) + 0.5) / kPlaces),
                 angle = golden * static_cast<double>(i);
    out[i] = Vec3(Vec2(r * glm::dvec2(std::cos(angle), std::sin(angle))), 0);
  }
  return out;
}

double NearError::at(const Vec3& x, const Vec3& n) const {
  if (!(x.z < 0)) return 0;
  double sum = 0;
  for (const Vec3& to : places(x)) sum += std::abs(change(x + to, n));
  return kFactor * sum / kPlaces;
}

}  // namespace sconce
