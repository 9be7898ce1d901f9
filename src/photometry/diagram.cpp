// SPDX-License-Identifier: Apache-2.0
#include "photometry/diagram.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "photometry/figures.h"

namespace sconce {

namespace {

constexpr double kRadius = 200, kMargin = 50, kCentre = kRadius + kMargin, kTitle = 30;
constexpr double kDegree = std::numbers::pi / 180;

/// 1, 2 or 5 times a power of ten, so that three to five rings fit.
double ring_step(double peak) {
  const double rough = peak / 5, power = std::pow(10, std::floor(std::log10(rough)));
  for (const double m : {1.0, 2.0, 5.0})
    if (m * power >= rough) return m * power;
  return 10 * power;
}

/// The curve through C (to the right) and C + 180 (to the left).
std::string curve(const Photometry& p, double c, double scale) {
  std::string points;
  for (int i = -360; i <= 360; ++i) {
    const double angle = i * 0.5, plane = std::fmod(angle < 0 ? c + 180 : c, 360);
    const double r = intensity_at(p, plane, std::abs(angle)) * scale;
    points += fmt::format("{:.1f},{:.1f} ", kCentre + r * std::sin(angle * kDegree),
                          kTitle + kCentre + r * std::cos(angle * kDegree));
  }
  return points;
}

}  // namespace

std::string escaped_xml(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else
      out += c;
  }
  return out;
}

std::string polar_svg(const Photometry& given, const std::string& title) {
  const Photometry p = as_type_c(given);
  const double peak = std::max(peak_of(p).candela, 1e-9), step = ring_step(peak);
  const int rings = static_cast<int>(std::ceil(peak / step - 1e-9));
  const double scale = kRadius / (rings * step), y = kTitle + kCentre;
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
      "font-family=\"sans-serif\" font-size=\"11\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
      "<text x=\"{2}\" y=\"20\" text-anchor=\"middle\" font-size=\"13\">{3}</text>\n<g stroke=\"#ccc\" "
      "fill=\"none\">\n",
      2 * kCentre, 2 * kCentre + kTitle + 20, kCentre, escaped_xml(title));
  for (int ring = 1; ring <= rings; ++ring)
    out += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{:.1f}\"/>\n", kCentre, y, ring * step * scale);
  for (int angle = 0; angle < 180; angle += 30) {
    const double dx = kRadius * std::sin(angle * kDegree), dy = kRadius * std::cos(angle * kDegree);
    out += fmt::format("<path d=\"M{:.1f},{:.1f}L{:.1f},{:.1f}\"/>\n", kCentre - dx, y - dy, kCentre + dx,
                       y + dy);
  }
  out += "</g>\n<g fill=\"#555\" text-anchor=\"middle\">\n";
  for (int angle = 0; angle <= 180; angle += 30)
    for (const int side : {-1, 1}) {
      if (side < 0 && angle % 180 == 0) continue;
      out += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\">{}°</text>\n",
                         kCentre + side * (kRadius + 18) * std::sin(angle * kDegree),
                         y + 4 + (kRadius + 14) * std::cos(angle * kDegree), angle);
    }
  for (int ring = 1; ring <= rings; ++ring)
    out += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"start\">{:g}</text>\n", kCentre + 3,
                       y + ring * step * scale - 2, ring * step);
  out += "</g>\n<g fill=\"none\" stroke-width=\"2\">\n";
  out += fmt::format("<polyline stroke=\"#c02020\" points=\"{}\"/>\n", curve(p, 0, scale));
  out += fmt::format("<polyline stroke=\"#2040c0\" stroke-dasharray=\"6 4\" points=\"{}\"/>\n",
                     curve(p, 90, scale));
  out += fmt::format(
      "</g>\n<text x=\"10\" y=\"{0}\"><tspan fill=\"#c02020\">C180 — C0</tspan>  <tspan fill=\"#2040c0\">"
      "C270 - - C90</tspan></text>\n<text x=\"{1}\" y=\"{0}\" text-anchor=\"end\">cd</text>\n</svg>\n",
      2 * kCentre + kTitle + 8, 2 * kCentre - 10);
  return out;
}

}  // namespace sconce
