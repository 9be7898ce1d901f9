// SPDX-License-Identifier: Apache-2.0
#include "photometry/light_field.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "core/error.h"
#include "core/rgb.h"

namespace sconce {

namespace {

/// Filters that may hold a point, and their weights, along one axis.
struct Filters {
  int begin = 0, count = 0;
  double weight[6];
};

/// What a builder weighs a ray by: the bell's dual, or the spline itself, whose dual is applied at the end.
Filters filters_at(NearBasis basis, double x) {
  const double reach = basis == NearBasis::bell ? 2 : 1.5;
  Filters out;
  out.begin = static_cast<int>(std::ceil(x - reach));
  out.count = static_cast<int>(std::floor(x + reach)) - out.begin + 1;
  for (int i = 0; i < out.count; ++i) {
    const double at = x - (out.begin + i);
    out.weight[i] = basis == NearBasis::bell ? bell_dual(at) : spline(at);
  }
  return out;
}

/// A spline's dual reaches on, a factor 0.43 a spacing; a bell's ends after two.
int margin_of(NearBasis basis) {
  return basis == NearBasis::bell ? 2 : 6;
}

/// Along an axis, for an opening of so many spacings.
int filters_for(NearBasis basis, double spacings) {
  return std::max(0, static_cast<int>(std::ceil(spacings - 1e-6))) + 2 * margin_of(basis) - 1;
}

/// Applies the dual to what was weighed by the splines themselves. @param sums  of one channel
void finish_splines(const LightField& field, double* sums) {
  const std::size_t pixels = field.pixels(), columns = static_cast<std::size_t>(field.columns),
                    rows = static_cast<std::size_t>(field.rows);
  for (std::size_t i = 0; i < pixels; ++i) {
    for (std::size_t n = 0; n < rows; ++n) spline_dual(sums + i + n * columns * pixels, columns, pixels);
    for (std::size_t m = 0; m < columns; ++m) spline_dual(sums + i + m * pixels, rows, columns * pixels);
  }
}

constexpr int kWide = 8;  // filters of twice the spacing that one may give something to

/// What one of a row of filters gives to those twice as wide, from `begin` on.
struct Shares {
  int begin = 0;
  std::array<double, kWide> of{};
};

/// @param at  its centre among the wide ones, in their spacings
Shares shares_at(NearBasis basis, double at) {
  constexpr int kPoints = 64;  // each with the same share of the filter's light
  Shares out{static_cast<int>(std::floor(at)) - kWide / 2 + 1, {}};
  for (int i = 0; i < kPoints; ++i) {
    const Filters wide = filters_at(basis, at + 0.5 * basis_quantile(basis, (i + 0.5) / kPoints));
    for (int k = 0; k < wide.count; ++k)
      out.of.at(static_cast<std::size_t>(wide.begin + k - out.begin)) += wide.weight[k] / kPoints;
  }
  return out;
}

std::size_t index(int column, int row, int columns) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
}

}  // namespace

LightField make_light_field(NearBasis basis, const Vec2& low, const Vec2& high, double spacing,
                            double distance, double half_extent, int pixels) {
  if (!(spacing > 0) || !(distance > 0) || !(half_extent > 0) || pixels < 1)
    throw Error("light field", "has a spacing, distance, extent or size that is not positive");
  LightField out;
  out.basis = basis;
  out.spacing = spacing;
  out.distance = distance;
  const glm::dvec2 size = glm::dvec2(high) - glm::dvec2(low),
                   center = 0.5 * (glm::dvec2(high) + glm::dvec2(low));
  out.columns = filters_for(basis, size.x / spacing);
  out.rows = filters_for(basis, size.y / spacing);
  out.first = center - 0.5 * spacing * glm::dvec2(out.columns - 1, out.rows - 1);
  out.width = out.height = pixels;
  out.pixel = 2 * half_extent / pixels;
  out.corner = center - glm::dvec2(half_extent);
  out.irradiance.assign(out.terms() * out.pixels(), 0.0f);
  return out;
}

LightFieldBuilder::LightFieldBuilder(LightField empty, bool colored)
    : field_(std::move(empty)),
      channels_(colored ? 3 : 1),
      sums_(channels_ * field_.terms() * field_.pixels(), 0.0) {}

void LightFieldBuilder::add(std::span<const SourceRay> rays) {
  const int margin = margin_of(field_.basis);
  const std::size_t values = field_.terms() * field_.pixels();
  for (const SourceRay& ray : rays) {
    const auto flux = static_cast<double>(ray.flux);
    const glm::dvec3 p(ray.position), d(ray.direction);
    const double down = -d.z;
    if (!(down > 1e-6)) {
      lost_ += flux;
      continue;
    }
    const glm::dvec2 uv = glm::dvec2(p) + glm::dvec2(d) * (p.z / down);
    const glm::dvec2 st = uv + glm::dvec2(d) * (field_.distance / down);
    const glm::dvec2 at = (uv - field_.first) / field_.spacing, where = (st - field_.corner) / field_.pixel;
    const auto s = static_cast<int>(std::floor(where.x)), t = static_cast<int>(std::floor(where.y));
    // Only where all its filters are there does a ray keep its flux.
    constexpr double kRounding = 1e-4;  // of rays' floats, spacings
    const bool inside = at.x >= margin - 1 - kRounding && at.y >= margin - 1 - kRounding &&
                        at.x <= field_.columns - margin + kRounding &&
                        at.y <= field_.rows - margin + kRounding;
    if (!inside || s < 0 || t < 0 || s >= field_.width || t >= field_.height) {
      lost_ += flux;
      continue;
    }
    kept_ += flux, squares_ += flux * flux;
    const Filters fx = filters_at(field_.basis, at.x), fy = filters_at(field_.basis, at.y);
    const std::size_t pixel =
        static_cast<std::size_t>(t) * static_cast<std::size_t>(field_.width) + static_cast<std::size_t>(s);
    for (int j = 0; j < fy.count; ++j)
      for (int i = 0; i < fx.count; ++i) {
        const int m = fx.begin + i, n = fy.begin + j;
        if (m < 0 || n < 0 || m >= field_.columns || n >= field_.rows)
          continue;  // weight 0 at the reach itself
        const std::size_t term = static_cast<std::size_t>(n) * static_cast<std::size_t>(field_.columns) +
                                 static_cast<std::size_t>(m);
        const double weighed = flux * fx.weight[i] * fy.weight[j];
        double* sum = &sums_[term * field_.pixels() + pixel];
        if (channels_ == 1) {
          *sum += weighed;
          continue;
        }
        for (const float share : {ray.color.r, ray.color.g, ray.color.b}) {
          *sum += weighed * static_cast<double>(share);
          sum += values;
        }
      }
  }
}

LightField LightFieldBuilder::finish() && {
  for (std::size_t c = 0; c < channels_ && field_.basis == NearBasis::spline; ++c)
    finish_splines(field_, &sums_[c * field_.terms() * field_.pixels()]);
  const double area = field_.pixel * field_.pixel;
  std::vector<float>& out = channels_ == 1 ? field_.irradiance : field_.color;
  out.resize(sums_.size());
  for (std::size_t i = 0; i < sums_.size(); ++i) out[i] = static_cast<float>(sums_[i] / area);
  if (channels_ > 1) set_luminance(field_);
  field_.grain = kept_ > 0 ? squares_ / kept_ : 0;
  return std::move(field_);
}

glm::dvec2 opening(const LightField& field) {
  const glm::dvec2 filters(field.columns, field.rows);
  return field.spacing * glm::max(glm::dvec2(0), filters - (2.0 * margin_of(field.basis) - 1));
}

LightField widened(const LightField& field) {
  LightField out = field;
  const double reach = basis_reach(field.basis);
  out.color.clear();
  out.spacing = 2 * field.spacing;
  out.columns = filters_for(field.basis, 0.5 * (field.columns - 1) + reach);
  out.rows = filters_for(field.basis, 0.5 * (field.rows - 1) + reach);
  out.first = field.first + 0.5 * field.spacing * glm::dvec2(field.columns - 1, field.rows - 1) -
              0.5 * out.spacing * glm::dvec2(out.columns - 1, out.rows - 1);
  std::vector<double> sums(out.terms() * out.pixels());
  const glm::dvec2 first = (field.first - out.first) / out.spacing;
  for (int n = 0; n < field.rows; ++n)
    for (int m = 0; m < field.columns; ++m) {
      const auto image = field.image(index(m, n, field.columns));
      const Shares along = shares_at(field.basis, first.x + 0.5 * m),
                   across = shares_at(field.basis, first.y + 0.5 * n);
      for (int j = 0; j < kWide; ++j)
        for (int i = 0; i < kWide; ++i) {
          const double share = along.of[static_cast<std::size_t>(i)] * across.of[static_cast<std::size_t>(j)];
          if (share == 0) continue;
          double* to = &sums.at(index(along.begin + i, across.begin + j, out.columns) * out.pixels());
          for (std::size_t p = 0; p < image.size(); ++p) to[p] += share * static_cast<double>(image[p]);
        }
    }
  if (out.basis == NearBasis::spline) finish_splines(out, sums.data());
  out.irradiance.assign(sums.begin(), sums.end());
  return out;
}

LightField channel_of(const LightField& field, int channel) {
  LightField out = field;
  const auto size = static_cast<std::ptrdiff_t>(field.irradiance.size());
  out.irradiance.assign(field.color.begin() + channel * size, field.color.begin() + (channel + 1) * size);
  out.color.clear();
  return out;
}

void set_luminance(LightField& field) {
  const std::size_t size = field.color.size() / 3;
  field.irradiance.resize(size);
  for (std::size_t i = 0; i < size; ++i)
    field.irradiance[i] = luminance(Rgb(field.color[i], field.color[size + i], field.color[2 * size + i]));
}

double flux(const LightField& field) {
  double sum = 0;
  for (const float v : field.irradiance) sum += static_cast<double>(v);
  return sum * field.pixel * field.pixel;
}

double light_of(const LightField& field, const std::string& where) {
  const double lumens = flux(field);
  if (!(lumens > 0))
    throw Error(where, fmt::format("sends {:.4g} lm in all", lumens),
                "light; negative where photographs and their negatives changed places");
  return lumens;
}

}  // namespace sconce
