// SPDX-License-Identifier: Apache-2.0
#include "photometry/ugr.h"

#include <cmath>
#include <numbers>

#include "core/error.h"
#include "photometry/position_index.h"

namespace sconce {

namespace {

constexpr double kPiD = std::numbers::pi, kDegree = kPiD / 180;
constexpr double kHeight = 2;  // metres above the eye; the table does not depend on it
constexpr int kPerHeight = 4;  // lamps in a row of one height

/// Form factor between parallel rectangles a x b at distance 1 (methods.md test 4).
double facing(double x, double y) {
  const double a = std::sqrt(1 + x * x), b = std::sqrt(1 + y * y);
  return 2 / (kPiD * x * y) *
         (std::log(a * b / std::sqrt(1 + x * x + y * y)) + x * b * std::atan(x / b) +
          y * a * std::atan(y / a) - x * std::atan(x) - y * std::atan(y));
}

/// Flux of one lamp: upwards, and downwards onto the plane of the eye or the walls of a room full of lamps.
struct Fluxes {
  double up = 0, floor = 0, walls = 0;
};
Fluxes fluxes(const Photometry& p, const UgrTable::Room& room, double turn) {
  Fluxes out;
  constexpr int kZones = 360, kPlanes = 144;
  for (int z = 0; z < kZones; ++z) {
    const double gamma = (z + 0.5) * 180 / kZones,
                 solid = std::sin(gamma * kDegree) * kPiD / kZones * 2 * kPiD / kPlanes;
    for (int i = 0; i < kPlanes; ++i) {
      const double c = (i + 0.5) * 360 / kPlanes, part = intensity_at(p, c, gamma) * solid;
      if (gamma > 90) {
        out.up += part;
        continue;
      }
      // Share of the lamps, evenly spread, whose ray reaches the plane of the eye before a wall.
      const double drift = std::tan(gamma * kDegree), angle = (c + turn) * kDegree;
      const double share = std::max(0.0, 1 - drift * std::abs(std::cos(angle)) / room.x) *
                           std::max(0.0, 1 - drift * std::abs(std::sin(angle)) / room.y);
      out.floor += part * share;
      out.walls += part * (1 - share);
    }
  }
  return out;
}

/// Illuminance that the walls get from the surfaces, not from the lamps; lux for `lamps` lamps.
double indirect_on_walls(const UgrTable::Room& room, const Fluxes& flux, double lamps,
                         const std::array<double, 3>& reflectances) {
  const double plane = room.x * room.y * kHeight * kHeight, sides = 2 * (room.x + room.y) * kHeight * kHeight;
  const double across = facing(room.x, room.y), to_wall = 1 - across, from_wall = to_wall * plane / sides;
  const double ceiling0 = lamps * flux.up / plane, floor0 = lamps * flux.floor / plane,
               walls0 = lamps * flux.walls / sides;
  double ceiling = ceiling0, floor = floor0, walls = walls0;
  const auto& [rc, rw, rf] = reflectances;
  for (int bounce = 0; bounce < 100; ++bounce) {  // 0.7 of it is left each time at most
    const double c = ceiling0 + across * rf * floor + to_wall * rw * walls;
    const double f = floor0 + across * rc * ceiling + to_wall * rw * walls;
    walls = walls0 + from_wall * (rc * ceiling + rf * floor) + (1 - 2 * from_wall) * rw * walls;
    ceiling = c, floor = f;
  }
  return walls - walls0;
}

/// Sum of L2 w / p2 over all lamps, seen from the middle of a wall.
double glare(const Photometry& p, const UgrTable::Room& room, double turn) {
  double sum = 0;
  const int columns = static_cast<int>(room.x * kPerHeight), rows = static_cast<int>(room.y * kPerHeight);
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const double lateral = (column + 0.5) / kPerHeight - room.x / 2, ahead = (row + 0.5) / kPerHeight;
      const auto index = position_index(std::abs(lateral) / ahead, 1 / ahead);
      if (!index) continue;
      const double r = std::sqrt(lateral * lateral + ahead * ahead + 1);
      // From the lamp to the eye; the plane at angle 0 of the room looks to the side, at 90 ahead.
      const double c = std::atan2(-ahead, -lateral) / kDegree - turn;
      const double gamma = std::acos(1 / r) / kDegree, azimuth = c - 360 * std::floor(c / 360);
      const double candela = intensity_at(p, azimuth, gamma);
      const double area = projected_area(p.opening, direction_of(Photometry::Type::c, azimuth, gamma));
      const double distance = r * kHeight;
      sum += candela * candela / (area * distance * distance * *index * *index);
    }
  return sum;
}

}  // namespace

double projected_area(const Opening& opening, const Vec3& direction) {
  const auto size = glm::dvec3(opening.size), d = glm::abs(glm::dvec3(direction));
  if (opening.shape == Opening::Shape::box)
    return d.x * size.y * size.z + d.y * size.x * size.z + d.z * size.x * size.y;
  const glm::dvec3 r = 0.5 * size;
  if (opening.shape == Opening::Shape::ellipsoid)
    return kPiD * std::sqrt(std::pow(r.y * r.z * d.x, 2) + std::pow(r.x * r.z * d.y, 2) +
                            std::pow(r.x * r.y * d.z, 2));
  const int z = opening.axis, x = (z + 1) % 3, y = (z + 2) % 3;
  return kPiD * r[x] * r[y] * d[z] +
         size[z] * 2 * std::sqrt(std::pow(r[x] * d[y], 2) + std::pow(r[y] * d[x], 2));
}

UgrTable ugr_table(const Photometry& given) {
  const Photometry p = as_type_c(given);
  if (!(p.opening.size.x > 0 && p.opening.size.y > 0))
    throw Error("UGR", "needs the size of the luminous opening, which the file does not give");
  UgrTable out;
  for (std::size_t i = 0; i < out.values.size(); ++i) {
    const UgrTable::Room& room = UgrTable::kRooms[i];
    const double lamps = room.x * room.y * kPerHeight * kPerHeight;
    for (std::size_t view = 0; view < 2; ++view) {
      const double turn = view == 0 ? 90 : 0;
      const Fluxes flux = fluxes(p, room, turn);
      const double sum = glare(p, room, turn);
      for (std::size_t k = 0; k < UgrTable::kReflectances.size(); ++k) {
        const double background = indirect_on_walls(room, flux, lamps, UgrTable::kReflectances[k]) / kPiD;
        out.values[i][5 * view + k] = 8 * std::log10(0.25 / background * sum);
      }
    }
  }
  return out;
}

}  // namespace sconce
