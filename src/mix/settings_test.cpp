// SPDX-License-Identifier: Apache-2.0
#include "mix/settings.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/kelvin.h"

namespace sconce {
namespace {

void expect_rgb(const Rgb& a, const Rgb& b, float tolerance = 1e-5f) {
  EXPECT_NEAR(a.r, b.r, tolerance * std::max(1.0f, b.r));
  EXPECT_NEAR(a.g, b.g, tolerance * std::max(1.0f, b.g));
  EXPECT_NEAR(a.b, b.b, tolerance * std::max(1.0f, b.b));
}

TEST(Settings, Gains) {
  const struct {
    const char* text;
    double gain;
  } cases[] = {{"off", 0},
               {"on", 1},
               {"0.5", 0.5},
               {"50%", 0.5},
               {"+1ev", 2},
               {"-1ev", 0.5},
               {"+1.5ev", std::exp2(1.5)},
               {"0.5,+1ev", 1},
               {"0", 0},
               {"2,50%,on", 1},
               {" 0.5 , +2ev", 2},
               {"OFF", 0},
               {"1e3", 1000},
               {"off,2700K", 0}};
  for (const auto& c : cases) EXPECT_DOUBLE_EQ(parse_setting(c.text).gain, c.gain) << c.text;
}

TEST(Settings, FluxAndColours) {
  EXPECT_EQ(parse_setting("800lm").lumens, 800);
  EXPECT_EQ(parse_setting("2700K").kelvin, 2700);
  EXPECT_EQ(parse_setting("2700k,0.5").gain, 0.5);
  EXPECT_EQ(parse_setting("color:#ff0000").color, Rgb(1, 0, 0));
  EXPECT_EQ(parse_setting("#FF0000").tint, Rgb(1, 0, 0));
  EXPECT_FLOAT_EQ(parse_setting("#808080").tint.g, srgb_to_linear(128 / 255.0f));
}

TEST(Settings, Bad) {
  for (const char* text : {"",
                           ",",
                           "0.5,",
                           "dim",
                           "-1",
                           "-50%",
                           "-5lm",
                           "nan",
                           "inf",
                           "infev",
                           "1e400",
                           "2000ev",
                           "0x10",
                           "5lux",
                           "1 2",
                           "999K",
                           "11001K",
                           "nanK",
                           "K",
                           "lm",
                           "ev",
                           "%",
                           "#12345",
                           "#1234567",
                           "#gg0000",
                           "#+10000",
                           "color:",
                           "color:red",
                           "color:#000000",
                           "2700K,4000K",
                           "2700K,#ff0000",
                           "color:#ff0000,#00ff00",
                           "800lm,700lm",
                           "0.5;2"}) {
    EXPECT_THROW(parse_setting(text), UsageError) << text;
  }
  try {
    parse_setting("0.5,dim");
  } catch (const UsageError& e) {
    EXPECT_NE(std::string(e.what()).find("'0.5,dim'"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("+1.5ev"), std::string::npos) << e.what();
  }
}

class Weights : public testing::Test {
 protected:
  Rgb weight(const char* setting) {
    return group_weight(group, parse_setting(setting),
                        [this](const std::string& w) { warnings.push_back(w); });
  }
  GroupInfo group{"lamp", 400, Rgb(1.0f), 0, false, 0, 0, {}};
  std::vector<std::string> warnings;
};

TEST_F(Weights, LumensReplaceTheFlux) {
  expect_rgb(weight("800lm"), Rgb(2));
  expect_rgb(weight("800lm,50%"), Rgb(1));
  group.infinite = true;
  EXPECT_THROW(weight("800lm"), UsageError);
  group.infinite = false;
  group.lumens = 0;
  EXPECT_THROW(weight("800lm"), UsageError);
}

TEST_F(Weights, ReplacedColourKeepsTheFlux) {
  group.color = {1.2f, 0.95f, 0.905f};
  group.color = group.color / luminance(group.color);
  for (const char* setting : {"2700K", "color:#3060ff"}) {
    const Rgb w = weight(setting);
    EXPECT_NEAR(luminance(w * group.color), 1, 1e-5) << setting;
  }
  expect_rgb(weight("2700K") * group.color, kelvin_color(2700));
  expect_rgb(weight("2700K,0.25") * group.color, 0.25f * kelvin_color(2700));
  EXPECT_TRUE(warnings.empty());
}

TEST_F(Weights, SixThousandFiveHundredAndFourKelvinIsWhite) {
  expect_rgb(weight("6504K"), Rgb(1), 1e-4f);
}

TEST_F(Weights, TintMultiplies) {
  expect_rgb(weight("#808080"), Rgb(srgb_to_linear(128 / 255.0f)));
  group.color = {2, 0.5f, 0.1f};
  expect_rgb(weight("#ff8000,2"), Rgb(2, 2 * srgb_to_linear(128 / 255.0f), 0));
}

TEST_F(Weights, OneWarningWhereTheColourIsNotExact) {
  group.color_spread = 0.3;
  weight("2700K");
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("'lamp'"), std::string::npos);
  weight("0.5");
  weight("#ff0000");
  EXPECT_EQ(warnings.size(), 1u);
  group.color_spread = 0;
  group.color = {4.7f, 0, 0};
  const Rgb w = weight("4000K");
  EXPECT_EQ(warnings.size(), 2u);
  EXPECT_EQ(w.g, 0);
  EXPECT_TRUE(std::isfinite(w.r));
}

std::vector<GroupInfo> groups() {
  std::vector<GroupInfo> out;
  for (const char* name : {"ceiling", "ceiling lamp", "mirror", "rest", "a*b", "x=y"}) {
    GroupInfo g;
    g.name = name;
    g.lumens = 100;
    out.push_back(g);
  }
  return out;
}

std::vector<float> weights(const std::vector<std::string>& assignments, const std::string& others = {}) {
  std::vector<float> out;
  for (const Rgb& w : make_mix(groups(), assignments, others, {}).weights) out.push_back(w.g);
  return out;
}

TEST(MakeMix, NamesGlobsAndQuotes) {
  EXPECT_EQ(weights({}), (std::vector<float>{1, 1, 1, 1, 1, 1}));
  EXPECT_EQ(weights({"ceiling=0.5"}), (std::vector<float>{0.5f, 1, 1, 1, 1, 1}));
  EXPECT_EQ(weights({"ceil*=0"}), (std::vector<float>{0, 0, 1, 1, 1, 1}));
  EXPECT_EQ(weights({"\"ceiling lamp\"=0"}), (std::vector<float>{1, 0, 1, 1, 1, 1}));
  EXPECT_EQ(weights({"'ceiling lamp'=0"}), (std::vector<float>{1, 0, 1, 1, 1, 1}));
  EXPECT_EQ(weights({"ceiling lamp=0"}), (std::vector<float>{1, 0, 1, 1, 1, 1}));
  EXPECT_EQ(weights({"a*b=2"}), (std::vector<float>{1, 1, 1, 1, 2, 1}));
  EXPECT_EQ(weights({"x=y=2"}), (std::vector<float>{1, 1, 1, 1, 1, 2}));
  EXPECT_EQ(weights({"all=0", "mirror=3"}), (std::vector<float>{0, 0, 3, 0, 0, 0}));
  EXPECT_EQ(weights({"mirror=3", "all=0"}), (std::vector<float>{0, 0, 0, 0, 0, 0}));
}

TEST(MakeMix, OthersAreTheGroupsNotNamed) {
  EXPECT_EQ(weights({"mirror=2"}, "off"), (std::vector<float>{0, 0, 2, 0, 0, 0}));
  EXPECT_EQ(weights({"rest=2"}, "50%"), (std::vector<float>{0.5f, 0.5f, 0.5f, 2, 0.5f, 0.5f}));
  EXPECT_EQ(weights({}, "0.5"), (std::vector<float>(6, 0.5f)));
}

TEST(MakeMix, UnknownGroupsAreHelpedWith) {
  for (const char* text :
       {"celing=1", "z*=1", "\"ceil*\"=1", "=1", "mirror", "\"mirror=1", "\"mirror\"1", ""})
    EXPECT_THROW(weights({text}), UsageError) << text;
  EXPECT_THROW(weights({}, "dim"), UsageError);
  try {
    weights({"celing=1"});
  } catch (const UsageError& e) {
    EXPECT_NE(std::string(e.what()).find("did you mean 'ceiling'?"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("mirror, rest"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace sconce
