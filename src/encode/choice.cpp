// SPDX-License-Identifier: Apache-2.0
#include "encode/choice.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/text.h"

namespace sconce {

namespace {

constexpr std::string_view kLuminance = "lum:";
constexpr double kPercentile = 0.999, kFloor = 0.01;
constexpr float kGrey = 0.18f, kBoost = 16;  // middle grey, and 4 stops

/// CIE 1976 a*, b* of linear Rec. 709 under D65, clipped at white with its hue kept.
std::array<float, 2> chroma(Rgb c) {
  c = {std::max(c.r, 0.0f), std::max(c.g, 0.0f), std::max(c.b, 0.0f)};
  const float most = std::max({c.r, c.g, c.b});
  if (most > 1) c = c * (1 / most);
  const auto f = [](float t) {
    constexpr float kLinear = 0.008856452f;  // (6/29)^3
    return t > kLinear ? std::cbrt(t) : 7.787037f * t + 4.0f / 29;
  };
  const float x = f((0.4124564f * c.r + 0.3575761f * c.g + 0.1804375f * c.b) / 0.95047f);
  const float y = f(0.2126729f * c.r + 0.7151522f * c.g + 0.0721750f * c.b);
  const float z = f((0.0193339f * c.r + 0.1191920f * c.g + 0.9503041f * c.b) / 1.08883f);
  return {500 * (x - y), 200 * (y - z)};
}

float chroma_distance(const Rgb& a, const Rgb& b, float scale) {
  const auto p = chroma(a * scale), q = chroma(b * scale);
  return std::hypot(p[0] - q[0], p[1] - q[1]);
}

Rgb rgb(const Image& image, std::size_t i) {
  return {image.data[3 * i], image.data[3 * i + 1], image.data[3 * i + 2]};
}

float percentile(std::vector<float>& values) {
  if (values.empty()) return 0;
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(kPercentile * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace

std::string EncodingChoice::name() const {
  return (luminance ? std::string(kLuminance) : std::string()) + std::string(encoding->name);
}

double EncodingChoice::bytes_per_texel() const {
  const int channels = luminance ? 4 : 3;
  const auto block =
      static_cast<double>(encoding->plane_bytes(4, 4, channels) * static_cast<std::size_t>(encoding->planes));
  return block / 16 / (luminance ? 4 : 1);
}

EncodingChoice parse_encoding(std::string_view text) {
  EncodingChoice choice;
  choice.luminance = text.starts_with(kLuminance);
  choice.encoding = &find_encoding(choice.luminance ? text.substr(kLuminance.size()) : text);
  if (!choice.luminance || choice.encoding->per_channel) return choice;
  std::vector<std::string> names;
  for (const Encoding& e : encodings())
    if (e.per_channel) names.push_back(std::string(kLuminance) + std::string(e.name));
  throw UsageError({},
                   "'" + std::string(text) + "' cannot be: the channels of " +
                       std::string(choice.encoding->name) + " share bits",
                   join(names, ", "));
}

EncodingError measure_encoding(const Image& original, const Image& decoded, const Image& receivers,
                               double mean) {
  const float floor = static_cast<float>(kFloor * mean);
  const float grey = mean > 0 ? kGrey / static_cast<float>(mean) : 1.0f;
  std::vector<float> relative, distance, boosted;
  for (std::size_t i = 0; i < original.pixels(); ++i) {
    if (!(receivers.data[4 * i + 3] > 0)) continue;
    const Rgb a = rgb(original, i), b = rgb(decoded, i);
    const float size = std::max(luminance(a), floor);
    relative.push_back(size > 0 ? std::abs(luminance(b) - luminance(a)) / size : 0.0f);
    distance.push_back(chroma_distance(a, b, grey));
    boosted.push_back(chroma_distance(a, b, kBoost * grey));
  }
  return {percentile(relative), std::max(percentile(distance), percentile(boosted))};
}

EncodingError measure_component(const Image& original, const Image& decoded, const Image& illuminance,
                                const Image& receivers, double mean) {
  std::vector<float> relative;
  for (std::size_t i = 0; i < original.pixels(); ++i) {
    if (!(receivers.data[4 * i + 3] > 0)) continue;
    const float size = std::max(luminance(rgb(illuminance, i)), static_cast<float>(kFloor * mean));
    relative.push_back(size > 0 ? std::abs(luminance(rgb(decoded, i) - rgb(original, i))) / size : 0.0f);
  }
  return {percentile(relative), 0};
}

EncodingChoice choose_encoding(std::span<const std::span<const Image>> coefficients,
                               std::span<const Image> receivers, double mean, double most) {
  std::vector<EncodingChoice> choices;
  for (const Encoding& e : encodings())
    if (e.is_signed || coefficients.size() == 1) choices.push_back({&e, false});
  std::stable_sort(choices.begin(), choices.end(),
                   [](const auto& a, const auto& b) { return a.bytes_per_texel() < b.bytes_per_texel(); });
  const auto fits = [&](const EncodingChoice& choice) {
    for (std::size_t c = 0; c < coefficients.size(); ++c)
      for (std::size_t page = 0; page < receivers.size(); ++page) {
        const Image &original = coefficients[c][page], &e = coefficients[0][page];
        const Image decoded = decode(encode(original, *choice.encoding));
        const EncodingError error = c == 0 ? measure_encoding(original, decoded, receivers[page], mean)
                                           : measure_component(original, decoded, e, receivers[page], mean);
        if (error.relative > most || error.chroma > 100 * most) return false;
      }
    return true;
  };
  return *std::find_if(choices.begin(), std::prev(choices.end()), fits);
}

void pack_luminance(const Image& layer, Image& packed, std::size_t channel) {
  for (std::size_t i = 0; i < layer.pixels(); ++i)
    packed.data[i * packed.stride() + channel] =
        luminance(Rgb(layer.data[3 * i], layer.data[3 * i + 1], layer.data[3 * i + 2]));
}

Image unpack_luminance(const Image& packed, std::size_t channel, const Rgb& color) {
  Image layer = Image::rgb(packed.width, packed.height);
  for (std::size_t i = 0; i < layer.pixels(); ++i) {
    const float y = packed.data[i * packed.stride() + channel];
    layer.data[3 * i] = y * color.r, layer.data[3 * i + 1] = y * color.g, layer.data[3 * i + 2] = y * color.b;
  }
  return layer;
}

}  // namespace sconce
