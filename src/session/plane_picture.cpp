// SPDX-License-Identifier: Apache-2.0
#include "session/plane_picture.h"

#include <algorithm>
#include <cmath>

#include "image/draw.h"

namespace sconce {

namespace {

constexpr int kLongest = 640, kMargin = 16, kBar = 18, kTick = 6, kDot = 2;
constexpr Color8 kPaper = {22, 22, 24}, kInk = {210, 210, 212};

Color8 code(const Rgb& color) {
  const auto byte = [](float v) {
    return static_cast<unsigned char>(std::lround(255 * std::clamp(v, 0.0f, 1.0f)));
  };
  return {byte(color.r), byte(color.g), byte(color.b)};
}

/// Bilinear between the points that were measured; NaN where the nearest was not.
float between(const MeasuringPlane& plane, std::span<const float> lux, float u, float v) {
  const float x =
      std::clamp(u * static_cast<float>(plane.columns) - 0.5f, 0.0f, static_cast<float>(plane.columns - 1));
  const float y =
      std::clamp(v * static_cast<float>(plane.rows) - 0.5f, 0.0f, static_cast<float>(plane.rows - 1));
  const auto at = [&](int column, int row) {
    return lux[static_cast<std::size_t>(std::min(row, plane.rows - 1)) *
                   static_cast<std::size_t>(plane.columns) +
               static_cast<std::size_t>(std::min(column, plane.columns - 1))];
  };
  const int column = static_cast<int>(x), row = static_cast<int>(y);
  if (!std::isfinite(at(static_cast<int>(std::lround(x)), static_cast<int>(std::lround(y))))) return NAN;
  float sum = 0, weight = 0;
  for (int corner = 0; corner < 4; ++corner) {
    const int i = corner & 1, j = corner >> 1;
    const float w = (i ? x - static_cast<float>(column) : 1 - x + static_cast<float>(column)) *
                    (j ? y - static_cast<float>(row) : 1 - y + static_cast<float>(row));
    const float value = at(column + i, row + j);
    if (std::isfinite(value)) sum += w * value, weight += w;
  }
  return weight > 0 ? sum / weight : NAN;
}

void draw_legend(Image8& picture, int x, int y, int height, const FalseColor& scale) {
  for (int j = 0; j < height; ++j)
    fill(picture, x, y + j, kBar, 1,
         code(false_color(1 - static_cast<float>(j) / static_cast<float>(height))));
  for (const float tick : legend_ticks(scale)) {
    const int at =
        y + static_cast<int>(std::lround(static_cast<float>(height - 1) * (1 - scale.place(tick))));
    fill(picture, x + kBar, at, kTick, 1, kInk);
    draw_text(picture, x + kBar + kTick + 4, at - text_height(kDot) / 2, tick_text(tick), kDot, kInk);
  }
  draw_text(picture, x, y + height + kMargin / 2, "LX", kDot, kInk);
}

}  // namespace

Image8 plane_picture(const MeasuringPlane& plane, std::span<const float> lux, const FalseColor& scale) {
  const float across = glm::length(plane.across), along = glm::length(plane.along);
  const float pixel = std::max(across, along) / kLongest;
  const int width = std::max(64, static_cast<int>(across / pixel));
  const int height = std::max(64, static_cast<int>(along / pixel));
  Image values(width, height, {"Y"});
  std::vector<bool> measured(values.pixels());
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float value = between(plane, lux, (static_cast<float>(x) + 0.5f) / static_cast<float>(width),
                                  1 - (static_cast<float>(y) + 0.5f) / static_cast<float>(height));
      const auto i =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
      measured[i] = std::isfinite(value);
      values.data[i] = measured[i] ? value : 0;
    }
  const Image8 map = false_color(values, scale);
  Image8 out;
  const int legend = kBar + kTick + 4 + text_width("000,000", kDot);
  out.width = kMargin + width + kMargin + legend + kMargin,
  out.height = height + 2 * kMargin + text_height(kDot);
  out.data.resize(3 * static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height));
  fill(out, 0, 0, out.width, out.height, kPaper);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto i =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
      if (measured[i])
        fill(out, kMargin + x, kMargin + y, 1, 1,
             {map.data[3 * i], map.data[3 * i + 1], map.data[3 * i + 2]});
    }
  draw_legend(out, kMargin + width + kMargin, kMargin, height, scale);
  return out;
}

}  // namespace sconce
