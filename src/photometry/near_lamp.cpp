// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "photometry/light_field.h"

namespace sconce {

namespace {

/// d2 / R4 between a point of S and one of M, 1/m2: eq. 8's geometric term.
double geometry(const LightField& field, const glm::dvec2& uv, const glm::dvec2& st) {
  const glm::dvec2 across = st - uv;
  const double d2 = field.distance * field.distance, r2 = glm::dot(across, across) + d2;
  return d2 / (r2 * r2);
}

/// Where the line from a point of S through x (below S) meets M.
glm::dvec2 onto_m(const LightField& field, const glm::dvec2& uv, const glm::dvec3& x) {
  return uv + (glm::dvec2(x) - uv) * (field.distance / -x.z);
}

/// Of the light from uv at x.
double cosine_at(const glm::dvec2& uv, const Vec3& x, const Vec3& normal) {
  const glm::dvec3 to = glm::dvec3(uv, 0) - glm::dvec3(x);
  return glm::dot(to, glm::dvec3(normal)) / glm::length(to);
}

}  // namespace

NearLamp::NearLamp(LightField field, double filter)
    : field_(std::move(field)), filter_(filter > 0 ? filter : field_.spacing) {
  const auto width = static_cast<std::size_t>(field_.width), height = static_cast<std::size_t>(field_.height);
  if (field_.irradiance.size() != field_.terms() * field_.pixels())
    throw Error("light field", "has images of another size than it says");
  const std::size_t stride = (width + 1) * (height + 1);
  areas_.assign(field_.terms() * stride, 0.0);
  for (std::size_t term = 0; term < field_.terms(); ++term) {
    double* table = &areas_[term * stride];
    const auto image = field_.image(term);
    const int columns = field_.columns;
    const glm::dvec2 c = field_.center(static_cast<int>(term) % columns, static_cast<int>(term) / columns);
    for (std::size_t t = 0; t < height; ++t) {
      double row = 0;
      for (std::size_t s = 0; s < width; ++s) {
        const glm::dvec2 st = field_.corner + field_.pixel * (glm::dvec2(s, t) + 0.5);
        row += static_cast<double>(image[t * width + s]) / geometry(field_, c, st);
        table[(t + 1) * (width + 1) + s + 1] = table[t * (width + 1) + s + 1] + row;
      }
    }
  }
}

double NearLamp::mean(std::size_t term, const glm::dvec2& st, double size) const {
  const auto width = static_cast<std::size_t>(field_.width), height = static_cast<std::size_t>(field_.height);
  const double* table = &areas_[term * (width + 1) * (height + 1)];
  // Images are constant over a pixel, so the integral to any point is bilinear in the table.
  const auto integral = [&](double x, double y) {
    x = std::clamp(x, 0.0, static_cast<double>(width)), y = std::clamp(y, 0.0, static_cast<double>(height));
    const auto i = std::min(static_cast<std::size_t>(x), width - 1),
               j = std::min(static_cast<std::size_t>(y), height - 1);
    const double fx = x - static_cast<double>(i), fy = y - static_cast<double>(j);
    const double* at = table + j * (width + 1) + i;
    return (at[0] * (1 - fx) + at[1] * fx) * (1 - fy) + (at[width + 1] * (1 - fx) + at[width + 2] * fx) * fy;
  };
  const glm::dvec2 at = (st - field_.corner) / field_.pixel;
  const double half = 0.5 * std::max(1.0, size / field_.pixel);
  return (integral(at.x + half, at.y + half) - integral(at.x - half, at.y + half) -
          integral(at.x + half, at.y - half) + integral(at.x - half, at.y - half)) /
         (4 * half * half);
}

double NearLamp::radiance(const glm::dvec2& uv, const glm::dvec2& st) const {
  const glm::dvec2 where = (st - field_.corner) / field_.pixel, at = (uv - field_.first) / field_.spacing;
  const auto s = static_cast<int>(std::floor(where.x)), t = static_cast<int>(std::floor(where.y));
  if (s < 0 || t < 0 || s >= field_.width || t >= field_.height) return 0;
  const std::size_t pixel =
      static_cast<std::size_t>(t) * static_cast<std::size_t>(field_.width) + static_cast<std::size_t>(s);
  const double reach = basis_reach(field_.basis);
  double sum = 0;
  for (int n = std::max(0, static_cast<int>(std::ceil(at.y - reach)));
       n <= std::min(field_.rows - 1.0, at.y + reach); ++n)
    for (int m = std::max(0, static_cast<int>(std::ceil(at.x - reach)));
         m <= std::min(field_.columns - 1.0, at.x + reach); ++m) {
      const std::size_t term = static_cast<std::size_t>(n) * static_cast<std::size_t>(field_.columns) +
                               static_cast<std::size_t>(m);
      sum += basis_at(field_.basis, at.x - m) * basis_at(field_.basis, at.y - n) *
             static_cast<double>(field_.irradiance[term * field_.pixels() + pixel]);
    }
  return sum / (geometry(field_, uv, st) * field_.spacing * field_.spacing);
}

double NearLamp::from(const glm::dvec2& uv, const Vec3& x) const {
  const glm::dvec3 to = glm::dvec3(uv, 0) - glm::dvec3(x);
  const double d2 = glm::dot(to, to);
  return to.z > 0 ? radiance(uv, onto_m(field_, uv, glm::dvec3(x))) * to.z / (d2 * std::sqrt(d2)) : 0;
}

double NearLamp::exact(const Vec3& x, const Vec3& normal, int points) const {
  if (!(x.z < 0)) return 0;
  // With D from uv to x and its depth z, light falls by z^2 / D^4 and the cosine n.(uv - x) / z; g of eq. 5
  // is z^4 / (d^2 D^4) along the same line. What is left is linear in uv, and pixels depend on u and v apart.
  struct Point {
    int pixel;
    double cosine;
  };
  const glm::dvec3 at(x), n(normal);
  const double reach = basis_reach(field_.basis), step = field_.spacing / points, depth = -at.z,
               stretch = field_.distance / depth;
  const auto reached = static_cast<int>(std::lround(2 * reach * points));  // by a filter, along an axis
  std::vector<double> weights;
  for (int i = 0; i < reached; ++i) weights.push_back(basis_at(field_.basis, (i + 0.5) / points - reach));
  const auto along = [&](int axis, int filters, int pixels) {
    std::vector<Point> out;
    for (int i = 0; i < (filters - 1) * points + reached; ++i) {
      const double to = field_.first[axis] - reach * field_.spacing + step * (i + 0.5) - at[axis],
                   pixel = std::floor((at[axis] + to * (1 - stretch) - field_.corner[axis]) / field_.pixel);
      out.push_back({pixel >= 0 && pixel < pixels ? static_cast<int>(pixel) : -1, n[axis] * to});
    }
    return out;
  };
  const std::vector<Point> us = along(0, field_.columns, field_.width),
                           vs = along(1, field_.rows, field_.height);
  double sum = 0;
  for (int row = 0; row < field_.rows; ++row)
    for (int column = 0; column < field_.columns; ++column) {
      const float* image =
          field_
              .image(static_cast<std::size_t>(row) * static_cast<std::size_t>(field_.columns) +
                     static_cast<std::size_t>(column))
              .data();
      const Point *u = &us[static_cast<std::size_t>(column * points)],
                  *v = &vs[static_cast<std::size_t>(row * points)];
      for (int j = 0; j < reached; ++j) {
        if (v[j].pixel < 0) continue;
        const float* line = image + v[j].pixel * field_.width;
        const double cosine = v[j].cosine + n.z * depth;
        double part = 0;
        for (int i = 0; i < reached; ++i)
          if (u[i].pixel >= 0)
            part += weights[static_cast<std::size_t>(i)] * std::max(0.0, u[i].cosine + cosine) *
                    static_cast<double>(line[u[i].pixel]);
        sum += weights[static_cast<std::size_t>(j)] * part;
      }
    }
  return sum * stretch * stretch / (depth * points * points);
}

double NearLamp::window(double depth) const {
  return filter_ * std::abs(1 - field_.distance / depth);
}

double NearLamp::facing(int m, int n, const glm::dvec3& x) const {
  const glm::dvec2 c = field_.center(m, n), across = c - glm::dvec2(x);
  const double depth = -x.z, d2 = glm::dot(across, across) + depth * depth;
  return depth / (d2 * std::sqrt(d2)) *
         mean(static_cast<std::size_t>(n) * static_cast<std::size_t>(field_.columns) +
                  static_cast<std::size_t>(m),
              onto_m(field_, c, x), window(depth));
}

void NearLamp::terms(const Vec3& x, std::span<double> out) const {
  std::size_t i = 0;
  for (int n = 0; n < field_.rows; ++n)
    for (int m = 0; m < field_.columns; ++m) out[i++] = x.z < 0 ? facing(m, n, glm::dvec3(x)) : 0;
}

double NearLamp::term(int m, int n, const Vec3& x, const Vec3& normal) const {
  const double cosine = cosine_at(field_.center(m, n), x, normal);
  return x.z < 0 && cosine > 0 ? cosine * facing(m, n, glm::dvec3(x)) : 0;
}

double NearLamp::approximate(const Vec3& x, const Vec3& normal) const {
  double sum = 0;
  for (int n = 0; n < field_.rows; ++n)
    for (int m = 0; m < field_.columns; ++m) sum += term(m, n, x, normal);
  return sum;
}

template <class Value, class Cosine>
double NearLamp::spread(const Vec3& x, double spacing, const Value& value, const Cosine& cosine) const {
  if (!(x.z < 0)) return 0;
  double error = 0, sum = 0;
  const double depth = static_cast<double>(-x.z), reach = basis_reach(field_.basis) * spacing / depth,
               frozen = spacing * std::abs(1 / field_.distance - 1 / depth);
  for (int n = 0; n < field_.rows; ++n)
    for (int m = 0; m < field_.columns; ++m) {
      const double light = value(m, n);
      if (light == 0) continue;
      const glm::dvec2 tangent = (field_.center(m, n) - glm::dvec2(glm::dvec3(x))) / depth;
      sum += light;
      error += std::abs(light) * (geometric_spread(glm::length(tangent), frozen) + reach * cosine(tangent));
    }
  return sum > 0 ? error / sum : 0;
}

double NearLamp::bound(const Vec3& x, const Vec3& normal) const {
  const glm::dvec3 n(normal);
  return spread(
      x, field_.spacing, [&](int m, int k) { return term(m, k, x, normal); },
      [&](const glm::dvec2& t) { return glm::length(glm::dvec2(n)) / glm::dot(n, glm::dvec3(t, 1)); });
}

double NearLamp::bound(const Vec3& x, std::span<const double> terms, double spacing) const {
  return spread(
      x, spacing,
      [&](int m, int n) {
        return terms[static_cast<std::size_t>(n) * static_cast<std::size_t>(field_.columns) +
                     static_cast<std::size_t>(m)];
      },
      [](const glm::dvec2& t) { return glm::length(t) / (1 + glm::dot(t, t)); });
}

double NearLamp::noise(const Vec3& x, const Vec3& n, double width) const {
  if (!(x.z < 0)) return 0;
  const double depth = static_cast<double>(-x.z), filter = window(depth);
  // Integral of the dual squared, per axis (methods.md 2.6). Filters see neighbouring squares of M, each with
  // its own rays; where these lie within a pixel, all see the same rays, and duals sum to 1.
  const double dual = field_.basis == NearBasis::bell ? 1.40113 : 2.8422,
               apart = 1 + (dual - 1) * std::min(1.0, filter / field_.pixel), scale = depth / field_.distance,
               area = (filter * filter + field_.pixel * field_.pixel) * scale * scale + width * width;
  return apart * std::sqrt(std::abs(approximate(x, n)) * field_.grain / area);
}

double NearLamp::illuminance(const Vec3& x, const Vec3& normal, double tolerance) const {
  return bound(x, normal) > tolerance ? exact(x, normal) : approximate(x, normal);
}

Photometry far_field(const NearLamp& lamp, double step) {
  const LightField& field = lamp.field();
  Photometry out;
  out.format = "light field";
  out.absolute = true;
  out.lamps = {LampSet{}};
  const int planes = static_cast<int>(std::lround(360 / step)),
            zones = static_cast<int>(std::lround(90 / step));
  for (int g = 0; g <= zones; ++g) out.polars.push_back(90.0 * g / zones);
  // Seen from so far that all filters are in one place: d2 E is the intensity.
  const float far = 1e4f * static_cast<float>(field.spacing * std::max(field.columns, field.rows));
  for (int a = 0; a <= planes; ++a) {
    out.azimuths.push_back(360.0 * a / planes);
    for (const double gamma : out.polars) {
      const Vec3 direction = direction_of(Photometry::Type::c, a < planes ? out.azimuths.back() : 0, gamma);
      const double e = lamp.approximate(far * direction, -direction);
      out.candela.push_back(std::max(0.0, e) * static_cast<double>(far) * static_cast<double>(far));
    }
  }
  // Steps are wider than a beam may be; the flux is known.
  const double table = flux(out), images = flux(field);
  for (double& candela : out.candela) candela *= table > 0 && images > 0 ? images / table : 1;
  return out;
}

LightField coarser(const NearLamp& lamp) {
  const LightField& field = lamp.field();
  LightField out = field;
  out.color.clear();
  out.columns = (field.columns + 1) / 2;
  out.rows = (field.rows + 1) / 2;
  out.spacing = 2 * field.spacing;
  out.first = field.first + 0.5 * field.spacing;
  out.irradiance.assign(out.terms() * out.pixels(), 0.0f);
  for (int n = 0; n < out.rows; ++n)
    for (int m = 0; m < out.columns; ++m) {
      const glm::dvec2 c = out.center(m, n);
      float* image = &out.irradiance[(static_cast<std::size_t>(n) * static_cast<std::size_t>(out.columns) +
                                      static_cast<std::size_t>(m)) *
                                     out.pixels()];
      for (int t = 0; t < out.height; ++t)
        for (int s = 0; s < out.width; ++s) {
          const glm::dvec2 st = out.corner + out.pixel * (glm::dvec2(s, t) + 0.5);
          double sum = 0;
          for (int j = 2 * n; j < std::min(2 * n + 2, field.rows); ++j)
            for (int i = 2 * m; i < std::min(2 * m + 2, field.columns); ++i)
              sum += lamp.towards(i, j, st - c);
          *image++ = static_cast<float>(sum * geometry(out, c, st));
        }
    }
  return out;
}

}  // namespace sconce
