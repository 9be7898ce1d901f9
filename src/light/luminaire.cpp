// SPDX-License-Identifier: Apache-2.0
#include "light/luminaire.h"

namespace sconce {

namespace {

Vec3 on_box(const Vec3& size, const Vec3& towards, Vec2 u) {
  const Vec3 faces(std::abs(towards.x) * size.y * size.z, std::abs(towards.y) * size.x * size.z,
                   std::abs(towards.z) * size.x * size.y);
  const float total = faces.x + faces.y + faces.z;
  if (!(total > 0)) {
    // A line, or a rectangle seen from its edge: points along what there is.
    const int longest = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    Vec3 p(0);
    p[longest] = (u.x - 0.5f) * size[longest];
    return p;
  }
  float at = u.x * total;
  const int face = at < faces.x ? 0 : at < faces.x + faces.y ? 1 : 2;
  at = (at - (face > 0 ? faces.x : 0) - (face > 1 ? faces.y : 0)) / faces[face];
  Vec3 p((at - 0.5f) * size);
  p[face] = std::copysign(0.5f * size[face], towards[face]);
  const int other = face == 2 ? 1 : 2;
  p[other] = (u.y - 0.5f) * size[other];
  return p;
}

/// Unit radius, z from -1 to 1, or the disk alone where `flat`.
Vec3 on_cylinder(const Vec3& towards, bool flat, Vec2 u) {
  const float sine = std::sqrt(std::max(0.0f, 1 - towards.z * towards.z));
  const float end = kPi * std::abs(towards.z), side = flat ? 0 : 4 * sine;
  const float at = u.x * (end + side);
  if (at >= side) {
    const Vec3 disk = square_to_cosine({end > 0 ? (at - side) / end : u.x, u.y});
    return {disk.x, disk.y, flat ? 0 : std::copysign(1.0f, towards.z)};
  }
  const float across = 2 * at / side - 1, out = std::sqrt(std::max(0.0f, 1 - across * across));
  const Vec2 ahead = Vec2(towards) / sine;
  return {out * ahead.x - across * ahead.y, out * ahead.y + across * ahead.x, 2 * u.y - 1};
}

/// Quantile u of the density (a + (b - a) s) sin over the polar angles from..to, degrees.
double polar_quantile(double from, double to, double a, double b, double u) {
  const double wanted = u * zone_integral(from, to, a, b);
  double low = from, high = to;
  for (int i = 0; i < 40; ++i) {
    const double mid = 0.5 * (low + high);
    const double value = a + (b - a) * (mid - from) / (to - from);
    (zone_integral(from, mid, a, value) < wanted ? low : high) = mid;
  }
  return 0.5 * (low + high);
}

/// Quantile u of a density that is linear from a to b over [0, 1].
double linear_quantile(double a, double b, double u) {
  const double root = std::sqrt(a * a + u * (b * b - a * a));
  return a + root > 0 ? u * (a + b) / (a + root) : u;
}

}  // namespace

Lamp make_luminaire(const Light& light, const Photometry& p) {
  LuminaireLamp lamp;
  lamp.table = &p;
  lamp.position = Vec3(light.frame[3]);
  lamp.to_world = Mat3(light.frame);
  lamp.scale = light.intensity;
  std::vector<double> cells;
  for (std::size_t a = 0; a + 1 < p.azimuths.size(); ++a)
    for (std::size_t g = 0; g + 1 < p.polars.size(); ++g)
      cells.push_back((p.azimuths[a + 1] - p.azimuths[a]) *
                      zone_integral(p.polars[g], p.polars[g + 1], p.at(a, g) + p.at(a + 1, g),
                                    p.at(a, g + 1) + p.at(a + 1, g + 1)));
  lamp.cells = AliasTable(cells);
  lamp.flux = flux(p);
  return {light.name, light.group, lamp, light.intensity * static_cast<float>(lamp.flux), false};
}

bool sample(const LuminaireLamp& lamp, const Vec3& x, Vec2 u, LightSample& out) {
  Vec3 local = (x - lamp.position) * lamp.to_world;
  if (!lamp.table->opening.is_point())
    local -= on_opening(lamp.table->opening, normalize_or(local, Vec3(0, 0, -1)), u);
  const float d2 = glm::dot(local, local);
  if (!(d2 > 1e-12f)) return false;
  const float d = std::sqrt(d2);
  local /= d;
  const auto candela = static_cast<float>(intensity(*lamp.table, local));
  if (candela <= 0) return false;
  // Just short of it: openings lie in the ceiling's plane more often than not.
  constexpr float kShort = 1 - 1e-4f;
  out = {lamp.to_world * -local, d * kShort, lamp.scale * (candela / d2), 1.0f, true};
  return true;
}

EmittedLight emit(const LuminaireLamp& lamp, Vec2 where, Vec2 whither) {
  const Photometry& p = *lamp.table;
  const std::size_t zones = p.polars.size() - 1, cell = lamp.cells.sample(whither.x);
  const std::size_t a = cell / zones, g = cell % zones;
  const double p0 = p.polars[g], p1 = p.polars[g + 1];
  // Within a cell the azimuth's density is linear, and so is intensity along the polar angle at an azimuth.
  const double t = linear_quantile(zone_integral(p0, p1, p.at(a, g), p.at(a, g + 1)),
                                   zone_integral(p0, p1, p.at(a + 1, g), p.at(a + 1, g + 1)),
                                   static_cast<double>(whither.x));
  const double i0 = p.at(a, g) + t * (p.at(a + 1, g) - p.at(a, g)),
               i1 = p.at(a, g + 1) + t * (p.at(a + 1, g + 1) - p.at(a, g + 1));
  const Vec3 local = direction_of(p.type, p.azimuths[a] + t * (p.azimuths[a + 1] - p.azimuths[a]),
                                  polar_quantile(p0, p1, i0, i1, static_cast<double>(whither.y)));
  const Vec3 at = p.opening.is_point() ? Vec3(0) : on_opening(p.opening, local, where);
  return {lamp.position + lamp.to_world * at, Vec3(0), lamp.to_world * local,
          lamp.scale * static_cast<float>(lamp.flux)};
}

bool dark_above(const Photometry& p) {
  for (std::size_t a = 0; a < p.azimuths.size(); ++a)
    for (std::size_t g = 0; g < p.polars.size(); ++g) {
      if (p.at(a, g) <= 0) continue;
      // The zone above a bright angle is bright too, unless the table ends there.
      const bool last = g + 1 == p.polars.size();
      if (p.type == Photometry::Type::c ? p.polars[g] > 90 || (p.polars[g] == 90 && !last)
                                        : std::abs(p.azimuths[a]) > 90)
        return false;
      if (p.type == Photometry::Type::c && !last && p.polars[g + 1] > 90) return false;
    }
  return true;
}

Vec3 on_opening(const Opening& opening, const Vec3& towards, Vec2 u) {
  if (opening.shape == Opening::Shape::box) return on_box(opening.size, towards, u);
  // A parallel projection stays one under scaling, so the silhouette of the unit shape serves for all.
  const Vec3 half = 0.5f * opening.size;
  const Vec3 scaled = normalize_or(towards / glm::max(half, Vec3(1e-6f)), Vec3(0, 0, -1));
  if (opening.shape == Opening::Shape::ellipsoid) {
    const Vec3 disk = square_to_cosine(u);
    return half * Frame(scaled).to_world(disk);
  }
  const int z = opening.axis, x = (z + 1) % 3, y = (z + 2) % 3;
  const bool flat = half[z] == 0;
  const Vec3 seen = flat ? Vec3(0, 0, 1) : Vec3(scaled[x], scaled[y], scaled[z]);
  const Vec3 p = on_cylinder(seen, flat, u);
  Vec3 out(0);
  out[x] = half[x] * p.x, out[y] = half[y] * p.y, out[z] = half[z] * p.z;
  return out;
}

}  // namespace sconce
