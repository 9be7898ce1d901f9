// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.h"
#include "image/metrics.h"
#include "image/metrics_mask.h"

namespace sconce {

namespace {

using Code = std::array<unsigned char, 3>;
constexpr Code kDropped{96, 96, 96}, kNotFinite{255, 0, 255}, kFrame{255, 32, 32};

/// t in [0,1] over six colours of rising lightness.
Code color_of(double t) {
  constexpr std::array<std::array<double, 3>, 6> kAnchors{
      {{0, 0, 0}, {30, 40, 140}, {0, 130, 160}, {50, 180, 70}, {245, 220, 60}, {255, 255, 255}}};
  const double position = std::clamp(t, 0.0, 1.0) * (kAnchors.size() - 1);
  const std::size_t i = std::min<std::size_t>(static_cast<std::size_t>(position), kAnchors.size() - 2);
  const double f = position - static_cast<double>(i);
  Code out{};
  for (std::size_t c = 0; c < 3; ++c)
    out[c] = static_cast<unsigned char>(kAnchors[i][c] + f * (kAnchors[i + 1][c] - kAnchors[i][c]) + 0.5);
  return out;
}

void set(Image8& image, int x, int y, const Code& code) {
  std::copy(code.begin(), code.end(),
            image.data.begin() + 3 * (static_cast<std::ptrdiff_t>(y) * image.width + x));
}

void frame_box(Image8& image, int bx, int by) {
  const int x0 = bx * kBox, y0 = by * kBox;
  const int x1 = std::min(image.width, x0 + kBox) - 1, y1 = std::min(image.height, y0 + kBox) - 1;
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x)
      if (x == x0 || x == x1 || y == y0 || y == y1) set(image, x, y, kFrame);
}

/// The error from which on a box belongs to the worst 1 %, NaN counted as the very worst.
double worst_percent(const Image& boxes) {
  std::vector<double> errors;
  for (const float e : boxes.data)
    if (e != -1) errors.push_back(std::isnan(e) ? INFINITY : e);
  if (errors.empty()) return INFINITY;
  std::sort(errors.begin(), errors.end(), std::greater<>());
  return errors[std::max<std::size_t>(1, errors.size() / 100) - 1];
}

}  // namespace

Image8 error_picture(const Image& a, const Image& b, const Image* mask, const Image& boxes) {
  if (a.width != b.width || a.height != b.height || a.channels != b.channels)
    throw Error({}, "images differ in size or channels");
  const std::vector<char> kept = kept_pixels(mask, a.width, a.height);
  const std::size_t channels = a.stride();
  double mean = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.pixels(); ++i)
    for (std::size_t c = 0; kept[i] != 0 && c < channels; ++c)
      if (const float v = b.data[i * channels + c]; std::isfinite(v)) mean += std::abs(v), ++count;
  mean = count > 0 && mean > 0 ? mean / static_cast<double>(count) : 1;

  Image8 out{a.width, a.height, 3, std::vector<unsigned char>(3 * a.pixels())};
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) {
      const std::size_t i =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(a.width) + static_cast<std::size_t>(x);
      double error = 0;
      for (std::size_t c = 0; c < channels; ++c)
        error += std::abs(double{a.at(x, y)[c]} - b.at(x, y)[c]) / static_cast<double>(channels);
      const double t = (std::log10(std::max(error / mean, 1e-9)) + 3) / 3;
      set(out, x, y, kept[i] == 0 ? kDropped : std::isfinite(error) ? color_of(t) : kNotFinite);
    }
  const double limit = worst_percent(boxes);
  for (int by = 0; by < boxes.height; ++by)
    for (int bx = 0; bx < boxes.width; ++bx) {
      const float e = *boxes.at(bx, by);
      if (std::isnan(e) || (e > 0 && e >= limit)) frame_box(out, bx, by);
    }
  return out;
}

Image8 false_color(const Image& map) {
  Image8 out{map.width, map.height, 3, std::vector<unsigned char>(3 * map.pixels())};
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) set(out, x, y, color_of(*map.at(x, y)));
  return out;
}

}  // namespace sconce
