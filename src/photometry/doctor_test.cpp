// SPDX-License-Identifier: Apache-2.0
#include "photometry/doctor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "core/test_data.h"
#include "image/stroke_font.h"
#include "photometry/diagram.h"
#include "photometry/formats.h"

namespace sconce {
namespace {

bool warns(const std::vector<Finding>& findings, std::string_view part) {
  for (const Finding& f : findings)
    if (f.warning && f.text.find(part) != std::string::npos) return true;
  return false;
}

Photometry uniform() {
  Photometry p;
  p.azimuths = {0, 90, 180, 270, 360};
  for (int g = 0; g <= 180; g += 5) p.polars.push_back(g);
  p.candela.assign(5 * p.polars.size(), 100);
  p.stated = 400 * M_PI;
  p.opening.size = Vec3(0.2f);
  return p;
}

// One fault at a time.
TEST(Doctor, FindsSeededFaults) {
  EXPECT_TRUE(examine(uniform()).empty());
  Photometry p = uniform();
  *p.stated *= 1.01;
  EXPECT_TRUE(warns(examine(p), "integrates to 1256.6 lm where 1269.2 lm are stated (-1.0 %)"));
  p = uniform();
  p.candela[0] = 110;
  EXPECT_TRUE(warns(examine(p), "planes disagree at nadir: 100 to 110 cd"));
  p = uniform();
  p.polars.erase(p.polars.begin() + 3, p.polars.begin() + 6);
  p.candela.assign(5 * p.polars.size(), 100);
  EXPECT_TRUE(warns(examine(p), "up to 20 degrees apart"));
  p = uniform();
  p.lamps = {{1, 1000, 0, "", "", ""}};
  EXPECT_TRUE(warns(examine(p), "more than the 1000 lm of its lamps"));
  p = uniform();
  p.polars.resize(19);
  p.candela.assign(5 * 19, 100);
  p.stated = 200 * M_PI;
  EXPECT_TRUE(warns(examine(p), "the table ends at 90 degrees with 100 % of its peak"));
  p = uniform();
  p.candela.assign(p.candela.size(), 0);
  EXPECT_TRUE(warns(examine(p), "no light at all"));
  p = uniform();
  p.opening.size = Vec3(0);
  ASSERT_EQ(examine(p).size(), 1u);
  EXPECT_FALSE(examine(p)[0].warning);
}

TEST(Doctor, KnowsWhereATableIsTooCoarse) {
  const auto file = test_data() / "photometry/ldt/eulumdat-ugr/input/sample_05.ldt";
  SCONCE_NEEDS_DATA(file);
  EXPECT_TRUE(warns(examine(read_photometry(file)), "too wide for its beam to tell"));
}

TEST(Diagram, IsWellFormed) {
  const std::string svg = svg_of(polar_diagram(uniform(), "a < b & c"));
  EXPECT_NE(svg.find("a &lt; b &amp; c"), std::string::npos);
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

// 100 cd all around, 1 m above: E = 100 cos3, so 50 lx lie where cos3 = 1/2, at sqrt(2^(2/3) - 1) m; a metre
// is 100 units.
TEST(Diagram, IsoluxLinesLieWhereTheyShould) {
  const Drawing drawing = isolux_diagram(uniform(), "lamp", 1);
  EXPECT_NE(svg_of(drawing).find("50 lx</text>"), std::string::npos);
  const double radius = 100 * std::sqrt(std::pow(2, 2.0 / 3) - 1);
  int points = 0;
  for (const auto& stroke : drawing.lines.at(1).strokes)
    for (const glm::dvec2& p : stroke) {
      EXPECT_NEAR(std::hypot(p.x - 250, p.y - 280), radius, 0.3);
      ++points;
    }
  EXPECT_GT(points, 100);
}

/// Intensities 1000 cd down to `edge` degrees, 1 cd from there to `end`.
Photometry beam(double edge, double end) {
  Photometry p = uniform();
  p.polars = {0, edge, edge + 1, end};
  p.candela.clear();
  for (std::size_t a = 0; a < p.azimuths.size(); ++a) p.candela.insert(p.candela.end(), {1000, 1000, 1, 1});
  return p;
}

// Lines that cross the picture alone are named, each once beside it and once on itself, the values apart; a
// narrow beam has a narrow floor.
TEST(Diagram, IsoluxNamesWhatItShows) {
  const auto labels = [](const Drawing& drawing, const std::string& text) {
    std::vector<glm::dvec2> out;
    for (const Drawing::Label& label : drawing.labels)
      if (label.text == text) out.push_back(label.at);
    return out;
  };
  const Drawing wide = isolux_diagram(uniform(), "lamp", 1);
  EXPECT_EQ(labels(wide, "50 lx").size(), 1u);
  const auto fifty = labels(wide, "50"), twenty = labels(wide, "20");
  ASSERT_EQ(fifty.size(), 1u);
  ASSERT_EQ(twenty.size(), 2u);
  const double radius = 100 * std::sqrt(std::pow(2, 2.0 / 3) - 1);
  EXPECT_NEAR(std::hypot(fifty[0].x - 250, fifty[0].y - 4 - 280), radius, 0.3);
  // 100 cos3 is 3.7 lx in the corners: no line of 2.
  EXPECT_GE(labels(wide, "5").size(), 1u);
  EXPECT_EQ(labels(wide, "2").size(), 2u) << "metres alone";
  EXPECT_EQ(labels(wide, "1.5").size(), 2u) << "metres to 2";
  const Drawing narrow = isolux_diagram(beam(10, 90), "lamp", 1);
  EXPECT_EQ(labels(narrow, "1.5").size(), 0u);
  EXPECT_EQ(labels(narrow, "0.4").size(), 2u) << "metres to half";
}

// The lower half alone unless light that one can see goes up; long names end in dots within the picture.
TEST(Diagram, PolarFitsItsLampAndItsName) {
  EXPECT_EQ(polar_diagram(beam(10, 90), "lamp").height, polar_diagram(beam(10, 180), "lamp").height);
  EXPECT_GT(polar_diagram(uniform(), "lamp").height, polar_diagram(beam(10, 90), "lamp").height);
  const std::string name(200, 'W');
  const Drawing drawing = polar_diagram(uniform(), name);
  const Drawing::Label& title = drawing.labels.front();
  EXPECT_EQ(title.text.substr(title.text.size() - 3), "...");
  EXPECT_LT(stroke_text_width(title.text, title.size), drawing.width);
}

// The same drawing as pixels: what lies on the line of 50 lx has its colour, what lies beside it is white;
// the dashed curve of a lamp that is alike all around lies on the solid one.
TEST(Diagram, PixelsShowWhatTheDrawingHas) {
  constexpr int kScale = 2;
  const Drawing isolux = isolux_diagram(uniform(), "lamp", 1);
  const Image8 picture = picture_of(isolux, kScale);
  EXPECT_EQ(picture.width, 1000);
  EXPECT_EQ(picture.height, 1100);
  const auto at = [&](const Image8& image, double x, double y) {
    const auto i = 3 * static_cast<std::size_t>(static_cast<int>(y * kScale) * image.width +
                                                static_cast<int>(x * kScale));
    return Color8{image.data[i], image.data[i + 1], image.data[i + 2]};
  };
  const double radius = 100 * std::sqrt(std::pow(2, 2.0 / 3) - 1), aslant = std::sqrt(0.5);
  const Color8 line = isolux.lines.at(1).color, white{255, 255, 255};
  EXPECT_EQ(at(picture, 250 - aslant * radius, 280 + aslant * radius), line);
  EXPECT_EQ(at(picture, 250 - aslant * (radius - 4), 280 + aslant * (radius - 4)), white);
  // 100 cd in rings of 20: the curve is the outermost circle, of 200 units.
  const Drawing polar = polar_diagram(uniform(), "lamp");
  const Image8 curves = picture_of(polar, kScale);
  int red = 0, blue = 0, other = 0;
  for (int i = 30; i < 720; ++i) {  // without the first 15 degrees, where the ring's label stands
    const double angle = i * M_PI / 360;
    const Color8 c = at(curves, 250 + 200 * std::sin(angle), 280 + 200 * std::cos(angle));
    red += c == Color8{0xc0, 0x20, 0x20}, blue += c == Color8{0x20, 0x40, 0xc0};
    other += c == white;
  }
  EXPECT_NEAR(blue, 0.67 * 690, 0.1 * 690) << "dashes of 8 in 12";
  EXPECT_GT(red, 80);
  EXPECT_EQ(other, 0);
}

}  // namespace
}  // namespace sconce
