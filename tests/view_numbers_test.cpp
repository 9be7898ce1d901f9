// SPDX-License-Identifier: Apache-2.0
// The window's numbers: goals, baked planes, probes.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/text.h"
#include "mix/preset.h"
#include "package/points.h"
#include "tone/apply.h"
#include "view_window.h"

namespace fs = std::filesystem;

namespace sconce {
namespace {

TEST_F(ViewTest, GoalsAreReached) {
  bake();
  const auto fitted =
      test::run_sconce({"fit", path("x.sconce"), "--lux", "1,0.8,1=250", "-o", path("fit.toml"), "--json"});
  ASSERT_EQ(fitted.code, 0) << fitted.err;
  EXPECT_NE(fitted.out.find("\"lux\": 2"), std::string::npos) << fitted.out;  // 24x to 25x
  EXPECT_EQ(read_preset(path("fit.toml")).assignments.size(), 4u);
  EXPECT_EQ(test::run_sconce({"fit", path("x.sconce")}).code, 2);
  EXPECT_EQ(test::run_sconce({"fit", path("x.sconce"), "--lux", "1,2=3"}).code, 2);
}

TEST_F(ViewTest, BakedPlanesFollowTheFadersExactly) {
  write_file(folder_ / "room.glb", write_glb(test::two_lamp_room(), "test"));
  folder_.write("room.toml",
                "[[plane]]\nname = \"desk\"\nat = \"floor+0.9\"\ngrid = 0.4\n"
                "[[plane]]\nname = \"floor\"\nat = \"floor+0.01\"\ngrid = 0.4\n");
  const auto baked = test::run_sconce(
      {"bake", path("room.glb"), "-o", path("x.sconce"), "--density", "6", "--samples", "8", "--quiet"});
  ASSERT_EQ(baked.code, 0) << baked.err;
  const auto outcome =
      view("plane desk\nset left=0.3 right=2\nfigures " + path("figures.csv") + "\nsettle\n");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::vector<std::string> lines = split(read_file(path("figures.csv")), '\n');
  ASSERT_EQ(lines.size(), 4u);  // a head, two planes, nothing behind the last end of line
  for (const auto& [line, name] : {std::pair{lines[1], "desk"}, {lines[2], "floor"}}) {
    const std::vector<std::string> figures = split(line, ',');
    EXPECT_EQ(figures.at(0), name);
    const auto probed =
        test::run_sconce({"probe", path("x.sconce"), "--plane", name, "left=0.3", "right=2", "--json"});
    ASSERT_EQ(probed.code, 0) << probed.err;
    const auto lux = nlohmann::json::parse(probed.out)["lux"];
    std::size_t i = 2;
    for (const char* figure : {"minimum", "average", "maximum", "uniformity"})
      EXPECT_NEAR(parse_number(figures.at(i++)).value(), lux[figure].get<double>(),
                  1e-5 * lux[figure].get<double>())
          << figure;
  }
  const auto unknown = view("plane roof\n");
  EXPECT_EQ(unknown.code, 2);
  EXPECT_NE(unknown.err.find("baked: desk, floor"), std::string::npos) << unknown.err;
}

// Planes, goals and what faders are sought by follow a lamp that was moved: a scene that has it there says
// how.
TEST_F(ViewTest, FiguresFollowMovedLamps) {
  bake_movable();
  const auto outcome =
      view("set right=0.5\nplane 0.9 0.4\nwish 0.2,0.8,0.3 300\nsettle\nfigures " + path("home.csv") +
           "\nlamp \"lamp left\" 0,1.4,0.2\nsettle\nfigures " + path("there.csv") + "\nscene " +
           path("written.glb") + "\nseek\nwait 1.2\nsettle\nfigures " + path("sought.csv") +
           "\nmove 300,300\nframes 3\nscreenshot " + path("all.png") +
           "\nhome\nset left=1 right=0.5\nsettle\nfigures " + path("back.csv") + "\n");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  Scene moved = test::two_lamp_room();
  for (Instance& instance : moved.instances)
    if (instance.name == "lamp left") instance.transform[3] += glm::vec4(0.6f, -0.58f, 0.2f, 0);
  folder_.write("moved.glb", write_glb(moved, "test"));
  for (const char* scene : {"moved.glb", "written.glb"}) {
    const auto baked = test::run_sconce({"bake", path(scene), "--density", "4", "--samples", "1", "--quiet"});
    ASSERT_EQ(baked.code, 0) << baked.err;
  }
  const auto figures = [&](const char* file) {
    std::vector<std::vector<std::string>> rows;
    for (const std::string& line : split(read_file(path(file)), '\n')) rows.push_back(split(line, ','));
    return rows;
  };
  const auto average = [&](const char* file, std::size_t row) {
    return parse_number(figures(file).at(row).at(3)).value();
  };
  const auto probed = [&](std::vector<std::string> at, const std::string& package) {
    at.insert(at.begin(), {"probe", package});
    for (const char* word : {"right=0.5", "--json"}) at.emplace_back(word);
    const auto probe = test::run_sconce(at);
    EXPECT_EQ(probe.code, 0) << probe.err;
    return nlohmann::json::parse(probe.out)["lux"]["average"].get<double>();
  };
  ASSERT_EQ(figures("there.csv").at(2).at(0), "goal 1");
  const double plane = probed({"--plane", "floor+0.9", "--grid", "0.4"}, path("moved.sconce")),
               goal = probed({"--at", "0.2,0.8,0.3"}, path("moved.sconce"));
  EXPECT_NEAR(average("there.csv", 1), plane, 0.02 * plane);
  EXPECT_NEAR(average("there.csv", 2), goal, 0.02 * goal);
  EXPECT_GT(std::abs(average("home.csv", 2) - goal), 0.1 * goal);
  // The scene that the window writes has its lamps there; right was at 0.5.
  const auto written =
      test::run_sconce({"probe", path("written.sconce"), "--plane", "floor+0.9", "--grid", "0.4", "--json"});
  ASSERT_EQ(written.code, 0) << written.err;
  EXPECT_NEAR(nlohmann::json::parse(written.out)["lux"]["average"].get<double>(), plane, 0.01 * plane);
  // The command measures what the window does.
  const auto commanded = [&](std::vector<std::string> at) {
    at.insert(at.end(), {"--move", "lamp left=0,1.4,0.2"});
    return probed(std::move(at), path("x.sconce"));
  };
  const double commanded_plane = commanded({"--plane", "floor+0.9", "--grid", "0.4"}),
               commanded_goal = commanded({"--at", "0.2,0.8,0.3"});
  EXPECT_NEAR(average("there.csv", 1), commanded_plane, 0.01 * plane);
  EXPECT_NEAR(average("there.csv", 2), commanded_goal, 0.01 * goal);
  EXPECT_NEAR(commanded_plane, plane, 0.01 * plane);
  EXPECT_NEAR(average("sought.csv", 2), 300, 3);
  EXPECT_NEAR(average("back.csv", 1), average("home.csv", 1), 0.1);
  EXPECT_NEAR(average("back.csv", 2), average("home.csv", 2), 0.1);
}

// Faders are sought for a picture of the room with its panel and block elsewhere, which another bake made: by
// the window, and by the command, which also has a lamp beside the groups.
TEST_F(ViewTest, PicturesAreSoughtWithThingsWhereTheyAre) {
  bake_movable();
  const Vec3 there = test::kBlock + Vec3(-0.9f, 0, 0.2f);
  const std::string block = fmt::format("{},{},{}", there.x, there.y, there.z);
  Scene moved = test::with_block_at(there, 0);
  for (Instance& instance : moved.instances)
    if (instance.name == "lamp left") instance.transform[3] += glm::vec4(0.6f, -0.58f, 0.2f, 0);
  folder_.write("moved.glb", write_glb(moved, "test"));
  const auto run = [](const std::vector<std::string>& words) {
    const auto outcome = test::run_sconce(words);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
  };
  run({"bake", path("moved.glb"), "--density", "24", "--samples", "128", "--quiet"});
  run({"transfer", path("moved.sconce"), "--gather", "1024", "--quiet"});
  const auto gains = [&](const std::string& preset) {
    std::map<std::string, double> out;
    for (const std::string& assignment : read_preset(path(preset)).assignments) {
      const std::size_t equals = assignment.find('=');
      out[assignment.substr(0, equals)] = parse_number(assignment.substr(equals + 1)).value();
    }
    return out;
  };
  const auto expect_gains = [&](const std::string& preset) {
    auto found = gains(preset);
    EXPECT_NEAR(found["left"], 0.6, 0.02) << preset;
    EXPECT_NEAR(found["right"], 1.7, 0.05) << preset;
  };
  const std::vector<std::string> mix{"left=0.6", "right=1.7", "--size", "240x240", "--device", "cpu"};
  const auto picture = [&](std::vector<std::string> words) {
    words.insert(words.end(), mix.begin(), mix.end());
    run(words);
  };
  picture({"render", path("moved.sconce"), "-o", path("moved.exr")});
  const auto outcome =
      view("lamp \"lamp left\" 0,1.4,0.2\nobject block " + block + "\nsettle\nlike " + path("moved.exr") +
           "\nwait 1.2\nsettle\nsave " + path("window.toml") + "\nscreenshot " + path("all.png") + "\n");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  expect_gains("window.toml");

  const std::vector<std::string> elsewhere{"--move", "lamp left=0,1.4,0.2", "--object", "block=" + block};
  const std::string lamp = "point,position=-0.5,1.2,0.5,lumens=20";
  picture({"relight", path("moved.sconce"), "--light", lamp, "-o", path("more.exr")});
  std::vector<std::string> words{"fit", path("x.sconce"),    "--target", path("more.exr"), "--light", lamp,
                                 "-o",  path("command.toml")};
  words.insert(words.end(), elsewhere.begin(), elsewhere.end());
  run(words);
  expect_gains("command.toml");
  // As it was baked the room does not look like that.
  run({"fit", path("x.sconce"), "--target", path("moved.exr"), "-o", path("home.toml")});
  EXPECT_GT(std::abs(gains("home.toml")["left"] - 0.6), 0.1);
}

// The reference beside the lightmap is traced with the lamp where it went: its floor is as bright as that of
// a scene which has it there, and as the lightmap's.
TEST_F(ViewTest, ReferencesFollowMovedLamps) {
  bake_movable();
  Scene moved = test::two_lamp_room();
  for (Instance& instance : moved.instances)
    if (instance.name == "lamp left") instance.transform[3] += glm::vec4(0.3f, -0.9f, 0.3f, 0);
  folder_.write("moved.glb", write_glb(moved, "test"));
  const auto baked =
      test::run_sconce({"bake", path("moved.glb"), "--density", "4", "--samples", "1", "--quiet"});
  ASSERT_EQ(baked.code, 0) << baked.err;
  const auto floor_of = [&](const char* package, const std::string& more, double from) {
    const auto outcome =
        view("ev100 3\ntone linear\nset right=off\neye 0,0.5,0.9 0,0,-0.2\nlook reference\n" + more +
                 "wait 6\npicture " + path("bare.png") + "\nscreenshot " + path("all.png") + "\n",
             package);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const Image8 bare = png("bare.png"), all = png("all.png");
    double sum = 0;
    int count = 0;
    for (int y = 44 + bare.height * 7 / 10; y < 44 + bare.height * 9 / 10; ++y)  // below the bar
      for (int x = static_cast<int>(from * bare.width); x < static_cast<int>((from + 0.2) * bare.width);
           ++x, ++count)
        sum += static_cast<double>(
            srgb_to_linear(all.data[3 * static_cast<std::size_t>(y * all.width + x) + 1] / 255.0f));
    return sum / count;
  };
  const std::string move = "lamp \"lamp left\" -0.3,1.08,0.3\n";
  const double truth = floor_of("moved.sconce", "", 0.55);
  EXPECT_GT(truth, 0.05);
  EXPECT_LT(truth, 0.9);
  EXPECT_NEAR(floor_of("x.sconce", move, 0.55), truth, 0.03 * truth);
  EXPECT_GT(std::abs(floor_of("x.sconce", "", 0.55) - truth), 0.1 * truth);
}

// A lamp that became a shader counts, as paths from the same lamp do and the command has it.
TEST_F(ViewTest, FiguresKnowShaders) {
  bake_movable();
  const std::string shader =
      "shader,intensity=12,file=" + (fs::path(SCONCE_SOURCE_DIR) / "examples/lights/point.glsl").string();
  const auto outcome = view(
      "set right=0.5\nplane 0.9 0.4\nwish 0.2,0.8,0.3 300\nlamp \"lamp left\" 0,1.4,0.2\n"
      "kind \"lamp left\" " +
      shader + "\nsettle\nfigures " + path("shader.csv") + "\nmove 300,300\nframes 3\nscreenshot " +
      path("all.png") + "\n");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::vector<std::string> lines = split(read_file(path("shader.csv")), '\n');
  const auto probed = [&](const std::string& kind, std::vector<std::string> words) {
    words.insert(words.begin(), {"probe", path("x.sconce"), "right=0.5", "--json", "--move",
                                 "lamp left=0,1.4,0.2", "--kind", "lamp left=" + kind});
    const auto probe = test::run_sconce(words);
    EXPECT_EQ(probe.code, 0) << probe.err;
    return nlohmann::json::parse(probe.out)["lux"]["average"].get<double>();
  };
  std::size_t row = 1;
  for (const std::vector<std::string>& at :
       {std::vector<std::string>{"--plane", "floor+0.9", "--grid", "0.4"}, {"--at", "0.2,0.8,0.3"}}) {
    const double figure = parse_number(split(lines.at(row++), ',').at(3)).value();
    EXPECT_NEAR(figure, probed("point,intensity=12", at), 0.02 * figure) << row;
    EXPECT_NEAR(figure, probed(shader, at), 0.01 * figure) << row;
  }
}

// The middle of a ball right before the camera faces it: 0.8 E / pi of the probes around, as it is exposed.
TEST_F(ViewTest, ABallTakesTheMixFromProbes) {
  folder_.write("room.glb", write_glb(test::two_lamp_room(), "test"));
  const auto baked = test::run_sconce({"bake", path("room.glb"), "-o", path("x.sconce"), "--density", "6",
                                       "--samples", "64", "--probes", "0.5", "--quiet"});
  ASSERT_EQ(baked.code, 0) << baked.err;
  const auto outcome = view(
      "eye 0,1,0.95 0,1,-1\ntone linear\nev100 1\nball 0,1,0.2 0.15\nset left=0.5\nsettle\n"
      "screenshot " +
      path("all.png") + "\npicture " + path("bare.png") + "\n");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Image8 all = png("all.png"), bare = png("bare.png");
  const ProbeGrid probes = *read_probes(Package::open(path("x.sconce")));
  const Rgb e = probes.illuminance({0, 1, 0.2f}, {0, 0, 1}, std::vector<Rgb>{Rgb(0.5f), Rgb(1)});
  const Rgb expected = tone_map(0.8f * kInvPi * e, ev100_exposure(1, 1), find_tone_mapper("linear"));
  const int x = bare.width / 2, y = 44 + bare.height / 2;  // below the bar
  const unsigned char* seen = &all.data[3 * static_cast<std::size_t>(y * all.width + x)];
  EXPECT_NEAR(seen[0], 255 * expected.r, 3);
  EXPECT_NEAR(seen[1], 255 * expected.g, 3);
  EXPECT_NEAR(seen[2], 255 * expected.b, 3);
  EXPECT_GT(seen[1], 40);
  EXPECT_LT(seen[1], 230);
}

}  // namespace
}  // namespace sconce
