// SPDX-License-Identifier: Apache-2.0
#include "photometry/doctor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "core/test_data.h"
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
  const std::string svg = polar_svg(uniform(), "a < b & c");
  EXPECT_NE(svg.find("a &lt; b &amp; c"), std::string::npos);
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

// 100 cd all around, 1 m above: E = 100 cos3, so 50 lx lie where cos3 = 1/2, at sqrt(2^(2/3) - 1) m; a metre
// is 100 units.
TEST(Diagram, IsoluxLinesLieWhereTheyShould) {
  const std::string svg = isolux_svg(uniform(), "lamp", 1);
  EXPECT_NE(svg.find("50 lx</text>"), std::string::npos);
  const std::size_t path = svg.find("<path d=\"M") + 9;
  const std::string text = svg.substr(path, svg.find('"', path) - path);
  const double radius = 100 * std::sqrt(std::pow(2, 2.0 / 3) - 1);
  int points = 0;
  for (std::size_t at = text.find_first_of("ML"); at != std::string::npos;
       at = text.find_first_of("ML", at + 1), ++points) {
    double x = 0, y = 0;
    ASSERT_EQ(std::sscanf(text.c_str() + at + 1, "%lf,%lf", &x, &y), 2);
    EXPECT_NEAR(std::hypot(x - 250, y - 280), radius, 0.3);
  }
  EXPECT_GT(points, 100);
}

}  // namespace
}  // namespace sconce
