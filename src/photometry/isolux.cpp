// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "photometry/diagram.h"
#include "photometry/figures.h"

namespace sconce {

namespace {

constexpr int kCells = 160;                               // across the drawn square
constexpr double kSize = 400, kMargin = 50, kTitle = 30;  // pixels
constexpr double kDim = 0.01;                             // of the brightest point

/// Lux on the floor, row 0 on top (the largest y). @param width  of it, m
std::vector<double> floor_lux(const Photometry& p, double height, double width) {
  std::vector<double> out;
  for (int row = 0; row <= kCells; ++row)
    for (int column = 0; column <= kCells; ++column) {
      const double x = (static_cast<double>(column) / kCells - 0.5) * width,
                   y = (0.5 - static_cast<double>(row) / kCells) * width;
      const double r2 = x * x + y * y + height * height;
      const glm::dvec3 d = glm::dvec3(x, y, -height) / std::sqrt(r2);
      out.push_back(intensity(p, Vec3(d)) * -d.z / r2);
    }
  return out;
}

/// Is the border of a floor dim beside its middle?
bool holds_beam(const std::vector<double>& lux) {
  const double most = *std::max_element(lux.begin(), lux.end());
  for (std::size_t i = 0; i < lux.size(); ++i) {
    const std::size_t row = i / (kCells + 1), column = i % (kCells + 1);
    if ((row % kCells == 0 || column % kCells == 0) && lux[i] > kDim * most) return false;
  }
  return true;
}

/// Line pieces of one level: marching squares, a saddle joined by its mean.
std::vector<std::vector<glm::dvec2>> contour(const std::vector<double>& lux, double level) {
  std::vector<std::vector<glm::dvec2>> out;
  const double step = kSize / kCells;
  for (int row = 0; row < kCells; ++row)
    for (int column = 0; column < kCells; ++column) {
      constexpr int kDx[] = {0, 1, 1, 0}, kDy[] = {0, 0, 1, 1};
      double v[4];
      for (int i = 0; i < 4; ++i)
        v[i] = lux[static_cast<std::size_t>((row + kDy[i]) * (kCells + 1) + column + kDx[i])];
      std::vector<glm::dvec2> cuts;
      for (int i = 0; i < 4; ++i) {
        const int j = (i + 1) % 4;
        if ((v[i] < level) == (v[j] < level)) continue;
        const double at = (level - v[i]) / (v[j] - v[i]);
        cuts.push_back({kMargin + step * (column + kDx[i] + at * (kDx[j] - kDx[i])),
                        kTitle + kMargin + step * (row + kDy[i] + at * (kDy[j] - kDy[i]))});
      }
      if (cuts.size() == 4 && (v[0] + v[1] + v[2] + v[3] < 4 * level) == (v[0] < level))
        std::rotate(cuts.begin(), cuts.begin() + 1, cuts.end());
      for (std::size_t i = 0; i + 1 < cuts.size(); i += 2) out.push_back({cuts[i], cuts[i + 1]});
    }
  return out;
}

/// Where a line's value stands on it: down to the right where there is room beside the others.
std::optional<glm::dvec2> place_on(const std::vector<std::vector<glm::dvec2>>& line,
                                   const std::vector<glm::dvec2>& taken) {
  constexpr double kWide = 34, kHigh = 14, kEdge = 16,
                   kLeast = 30;  // apart; from the frame; of a line's extent
  const glm::dvec2 corner(kMargin, kTitle + kMargin), middle = corner + 0.5 * kSize;
  glm::dvec2 low(1e30), high(-1e30);
  std::optional<glm::dvec2> best;
  double least = 1e30;
  for (const std::vector<glm::dvec2>& piece : line) {
    const glm::dvec2 at = piece.front(), away = at - middle;
    low = glm::min(low, at), high = glm::max(high, at);
    const double off =
        std::abs(std::remainder(std::atan2(away.y, away.x) - 0.25 * std::numbers::pi, 2 * std::numbers::pi));
    const bool clear = std::ranges::none_of(taken, [&](const glm::dvec2& other) {
      return std::abs(other.x - at.x) < kWide && std::abs(other.y - at.y) < kHigh;
    });
    const glm::dvec2 inside = glm::min(at - corner, corner + kSize - at);
    if (clear && off < least && std::min(inside.x, inside.y) > kEdge) least = off, best = at;
  }
  if (std::max(high.x - low.x, high.y - low.y) < kLeast) return std::nullopt;
  return best;
}

/// 1, 2 or 5 times a power of ten, four to ten of them across a length.
double tick_step(double length) {
  const double rough = length / 10, power = std::pow(10, std::floor(std::log10(rough)));
  for (const double m : {1.0, 2.0, 5.0})
    if (m * power >= rough * (1 - 1e-9)) return m * power;
  return 10 * power;
}

/// From red (the brightest) to blue.
Color8 color_of(int line) {
  Color8 out;
  for (int c = 0; c < 3; ++c) {  // HSL at 70 % and 45 %
    const double hue = std::fmod((c == 0 ? 0 : c == 1 ? 8 : 4) + 240.0 * line / 8 / 30, 12);
    const double v = 0.45 - 0.315 * std::max(-1.0, std::min({hue - 3, 9 - hue, 1.0}));
    out[static_cast<std::size_t>(c)] = static_cast<unsigned char>(std::lround(255 * v));
  }
  return out;
}

}  // namespace

Drawing isolux_diagram(const Photometry& given, const std::string& title, double height) {
  using Anchor = Drawing::Label::Anchor;
  constexpr Color8 kBlack{}, kGrid{0xcc, 0xcc, 0xcc}, kMark{0x55, 0x55, 0x55};
  const Photometry p = as_type_c(given);
  double width = height;
  std::vector<double> lux = floor_lux(p, height, width);
  while (width < 4 * height && !holds_beam(lux)) width *= 2, lux = floor_lux(p, height, width);
  const double most = *std::max_element(lux.begin(), lux.end());
  const double top = kTitle + kMargin;
  const glm::dvec2 middle(kMargin + kSize / 2, top + kSize / 2);
  Drawing out;
  out.width = kSize + 2 * kMargin, out.height = kSize + 2 * kMargin + kTitle + 20;
  add_title(out, given, title, middle.x);
  const auto corner = [&](int x, int y) { return glm::dvec2(kMargin + x * kSize, top + y * kSize); };
  out.lines.push_back({{{corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1), corner(0, 0)}}, kGrid});
  // 1, 2, 5 times powers of ten below the brightest point, three decades of them at most.
  int drawn = 0;
  std::vector<glm::dvec2> places;  // of the values, one per line that is in the picture
  std::vector<Drawing::Label> values;
  for (double power = std::pow(10, std::floor(std::log10(std::max(most, 1e-9)))); drawn < 9; power /= 10)
    for (const double m : {5.0, 2.0, 1.0}) {
      const double level = m * power;
      if (!(level < most) || drawn == 9) continue;
      const Color8 color = color_of(drawn);
      const auto line = contour(lux, level);
      if (!line.empty()) {
        const double row = static_cast<double>(places.size());
        out.labels.push_back({{kMargin + kSize + 6, top + 12 + 15 * row},
                              fmt::format("{:g}{}", level, places.empty() ? " lx" : ""),
                              color});
        out.lines.push_back({line, color});
        const std::optional<glm::dvec2> at = place_on(line, places);
        places.push_back(at.value_or(middle));
        if (at)
          values.push_back(
              {*at + glm::dvec2(0, 4), fmt::format("{:g}", level), kMark, Anchor::middle, 10, true});
      }
      ++drawn;
    }
  for (const glm::dvec2& arm : {glm::dvec2(6, 0), glm::dvec2(0, 6)})
    out.lines.push_back({{{middle - arm, middle + arm}}, kMark});
  out.labels.insert(out.labels.end(), values.begin(), values.end());
  out.labels.push_back({{kMargin + kSize + 6, middle.y + 4}, "C0", kBlack});
  out.labels.push_back({{middle.x, top - 6}, "C90", kBlack, Anchor::middle});
  const double unit = kSize / width, step = tick_step(width);
  for (int i = -static_cast<int>(0.5 * width / step); i * step <= 0.5 * width; ++i) {
    const double at = i * step * unit;
    out.lines.push_back({{{{middle.x + at, top + kSize}, {middle.x + at, top + kSize + 4}}}, kMark});
    out.lines.push_back({{{{kMargin, middle.y - at}, {kMargin - 4, middle.y - at}}}, kMark});
    out.labels.push_back(
        {{middle.x + at, top + kSize + 16}, fmt::format("{:g}", i * step), kMark, Anchor::middle, 10});
    out.labels.push_back(
        {{kMargin - 8, middle.y - at + 4}, fmt::format("{:g}", i * step), kMark, Anchor::end, 10});
  }
  out.labels.push_back({{kMargin + kSize + 8, top + kSize + 16}, "m", kMark, Anchor::start, 10});
  out.labels.push_back(
      {{kMargin, kTitle + 2 * kMargin + kSize + 4},
       fmt::format("lux of one lamp on a floor {:g} m below it, {:.4g} at most", height, most),
       kBlack});
  return out;
}

}  // namespace sconce
