// SPDX-License-Identifier: Apache-2.0
#include "photometry/diagram.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "image/stroke_font.h"
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
    kC90{0x20, 0x40, 0xc0}, kPeak{0x20, 0x80, 0x30}, kBlack{};
constexpr double kUplight =
    0.02;  // of the peak; with less above the horizon the diagram is of the lower half
constexpr double kPeakAbove = 1.03;  // what another plane must have of the drawn ones' peak to be drawn, too
constexpr double kLegend = 110;      // between its entries

double peak_in(const Photometry& p, double c) {
  double out = 0;
  for (const double gamma : p.polars)
    out = std::max({out, intensity_at(p, c, gamma), intensity_at(p, std::fmod(c + 180, 360), gamma)});
  return out;
}

/// Candelas above the horizon, a degree from it on, at most.
double peak_above(const Photometry& p) {
  double out = 0;
  for (std::size_t g = 0; g < p.polars.size(); ++g)
    for (std::size_t a = 0; a < p.azimuths.size() && p.polars[g] > 91; ++a) out = std::max(out, p.at(a, g));
  return out;
}

/// Where rings' values stand: on that of some directions, in degrees, on which curves leave most room.
double label_angle(const std::vector<Drawing::Line>& curves, const glm::dvec2& center, double step,
                   int rings) {
  constexpr double kWide = 26, kHigh = 9;  // about a label
  double best = 0;
  int least = std::numeric_limits<int>::max();
  for (const double angle : {0.0, 45.0, -45.0, 75.0, -75.0}) {
    int met = 0;
    for (int ring = 1; ring <= rings; ++ring) {
      const glm::dvec2 at =
          center + ring * step * glm::dvec2(std::sin(angle * kDegree), std::cos(angle * kDegree));
      met += std::ranges::any_of(curves, [&](const Drawing::Line& line) {
        return std::ranges::any_of(line.strokes.front(), [&](const glm::dvec2& p) {
          return std::abs(p.x - at.x) < kWide && std::abs(p.y - at.y) < kHigh;
        });
      });
    }
    if (met < least) least = met, best = angle;
  }
  return best;
}

/// @param lumens  of the table itself, where p is one of type C made of it
std::string figures(const Photometry& p, double lumens) {
  const double watts = p.lamps.empty() ? 0 : p.lamps.front().watts;
  std::string out = lumens < 100 ? fmt::format("{:.3g} lm", lumens) : fmt::format("{:.0f} lm", lumens);
  if (watts > 0) out += fmt::format(" · {:.3g} W · {:.0f} lm/W", watts, lumens / watts);
  return out + fmt::format(" · {:.0f}° × {:.0f}° at half of the peak (C0 × C90)", beam_angle(p, 0, 0.5),
                           beam_angle(p, 90, 0.5));
}

}  // namespace

void add_title(Drawing& drawing, const Photometry& p, const std::string& title, double middle) {
  constexpr double kName = 12, kMore = 10;
  const auto fitting = [&](std::string text, double size) {
    if (stroke_text_width(text, size) <= drawing.width - 20) return text;
    while (!text.empty() && stroke_text_width(text + "...", size) > drawing.width - 20) {
      while (text.size() > 1 && (static_cast<unsigned char>(text.back()) & 0xc0) == 0x80)
        text.pop_back();  // a letter's last bytes
      text.pop_back();
    }
    return text + "...";
  };
  const std::string name = p.keyword("LUMINAIRE");
  std::string more;
  for (const std::string& part : {p.keyword("MANUFAC"), p.keyword("LUMCAT"), name.empty() ? "" : title})
    if (!part.empty() && part != name) more += (more.empty() ? "" : " · ") + part;
  drawing.labels.push_back({{middle, 18},
                            fitting(name.empty() ? title : name, kName),
                            kBlack,
                            Drawing::Label::Anchor::middle,
                            kName});
  drawing.labels.push_back(
      {{middle, 34}, fitting(more, kMore), kText, Drawing::Label::Anchor::middle, kMore});
}

Drawing polar_diagram(const Photometry& given, const std::string& title) {
  using Anchor = Drawing::Label::Anchor;
  const Photometry p = as_type_c(given);
  const Peak highest = peak_of(p);
  const double peak = std::max(highest.candela, 1e-9), step = ring_step(peak);
  const int rings = static_cast<int>(std::ceil(peak / step - 1e-9));
  const double scale = kRadius / (rings * step);
  const bool whole = peak_above(p) > kUplight * peak;
  const double reach = whole ? 180 : 90;
  const glm::dvec2 center(kCentre, kTitle + (whole ? kCentre : kMargin));
  Drawing out;
  out.width = 2 * kCentre, out.height = center.y + kCentre + 34;
  add_title(out, p, title, kCentre);
  for (int ring = 1; ring <= rings; ++ring) out.arc(center, ring * step * scale, -reach, reach, kGrid);
  for (int angle = -180; angle < 180; angle += 30)
    if (std::abs(angle) <= reach)
      out.lines.push_back(
          {{{center, center + kRadius * glm::dvec2(std::sin(angle * kDegree), std::cos(angle * kDegree))}},
           kGrid});
  for (int angle = 0; angle <= static_cast<int>(reach); angle += 30)
    for (const int side : {-1, 1}) {
      if (side < 0 && angle % 180 == 0) continue;
      out.labels.push_back({center + glm::dvec2(side * (kRadius + 18) * std::sin(angle * kDegree),
                                                4 + (kRadius + 14) * std::cos(angle * kDegree)),
                            fmt::format("{}°", angle), kText, Anchor::middle});
    }
  std::vector<Drawing::Line> curves = {{{curve(p, 0, scale, center)}, kC0, 2},
                                       {{curve(p, 90, scale, center)}, kC90, 2, 8, 4}};
  const double foot = center.y + kCentre + 6;
  out.labels.push_back({{10, foot}, "C180 – C0", kC0});
  out.labels.push_back({{10 + kLegend, foot}, "C270 – C90 (dashed)", kC90});
  if (const double c = std::fmod(highest.azimuth, 180);
      peak > kPeakAbove * std::max(peak_in(p, 0), peak_in(p, 90))) {
    curves.push_back({{curve(p, c, scale, center)}, kPeak, 2, 2, 3});
    out.labels.push_back(
        {{10 + 2.4 * kLegend, foot}, fmt::format("C{:g} – C{:g} (dotted)", c + 180, c), kPeak});
  }
  const double angle = label_angle(curves, center, step * scale, rings);
  for (int ring = 1; ring <= rings; ++ring) {
    const glm::dvec2 at =
        center + ring * step * scale * glm::dvec2(std::sin(angle * kDegree), std::cos(angle * kDegree));
    out.labels.push_back({angle == 0 ? at + glm::dvec2(3, -3) : at + glm::dvec2(0, 4),
                          fmt::format("{:g}{}", ring * step, ring == rings ? " cd" : ""), kText,
                          angle == 0 ? Anchor::start : Anchor::middle, 10, true});
  }
  out.lines.insert(out.lines.end(), curves.begin(), curves.end());
  out.labels.push_back({{10, foot + 20}, figures(p, flux(given)), kBlack});
  return out;
}

}  // namespace sconce
