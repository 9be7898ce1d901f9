// SPDX-License-Identifier: Apache-2.0
// Whole images through an encoding.
#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "encode/encoding.h"

namespace sconce {

std::size_t Encoding::plane_bytes(int width, int height, int image_channels) const {
  const auto w = static_cast<std::size_t>(width), h = static_cast<std::size_t>(height);
  switch (type) {
    case TexelType::f32:
      return 4 * w * h * channels_of(image_channels);
    case TexelType::f16:
      return 2 * w * h * channels_of(image_channels);
    case TexelType::u8:
      return w * h * channels_of(image_channels);
    case TexelType::bc6h:
      return 16 * ((w + 3) / 4) * ((h + 3) / 4);
  }
  return 0;
}

namespace {

/// The largest value becomes the encoding's. Encoding what was decoded gives the same gain and codes again.
void set_gain(const Image& image, EncodedImage& out) {
  const std::size_t n = image.stride();
  std::array<float, 4> most{};
  for (std::size_t i = 0; i < image.data.size(); ++i)
    if (std::isfinite(image.data[i])) most[i % n] = std::max(most[i % n], image.data[i]);
  // Colours share one gain, so that grey stays grey; luminances of groups have their own.
  if (n == 3) most.fill(std::max({most[0], most[1], most[2]}));
  for (std::size_t k = 0; k < 4; ++k)
    out.gain[k] = most[k] > 0 ? std::min(out.encoding->largest / most[k], 1e30f) : 1.0f;
}

}  // namespace

EncodedImage encode(const Image& image, const Encoding& encoding) {
  const std::size_t n = image.stride();
  if (n != 3 && !(encoding.per_channel && n >= 1 && n <= 4))
    throw Error({}, "the encoding " + std::string(encoding.name) + " does not take " + std::to_string(n) +
                        " channels");
  EncodedImage out{&encoding, image.width, image.height, static_cast<int>(n), {1, 1, 1, 1}, {}};
  out.data.resize(static_cast<std::size_t>(encoding.planes) *
                  encoding.plane_bytes(image.width, image.height, out.channels));
  if (encoding.has_gain) set_gain(image, out);
  encoding.encode(image, out);
  return out;
}

Image decode(const EncodedImage& encoded) {
  std::vector<std::string> names{"R", "G", "B"};
  if (encoded.channels != 3) {
    names.clear();
    for (int c = 0; c < encoded.channels; ++c) names.push_back("Y" + std::to_string(c));
  }
  Image image(encoded.width, encoded.height, std::move(names));
  encoded.encoding->decode(encoded, 0, encoded.height, image.data.data());
  return image;
}

double range_within(const Encoding& encoding, double error) {
  if (encoding.type == TexelType::f32 || encoding.type == TexelType::f16)
    return encoding.max_relative_error <= error ? double{encoding.largest} / double{encoding.smallest} : 1;
  // Values, geometric, in steps much finer than the codes; the worst of each short run counts.
  constexpr int kRun = 64, kRuns = 4096;
  constexpr double kStops = 24;  // more than any 8-bit code holds
  Image values = Image::rgb(kRun, kRuns);
  for (int i = 0; i < kRun * kRuns; ++i) {
    const double stop = kStops * (i + 0.5) / (kRun * kRuns);
    const auto v = static_cast<float>(std::min(double{encoding.largest}, 65504.0) * std::exp2(stop - kStops));
    values.set_rgb(i % kRun, i / kRun, Rgb(v));
  }
  const EncodedImage encoded = encode(values, encoding);
  const Image back = decode(encoded);
  int best = 0, length = 0;
  for (int run = 0; run < kRuns; ++run) {
    double worst = 0;
    for (int x = 0; x < kRun; ++x) {
      const double v = values.at(x, run)[0];
      worst = std::max(worst, std::abs(back.at(x, run)[0] - v) / v);
    }
    length = worst <= error ? length + 1 : 0;
    best = std::max(best, length);
  }
  return std::exp2(kStops * best / kRuns);
}

}  // namespace sconce
