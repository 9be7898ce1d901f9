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
std::vector<glm::dvec2> curve(const Photometry& p, double c, double scale, const glm::dvec2& center) {
  std::vector<glm::dvec2> points;
  for (int i = -360; i <= 360; ++i) {
    const double angle = i * 0.5, plane = std::fmod(angle < 0 ? c + 180 : c, 360);
    const double r = intensity_at(p, plane, std::abs(angle)) * scale;
    points.push_back(center + r * glm::dvec2(std::sin(angle * kDegree), std::cos(angle * kDegree)));
  }
  return points;
}

constexpr Color8 kGrid{0xcc, 0xcc, 0xcc}, kText{0x55, 0x55, 0x55}, kC0{0xc0, 0x20, 0x20},
    kC90{0x20, 0x40, 0xc0}, kBlack{};

}  // namespace

Drawing polar_diagram(const Photometry& given, const std::string& title) {
  using Anchor = Drawing::Label::Anchor;
  const Photometry p = as_type_c(given);
  const double peak = std::max(peak_of(p).candela, 1e-9), step = ring_step(peak);
  const int rings = static_cast<int>(std::ceil(peak / step - 1e-9));
  const double scale = kRadius / (rings * step);
  const glm::dvec2 center(kCentre, kTitle + kCentre);
  Drawing out;
  out.width = 2 * kCentre, out.height = 2 * kCentre + kTitle + 20;
  out.labels.push_back({{kCentre, 20}, title, kBlack, Anchor::middle, 13});
  for (int ring = 1; ring <= rings; ++ring) out.circle(center, ring * step * scale, kGrid);
  for (int angle = 0; angle < 180; angle += 30) {
    const glm::dvec2 to = kRadius * glm::dvec2(std::sin(angle * kDegree), std::cos(angle * kDegree));
    out.lines.push_back({{{center - to, center + to}}, kGrid});
  }
  for (int angle = 0; angle <= 180; angle += 30)
    for (const int side : {-1, 1}) {
      if (side < 0 && angle % 180 == 0) continue;
      out.labels.push_back({center + glm::dvec2(side * (kRadius + 18) * std::sin(angle * kDegree),
                                                4 + (kRadius + 14) * std::cos(angle * kDegree)),
                            fmt::format("{}°", angle), kText, Anchor::middle});
    }
  for (int ring = 1; ring <= rings; ++ring)
    out.labels.push_back(
        {center + glm::dvec2(3, ring * step * scale - 2), fmt::format("{:g}", ring * step), kText});
  out.lines.push_back({{curve(p, 0, scale, center)}, kC0, 2});
  out.lines.push_back({{curve(p, 90, scale, center)}, kC90, 2, 6});
  const double foot = 2 * kCentre + kTitle + 8;
  out.labels.push_back({{10, foot}, "C180 - C0", kC0});
  out.labels.push_back({{90, foot}, "C270 - C90", kC90});
  out.labels.push_back({{2 * kCentre - 10, foot}, "cd", kBlack, Anchor::end});
  return out;
}

}  // namespace sconce
