// SPDX-License-Identifier: Apache-2.0
#include "photometry/light_field_file.h"

#include <fmt/format.h>

#include <cmath>

#include "core/error.h"
#include "image/io.h"

namespace sconce {

namespace {

constexpr const char* kKind = "sconce:kind";
constexpr const char* kBasis = "sconce:basis";
constexpr int kMostFilters = 1000;

std::string channel_name(int m, int n) {
  return fmt::format("E.{:03}.{:03}", n, m);
}

}  // namespace

void write_light_field(const std::filesystem::path& path, const LightField& field) {
  std::vector<std::string> names;
  for (int n = 0; n < field.rows; ++n)
    for (int m = 0; m < field.columns; ++m) names.push_back(channel_name(m, n));
  Image image(field.width, field.height, names);
  // Row 0 of a picture is on top, so it is the largest y.
  for (std::size_t term = 0; term < field.terms(); ++term)
    for (int t = 0; t < field.height; ++t)
      for (int s = 0; s < field.width; ++s)
        image.at(s, field.height - 1 - t)[term] =
            field.image(term)[static_cast<std::size_t>(t) * static_cast<std::size_t>(field.width) +
                              static_cast<std::size_t>(s)];
  image.text = {{kKind, "light-field"}, {kBasis, name_of(field.basis)}, {"sconce:unit", "lux"}};
  const auto number = [&](const char* name, double v) {
    image.number[std::string("sconce:") + name] = static_cast<float>(v);
  };
  number("columns", field.columns), number("rows", field.rows);
  number("spacing", field.spacing), number("first-x", field.first.x), number("first-y", field.first.y);
  number("distance", field.distance), number("corner-x", field.corner.x), number("corner-y", field.corner.y);
  number("pixel", field.pixel), number("grain", field.grain);
  write_exr(path, image, PixelType::full);
}

LightField read_light_field(const std::filesystem::path& path) {
  const Image image = read_exr(path);
  const std::string where = path.string();
  const auto text = [&](const char* name) {
    const auto found = image.text.find(name);
    return found == image.text.end() ? std::string() : found->second;
  };
  if (text(kKind) != "light-field")
    throw NotMyFormat(where, "is no light field", std::string(kKind) + " = light-field");
  const auto number = [&](const char* name) {
    const auto found = image.number.find(std::string("sconce:") + name);
    if (found == image.number.end() || !std::isfinite(found->second))
      throw Error(where, std::string("has no number sconce:") + name);
    return static_cast<double>(found->second);
  };
  LightField out;
  const std::optional<NearBasis> basis = basis_named(text(kBasis));
  if (!basis) throw Error(where, "has the basis '" + text(kBasis) + "'", "bell, spline");
  out.basis = *basis;
  for (const char* name : {"columns", "rows"})
    if (!(number(name) >= 1 && number(name) <= kMostFilters && number(name) == std::floor(number(name))))
      throw Error(where, fmt::format("has {} {}", number(name), name), "a whole number from 1 to 1000");
  out.columns = static_cast<int>(number("columns")), out.rows = static_cast<int>(number("rows"));
  out.spacing = number("spacing"), out.distance = number("distance"), out.pixel = number("pixel");
  if (!(out.spacing > 0 && out.distance > 0 && out.pixel > 0))
    throw Error(where, "has a spacing, distance or pixel that is not positive");
  out.first = {number("first-x"), number("first-y")}, out.corner = {number("corner-x"), number("corner-y")};
  if (image.number.contains("sconce:grain")) out.grain = number("grain");
  if (!(out.grain >= 0)) throw Error(where, "has a grain below 0");
  out.width = image.width, out.height = image.height;
  out.irradiance.resize(out.terms() * out.pixels());
  for (int n = 0; n < out.rows; ++n)
    for (int m = 0; m < out.columns; ++m) {
      const std::string name = channel_name(m, n);
      const int channel = image.channel(name);
      if (channel < 0) throw Error(where, "lacks the channel " + name);
      float* to = &out.irradiance[static_cast<std::size_t>(n * out.columns + m) * out.pixels()];
      for (int t = 0; t < out.height; ++t)
        for (int s = 0; s < out.width; ++s) {
          const float v = image.at(s, out.height - 1 - t)[channel];
          if (!std::isfinite(v)) throw Error(where, "holds a value that is no number in channel " + name);
          *to++ = v;
        }
    }
  return out;
}

}  // namespace sconce
