// SPDX-License-Identifier: Apache-2.0
#include "mix/preset.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/files.h"
#include "core/test_toml.h"
#include "package/test_package.h"

namespace sconce {
namespace {

TEST(Preset, KeepsTheFilesOrder) {
  const TemporaryFolder folder;
  write_file(folder / "evening.toml",
             "exposure = 1\ntone = \"drago\"\ncamera = \"main\"\nothers = \"off\"\n"
             "[mix]\n\"lamp*\" = 0.25\nceiling = \"0.5,2700K\"\n\"a b\" = 2\n");
  const Preset preset = read_preset(folder / "evening.toml");
  EXPECT_EQ(preset.assignments, (std::vector<std::string>{"lamp*=0.25", "ceiling=0.5,2700K", "a b=2"}));
  EXPECT_EQ(preset.others, "off");
  EXPECT_EQ(preset.exposure, "1");
  EXPECT_EQ(preset.tone, "drago");
  EXPECT_EQ(preset.camera, "main");
}

TEST(Preset, OthersInsideMix) {
  const TemporaryFolder folder;
  write_file(folder / "p.toml", "[mix]\nothers = \"off\"\nz = 1\n");
  EXPECT_EQ(read_preset(folder / "p.toml").others, "off");
  EXPECT_EQ(read_preset(folder / "p.toml").assignments, std::vector<std::string>{"z=1"});
}

TEST(Preset, PrintedOnesReadBack) {
  Preset preset;
  preset.assignments = {"lamp*=0.25", "a \"b\" c=0.5,2700K", "ceiling=off"};
  preset.others = "off", preset.ev100 = "9", preset.tone = "drago";
  const TemporaryFolder folder;
  write_file(folder / "p.toml", print_preset(preset));
  const Preset read = read_preset(folder / "p.toml");
  EXPECT_EQ(read.assignments, preset.assignments);
  EXPECT_EQ(read.others, "off");
  EXPECT_EQ(read.ev100, "9");
  EXPECT_EQ(read.exposure, "");
  EXPECT_EQ(read.tone, "drago");
}

TEST(Preset, LampsReadBack) {
  Preset preset;
  preset.lamps = {{"a \"b\"#2", Vec3(1, -2.5f, 0.125f), Vec3(0, 1, 2), "spot,outer=40"},
                  {"c", {}, {}, "point"}};
  const TemporaryFolder folder;
  write_file(folder / "p.toml", print_preset(preset));
  const Preset read = read_preset(folder / "p.toml");
  ASSERT_EQ(read.lamps.size(), 2u);
  EXPECT_EQ(read.lamps[0].name, "a \"b\"#2");
  EXPECT_EQ(read.lamps[0].at, Vec3(1, -2.5f, 0.125f));
  EXPECT_EQ(read.lamps[0].target, Vec3(0, 1, 2));
  EXPECT_EQ(read.lamps[0].kind, "spot,outer=40");
  EXPECT_FALSE(read.lamps[1].at || read.lamps[1].target);
  EXPECT_EQ(read.lamps[1].kind, "point");
}

TEST(Preset, BadFilesNameFileAndLine) {
  const TemporaryFolder folder;
  const auto error = [&](const std::string& text) -> std::string {
    write_file(folder / "p.toml", text);
    try {
      read_preset(folder / "p.toml");
    } catch (const UsageError& e) {
      return e.what();
    }
    return "no error";
  };
  EXPECT_NE(error("\n\nmixx = 1\n").find("p.toml:3: unknown key 'mixx'"), std::string::npos);
  EXPECT_NE(error("mix = 1\n").find("p.toml:1"), std::string::npos);
  EXPECT_NE(error("[lamp.a]\nat = [1, 2]\n").find("p.toml:2: lamp 'a': 'at' is no place"), std::string::npos);
  EXPECT_NE(error("[lamp.a]\n\naim = [1, 2, 3]\n").find("p.toml:3: lamp 'a': unknown key 'aim'"),
            std::string::npos);
  EXPECT_NE(error("lamp = 3\n").find("p.toml:1: 'lamp' is no table"), std::string::npos);
  EXPECT_NE(error("[mix]\na = [1]\n").find("p.toml:2: 'a'"), std::string::npos);
  EXPECT_NE(error("[mix\n").find("p.toml:1"), std::string::npos);
  for (const std::string& text : broken_toml()) {
    const std::string line = error(text);
    EXPECT_NE(line.find("p.toml:"), std::string::npos) << text.substr(0, 40) << ": " << line;
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
  }
  EXPECT_THROW(read_preset(folder / "absent.toml"), Error);
}

}  // namespace
}  // namespace sconce
