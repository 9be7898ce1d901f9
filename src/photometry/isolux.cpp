// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "photometry/diagram.h"
#include "photometry/figures.h"

namespace sconce {

namespace {

constexpr int kCells = 160;  // across the drawn square
constexpr double kHeights = 4, kSize = 400, kMargin = 50,
                 kTitle = 30;  // square: so many mounting heights wide; pixels

/// Lux on the floor, row 0 on top (the largest y).
std::vector<double> floor_lux(const Photometry& p, double height) {
  std::vector<double> out;
  for (int row = 0; row <= kCells; ++row)
    for (int column = 0; column <= kCells; ++column) {
      const double x = (static_cast<double>(column) / kCells - 0.5) * kHeights * height,
                   y = (0.5 - static_cast<double>(row) / kCells) * kHeights * height;
      const double r2 = x * x + y * y + height * height;
      const glm::dvec3 d = glm::dvec3(x, y, -height) / std::sqrt(r2);
      out.push_back(intensity(p, Vec3(d)) * -d.z / r2);
    }
  return out;
}

/// Line pieces of one level: marching squares, a saddle joined by its mean.
std::string contour(const std::vector<double>& lux, double level) {
  std::string path;
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
      for (std::size_t i = 0; i + 1 < cuts.size(); i += 2)
        path +=
            fmt::format("M{:.1f},{:.1f}L{:.1f},{:.1f}", cuts[i].x, cuts[i].y, cuts[i + 1].x, cuts[i + 1].y);
    }
  return path;
}

}  // namespace

std::string isolux_svg(const Photometry& given, const std::string& title, double height) {
  const std::vector<double> lux = floor_lux(as_type_c(given), height);
  const double most = *std::max_element(lux.begin(), lux.end());
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
      "font-family=\"sans-serif\" font-size=\"11\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
      "<text x=\"{2}\" y=\"20\" text-anchor=\"middle\" font-size=\"13\">{3}</text>\n"
      "<rect x=\"{4}\" y=\"{5}\" width=\"{6}\" height=\"{6}\" fill=\"none\" stroke=\"#ccc\"/>\n",
      kSize + 2 * kMargin, kSize + 2 * kMargin + kTitle + 20, kMargin + kSize / 2, escaped_xml(title),
      kMargin, kTitle + kMargin, kSize);
  // 1, 2, 5 times powers of ten below the brightest point, three decades of them at most.
  int drawn = 0;
  for (double power = std::pow(10, std::floor(std::log10(std::max(most, 1e-9)))); drawn < 9; power /= 10)
    for (const double m : {5.0, 2.0, 1.0}) {
      const double level = m * power;
      if (!(level < most) || drawn == 9) continue;
      const double hue = 240.0 * drawn / 8;
      out += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"hsl({:.0f},70%,45%)\"/>\n",
                         contour(lux, level), hue);
      out += fmt::format("<text x=\"{:.0f}\" y=\"{:.0f}\" fill=\"hsl({:.0f},70%,45%)\">{:g} lx</text>\n",
                         kMargin + kSize + 6, kTitle + kMargin + 12 + 15.0 * drawn, hue, level);
      ++drawn;
    }
  const double middle = kMargin + kSize / 2;
  out += fmt::format(
      "<path d=\"M{0},{1}v12M{2},{3}h12\" stroke=\"#555\"/>\n<text x=\"{4}\" y=\"{3}\" dy=\"4\">C0</text>\n"
      "<text x=\"{0}\" y=\"{5}\" text-anchor=\"middle\">C90</text>\n"
      "<text x=\"{6}\" y=\"{7}\">floor {8:g} m below, {9:g} x {9:g} m, {10:.4g} lx at most</text>\n</svg>\n",
      middle, kTitle + kMargin + kSize / 2 - 6, middle - 6, kTitle + kMargin + kSize / 2,
      kMargin + kSize - 20, kTitle + kMargin + 14, kMargin, kTitle + 2 * kMargin + kSize, height,
      kHeights * height, most);
  return out;
}

}  // namespace sconce
