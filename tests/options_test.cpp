// SPDX-License-Identifier: Apache-2.0
// One declaration serves command line, file, help and provenance.
#include <gtest/gtest.h>

#include "app.h"
#include "core/error.h"
#include "core/test_toml.h"
#include "process.h"
#include "values.h"

using namespace sconce;
using namespace sconce::app;

namespace {

struct Sample {
  std::string scene, out = "default.out";
  std::vector<std::string> groups, settings;
  int atlas = 1024;
  double noise = 0.05, time = 0, exposure = 0;
  bool force = false;
  Options options{"sample", "A sample."};

  Sample() {
    options.positional("scene", &scene, "the scene");
    options.positionals("settings", &settings, "GROUP=SETTING");
    options.option("-o,--output", &out, "where to");
    options.option("--group", &groups, "may be repeated");
    options.option("--atlas", &atlas, "texels");
    options.option("--noise", &noise, "share");
    options.option("--exposure", &exposure, "stops");
    options.duration("--time", &time, "limit");
    options.flag("--force", &force, "do it");
  }
  std::optional<int> parse(std::vector<const char*> args) {
    return options.parse(static_cast<int>(args.size()), args.data());
  }
};

std::string parse_error(std::vector<const char*> args) {
  Sample sample;
  testing::internal::CaptureStderr();
  const std::optional<int> code = sample.parse(std::move(args));
  const std::string text = testing::internal::GetCapturedStderr();
  EXPECT_EQ(code, std::optional<int>(kUsage)) << text;
  return text;
}

std::string file_error(const std::string& toml) {
  const TemporaryFolder folder;
  const std::string file = folder.write("side.toml", toml);
  Sample sample;
  EXPECT_EQ(sample.parse({"a.glb"}), std::nullopt);
  try {
    sample.options.apply_file(file, "side file");
  } catch (const UsageError& error) {
    return std::string(error.what()).substr(folder.path().string().size() + 1);
  }
  ADD_FAILURE() << "accepted: " << toml;
  return {};
}

}  // namespace

TEST(Options, ReadsEveryKind) {
  Sample s;
  ASSERT_EQ(
      s.parse({"a.glb", "--atlas", "512", "--noise=2%", "--time", "1.5h", "lamp=-1ev", "--exposure", "-1",
               "--group", "a", "--force", "--group", "b c", "-o", "-", "sun=off", "--threads", "3"}),
      std::nullopt);
  EXPECT_EQ(s.scene, "a.glb");
  EXPECT_EQ(s.atlas, 512);
  EXPECT_DOUBLE_EQ(s.noise, 0.02);
  EXPECT_DOUBLE_EQ(s.time, 5400);
  EXPECT_DOUBLE_EQ(s.exposure, -1);
  EXPECT_EQ(s.out, "-");
  EXPECT_TRUE(s.force);
  EXPECT_EQ(s.groups, (std::vector<std::string>{"a", "b c"}));
  EXPECT_EQ(s.settings, (std::vector<std::string>{"lamp=-1ev", "sun=off"}));
  EXPECT_EQ(s.options.threads, 3);
}

TEST(Options, CommandLineBeatsConfigBeatsSideFileBeatsDefault) {
  const TemporaryFolder folder;
  const std::string config = folder.write("my.toml", "[options]\nnoise = '1%'\natlas = 256\n");
  const std::string side =
      folder.write("a.toml", "name = 'x'\n[options]\natlas = 128\nforce = true\nnoise = 0.5\n");
  Sample s;
  ASSERT_EQ(s.parse({"a.glb", "--noise", "3%", "--config", config.c_str()}), std::nullopt);
  s.options.apply_file(side, "a.toml");
  EXPECT_DOUBLE_EQ(s.noise, 0.03);
  EXPECT_EQ(s.atlas, 256);
  EXPECT_TRUE(s.force);
  const auto from = s.options.provenance();
  EXPECT_EQ(from.at("noise").source, "command line");
  EXPECT_EQ(from.at("atlas").source, config + ":3");
  EXPECT_EQ(from.at("atlas").value, "256");
  EXPECT_EQ(from.at("force").source, "a.toml:4");
  EXPECT_EQ(from.at("output").source, "default");
  EXPECT_EQ(from.at("output").value, "default.out");
}

TEST(Options, AbsentSideFileAppliesNothing) {
  Sample s;
  ASSERT_EQ(s.parse({"a.glb"}), std::nullopt);
  EXPECT_NO_THROW(s.options.apply_file("/nonexistent/side.toml", "side file"));
}

TEST(Options, CommandLineErrorsAreOneClearLine) {
  EXPECT_EQ(parse_error({"a.glb", "--atlsa", "512"}),
            "sconce sample: unknown option '--atlsa'; did you mean '--atlas'?\n");
  EXPECT_EQ(parse_error({"--wholly-different", "a.glb"}),
            "sconce sample: unknown option '--wholly-different'; see --help\n");
  EXPECT_EQ(parse_error({}), "sconce sample: missing argument scene: the scene\n");
  EXPECT_EQ(parse_error({"a.glb", "--atlas"}), "sconce sample: option '--atlas' needs a value\n");
  EXPECT_EQ(parse_error({"--noise", "--force", "a.glb"}),
            "sconce sample: option '--noise' needs a value, got '--force'\n");
  EXPECT_EQ(parse_error({"a.glb", "--atlas", "big"}),
            "sconce sample: option '--atlas': expected a whole number, got 'big'\n");
  EXPECT_EQ(parse_error({"a.glb", "--atlas", "1", "--atlas", "2"}),
            "sconce sample: option '--atlas' is given more than once\n");
  EXPECT_EQ(parse_error({"a.glb", "--noise", "nan"}),
            "sconce sample: option '--noise': expected a number such as 0.02 or 2%, got 'nan'\n");
  EXPECT_EQ(parse_error({"a.glb", "--time", "5d"}),
            "sconce sample: option '--time': expected a duration such as 90s, 10m or 1h, got '5d'\n");
  EXPECT_EQ(parse_error({"a.glb", "--force=maybe"}),
            "sconce sample: option '--force': expected true or false, got 'maybe'\n");
  EXPECT_EQ(parse_error({"a.glb", "--config", "/nonexistent.toml"}),
            "sconce sample: /nonexistent.toml: no such file\n");
}

TEST(Options, FileErrorsNameLineKeyAndChoices) {
  EXPECT_EQ(file_error("[options]\natlass = 3\n"),
            "side.toml:2: unknown option 'atlass'; did you mean 'atlas'? (allowed: output, group, atlas, "
            "noise, exposure, "
            "time, force, json, quiet, threads)");
  EXPECT_EQ(file_error("\n\n[options]\natlas = 'big'\n"),
            "side.toml:4: option 'atlas': expected a whole number, got 'big'");
  EXPECT_EQ(file_error("[options]\nforce = 1\n"),
            "side.toml:2: option 'force': is a switch (allowed: true, false)");
  EXPECT_EQ(file_error("[options]\natlas = [1, 2]\n"),
            "side.toml:2: option 'atlas': takes one value, not a list");
  EXPECT_EQ(file_error("options = 3\n").find("side.toml:1: "), 0u);
  EXPECT_EQ(file_error("[options]\natlas = \n").find("side.toml:2: "), 0u);
  for (const std::string& text : broken_toml()) {
    const std::string line = file_error(text);
    EXPECT_EQ(line.find("side.toml:"), 0u) << text.substr(0, 40) << ": " << line;
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
  }
}

TEST(Options, HelpListsEverythingWithDefaults) {
  Sample s;
  testing::internal::CaptureStdout();
  EXPECT_EQ(s.parse({"--help"}), std::optional<int>(kDone));
  const std::string help = testing::internal::GetCapturedStdout();
  for (const char* text :
       {"usage: sconce sample SCENE [SETTINGS...]", "-o, --output TEXT", "[default.out]", "--time TIME",
        "[1024]", "--json", "--quiet", "--threads N", "--config TEXT", "--help"}) {
    EXPECT_NE(help.find(text), std::string::npos) << text << "\n" << help;
  }
}

TEST(Values, DurationsAndShares) {
  EXPECT_DOUBLE_EQ(parse_duration("90s"), 90);
  EXPECT_DOUBLE_EQ(parse_duration("10m"), 600);
  EXPECT_DOUBLE_EQ(parse_duration("1h"), 3600);
  EXPECT_DOUBLE_EQ(parse_duration("7"), 7);
  EXPECT_THROW(parse_duration("-1s"), UsageError);
  EXPECT_THROW(parse_duration("s"), UsageError);
  EXPECT_DOUBLE_EQ(parse_real("2%"), 0.02);
  EXPECT_THROW(parse_real("%"), UsageError);
  EXPECT_THROW(parse_int("3.5"), UsageError);
  EXPECT_THROW(parse_int(""), UsageError);
}
