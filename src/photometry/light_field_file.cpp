// SPDX-License-Identifier: Apache-2.0
#include "photometry/light_field_file.h"

#include <fmt/format.h>

#include <cmath>

#include "core/error.h"
#include "encode/encoding.h"
#include "image/io.h"

namespace sconce {

namespace {

constexpr const char* kKind = "sconce:kind";
constexpr const char* kBasis = "sconce:basis";
constexpr const char* kCoding = "sconce:coding";
constexpr const char* kColor = "sconce:color";
constexpr int kMostFilters = 1000;

constexpr const char* kCodings[] = {"float", "half", "srgbe"};  // FieldCoding
constexpr const char* kColors[] = {".R", ".G", ".B"};

/// The channels that a file has of one plane after the other: terms of a grey light field, or each term's
/// red, green and blue.
std::vector<std::string> plane_names(const LightField& field, bool grey) {
  std::vector<std::string> out;
  for (int n = 0; n < field.rows; ++n)
    for (int m = 0; m < field.columns; ++m)
      for (int c = 0; c < (grey ? 1 : 3); ++c)
        out.push_back(fmt::format("E.{:03}.{:03}{}", n, m, grey ? "" : kColors[c]));
  return out;
}

/// Values of such a plane, row 0 at the least y.
template <class Field>
auto plane_of(Field& field, std::size_t i) {
  auto& values = field.is_grey() ? field.irradiance : field.color;
  const std::size_t at = field.is_grey() ? i : i % 3 * field.terms() + i / 3;
  return std::span(values).subspan(at * field.pixels(), field.pixels());
}

/// Row 0 of a picture is on top, so it is the largest y.
std::size_t flipped(const Image& image, std::size_t pixel) {
  const auto width = static_cast<std::size_t>(image.width);
  return (static_cast<std::size_t>(image.height) - 1 - pixel / width) * width + pixel % width;
}

std::string code_name(std::size_t group, const char* letter) {
  return fmt::format("C.{:05}.{}", group, letter);
}

/// Three planes of a picture at a time as R, G, B and exponent, whole numbers from 0 to 255.
Image coded(const Image& plain) {
  const std::size_t groups = (plain.stride() + 2) / 3;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < groups; ++i)
    for (const char* letter : {"R", "G", "B", "X"}) names.push_back(code_name(i, letter));
  Image out(plain.width, plain.height, names), some = Image::rgb(plain.width, plain.height);
  for (std::size_t i = 0; i < groups; ++i) {
    for (std::size_t p = 0; p < plain.pixels(); ++p)
      for (std::size_t k = 0; k < 3; ++k)
        some.data[3 * p + k] = 3 * i + k < plain.stride() ? plain.data[p * plain.stride() + 3 * i + k] : 0;
    const EncodedImage codes = encode(some, find_encoding("srgbe8"));
    for (std::size_t p = 0; p < plain.pixels(); ++p)
      for (std::size_t k = 0; k < 4; ++k)
        out.data[p * out.stride() + 4 * i + k] =
            static_cast<float>(std::to_integer<unsigned>(codes.data[4 * p + k]));
  }
  return out;
}

/// The reverse. @param names  of the planes
Image uncoded(const Image& codes, const std::vector<std::string>& names, const std::string& where) {
  Image out(codes.width, codes.height, names);
  EncodedImage some;
  some.encoding = &find_encoding("srgbe8");
  some.width = codes.width, some.height = codes.height;
  some.data.resize(4 * codes.pixels());
  for (std::size_t i = 0; 3 * i < names.size(); ++i) {
    std::size_t k = 0;
    for (const char* letter : {"R", "G", "B", "X"}) {
      const std::string name = code_name(i, letter);
      const int channel = codes.channel(name);
      if (channel < 0) throw Error(where, "lacks the channel " + name);
      for (std::size_t p = 0; p < codes.pixels(); ++p) {
        const float v = codes.data[p * codes.stride() + static_cast<std::size_t>(channel)];
        if (!(v >= 0 && v <= 255 && v == std::floor(v)))
          throw Error(where, "holds a value that is no code in channel " + name,
                      "whole numbers from 0 to 255");
        some.data[4 * p + k] = static_cast<std::byte>(v);
      }
      ++k;
    }
    const Image values = decode(some);
    for (std::size_t p = 0; p < codes.pixels(); ++p)
      for (k = 0; k < 3 && 3 * i + k < names.size(); ++k)
        out.data[p * out.stride() + 3 * i + k] = values.data[3 * p + k];
  }
  return out;
}

}  // namespace

const char* name_of(FieldCoding coding) {
  return kCodings[static_cast<std::size_t>(coding)];
}

std::optional<FieldCoding> coding_named(std::string_view name) {
  for (const FieldCoding coding : {FieldCoding::full, FieldCoding::half, FieldCoding::srgbe})
    if (name == name_of(coding)) return coding;
  return std::nullopt;
}

void write_light_field(const std::filesystem::path& path, const LightField& field, FieldCoding coding) {
  const std::vector<std::string> names = plane_names(field, field.is_grey());
  Image image(field.width, field.height, names);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto plane = plane_of(field, i);
    for (std::size_t p = 0; p < plane.size(); ++p)
      image.data[flipped(image, p) * image.stride() + i] = plane[p];
  }
  if (coding == FieldCoding::srgbe) image = coded(image);
  image.text = {{kKind, "light-field"},
                {kBasis, name_of(field.basis)},
                {kCoding, name_of(coding)},
                {"sconce:unit", "lux"}};
  image.text[kColor] = field.is_grey() ? "grey" : "rgb";
  const auto number = [&](const char* name, double v) {
    image.number[std::string("sconce:") + name] = static_cast<float>(v);
  };
  number("columns", field.columns), number("rows", field.rows);
  number("spacing", field.spacing), number("first-x", field.first.x), number("first-y", field.first.y);
  number("distance", field.distance), number("corner-x", field.corner.x), number("corner-y", field.corner.y);
  number("pixel", field.pixel), number("grain", field.grain);
  // Halves hold the codes of sRGBE as they are.
  write_exr(path, image, coding == FieldCoding::full ? PixelType::full : PixelType::half);
}

LightField read_light_field(const std::filesystem::path& path) {
  Image image = read_exr(path);
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
  // Files from before they had a choice name neither.
  const std::string coding = text(kCoding), color = text(kColor);
  if (!coding.empty() && !coding_named(coding))
    throw Error(where, "has the coding '" + coding + "'", "float, half, srgbe");
  if (!color.empty() && color != "grey" && color != "rgb")
    throw Error(where, "has the colours '" + color + "'", "grey, rgb");
  const std::vector<std::string> names = plane_names(out, color != "rgb");
  if (coding == kCodings[2]) image = uncoded(image, names, where);
  (color == "rgb" ? out.color : out.irradiance).resize(names.size() * out.pixels());
  for (std::size_t i = 0; i < names.size(); ++i) {
    const int channel = image.channel(names[i]);
    if (channel < 0) throw Error(where, "lacks the channel " + names[i]);
    const auto plane = plane_of(out, i);
    for (std::size_t p = 0; p < plane.size(); ++p) {
      const float v = image.data[flipped(image, p) * image.stride() + static_cast<std::size_t>(channel)];
      if (!std::isfinite(v)) throw Error(where, "holds a value that is no number in channel " + names[i]);
      plane[p] = v;
    }
  }
  if (!out.is_grey()) set_luminance(out);
  return out;
}

}  // namespace sconce
