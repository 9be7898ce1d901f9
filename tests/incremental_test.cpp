// SPDX-License-Identifier: Apache-2.0
// Baking again after a change: what the change does not touch is kept, bit for bit.
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <functional>
#include <nlohmann/json.hpp>
#include <thread>

#include "package/package.h"
#include "process.h"
#include "small_scenes.h"

namespace fs = std::filesystem;

namespace sconce {
namespace {

using Names = std::vector<std::string>;

class Incremental : public testing::Test {
 protected:
  TemporaryFolder folder;
  Scene scene = test::two_lamp_room();
  const fs::path package = folder / "room.sconce";

  void SetUp() override { add_point("bulb", Vec3(-0.5f, 1, 0.5f)); }

  void add_point(const std::string& name, const Vec3& place) {
    Light light;
    light.name = name;
    light.frame[3] = glm::vec4(place, 1);
    light.intensity = Rgb(100, 80, 60);
    scene.lights.push_back(light);
  }
  Material& material(const std::string& name) {
    for (Material& m : scene.materials)
      if (m.name == name) return m;
    throw std::logic_error(name);
  }
  Names arguments(const Names& more) const {
    Names words{"bake", (folder / "room.glb").string(), "--density", "16", "--samples", "16", "--encoding",
                "f32"};
    for (std::size_t i = 0; i < more.size(); ++i) {
      const auto given = std::find(words.begin(), words.end(), more[i]);
      if (given == words.end()) {
        words.push_back(more[i]);
      } else {
        *(given + 1) = more[++i];
      }
    }
    return words;
  }
  /// Bakes the scene as it is now; the names of the groups that were solved.
  Names bake(const Names& more = {}) {
    write_file(folder / "room.glb", write_glb(scene, "test"));
    Names words = arguments(more);
    words.push_back("--json");
    const test::Outcome outcome = test::run_sconce(words);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    Names solved;
    if (outcome.code != 0 || outcome.out.find("up to date") != std::string::npos) return solved;
    const auto json = nlohmann::json::parse(outcome.out);
    for (const auto& group : json["groups"])
      if (!group["kept"].get<bool>()) solved.push_back(group["name"]);
    EXPECT_EQ(json["solved"].get<std::size_t>(), solved.size());
    return solved;
  }
  std::map<std::string, std::string> layers() const {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::directory_iterator(package / "layers"))
      files[entry.path().filename().string()] = read_file(entry.path());
    return files;
  }
  Names groups() const {
    Names names;
    const Manifest manifest = Package::open(package).manifest();
    for (const GroupInfo& group : manifest.groups) names.push_back(group.name);
    return names;
  }
};

TEST_F(Incremental, StrengthScalesItsLayerAndNoOther) {
  ASSERT_EQ(bake(), (Names{"left", "right", "bulb"}));
  const auto before = layers();
  const Image right = Package::open(package).layer(1, 0), noise = Package::open(package).noise(0);
  EXPECT_EQ(bake(), Names{}) << "nothing has changed";
  material("cool").emission *= 2.0f;
  EXPECT_EQ(bake(), Names{"right"});
  const Package after = Package::open(package);
  auto now = layers();
  EXPECT_NE(now["right.0.exr"], before.at("right.0.exr"));
  now["right.0.exr"] = before.at("right.0.exr");
  EXPECT_EQ(now, before);
  const Image twice = after.layer(1, 0);
  for (std::size_t i = 0; i < right.data.size(); ++i) ASSERT_EQ(twice.data[i], 2 * right.data[i]);
  EXPECT_EQ(after.noise(0).data, noise.data) << "relative noise is that of before";
  EXPECT_EQ(bake(), Names{}) << "now this is what stands";
  EXPECT_EQ(bake({"--force"}), (Names{"left", "right", "bulb"}));
}

TEST_F(Incremental, MovedAddedAndRemovedLamps) {
  bake();
  const auto before = layers();
  scene.lights[0].frame[3].x += 0.3f;
  EXPECT_EQ(bake(), Names{"bulb"});
  const auto moved = layers();
  EXPECT_EQ(moved.at("left.0.exr"), before.at("left.0.exr"));
  EXPECT_NE(moved.at("bulb.0.exr"), before.at("bulb.0.exr"));

  add_point("candle", Vec3(0.5f, 0.9f, 0.5f));
  EXPECT_EQ(bake(), Names{"candle"});
  EXPECT_EQ(groups(), (Names{"left", "right", "bulb", "candle"}));
  EXPECT_EQ(layers().at("bulb.0.exr"), moved.at("bulb.0.exr"));

  scene.lights.erase(scene.lights.begin());
  material("warm").emission = Rgb(0);
  EXPECT_EQ(bake(), Names{});
  EXPECT_EQ(groups(), (Names{"right", "candle"}));
  EXPECT_EQ(layers().size(), 2u);
  EXPECT_EQ(layers().at("right.0.exr"), before.at("right.0.exr"));
}

/// A lamp that joins another bake than the one that laid out the texels: the same light as from nothing, up
/// to noise.
TEST_F(Incremental, AddedLayerIsThatOfAWholeBake) {
  const Light bulb = scene.lights[0];
  scene.lights.clear();
  bake();
  scene.lights.push_back(bulb);
  ASSERT_EQ(bake({"--samples", "16"}), Names{"bulb"});
  const double kept = Package::open(package).manifest().groups[2].mean_lux;
  bake({"--force"});
  EXPECT_NEAR(kept / Package::open(package).manifest().groups[2].mean_lux, 1, 0.01);
}

TEST_F(Incremental, SurroundingsAndOptionsTouchAllGroups) {
  const Names all{"left", "right", "bulb"};
  bake();
  material("red").base_color = Rgb(0.1f, 0.7f, 0.1f);
  EXPECT_EQ(bake(), all);
  scene.instances[6].transform[3].x += 0.1f;
  EXPECT_EQ(bake(), all);
  EXPECT_EQ(bake({"--samples", "24"}), all);
  EXPECT_EQ(bake({"--bounces", "2"}), all);
  EXPECT_EQ(bake({"--solver", "path"}), all);
}

TEST_F(Incremental, GroupingKeepsWhatHasTheSameLamps) {
  bake();
  const Image left = Package::open(package).layer(0, 0);
  EXPECT_EQ(bake({"--groups", "per-light"}), Names{}) << "one lamp each: only names change";
  EXPECT_EQ(groups(), (Names{"lamp left", "lamp right", "bulb"}));
  EXPECT_EQ(Package::open(package).layer(0, 0).data, left.data);
  EXPECT_EQ(bake({"--groups", "named"}), Names{}) << "`rest` is the bulb";
  EXPECT_EQ(bake({"--groups", "one"}), (Names{"all-lights"}));
}

TEST_F(Incremental, CoarserEncodingsComeFromWhatIsKept) {
  bake({"--encoding", "f16"});
  const auto fresh = layers();
  EXPECT_EQ(bake({"--encoding", "f16,left=f32"}), Names{"left"}) << "halves do not become floats again";
  EXPECT_EQ(bake({"--encoding", "f16"}), Names{});
  EXPECT_EQ(layers(), fresh);
}

TEST_F(Incremental, DryRunSaysWhatWouldBeSolved) {
  bake();
  scene.lights[0].intensity *= 2.0f;
  write_file(folder / "room.glb", write_glb(scene, "test"));
  const auto before = layers();
  const test::Outcome outcome = test::run_sconce(arguments({"--dry-run"}));
  EXPECT_NE(outcome.out.find("to be solved: bulb; kept: left, right"), std::string::npos) << outcome.out;
  EXPECT_EQ(layers(), before);
}

TEST_F(Incremental, DenoisingSolvesNothingAndKeepsTheRawLayers) {
  bake();
  const auto solved = layers();
  EXPECT_EQ(bake({"--denoise", "on"}), Names{});
  EXPECT_TRUE(layers() != solved);
  const auto kept = [&](const std::string& file) {
    return read_file(package / "raw" / file) == solved.at(file);
  };
  for (const auto& [file, bytes] : solved) EXPECT_TRUE(kept(file)) << file;
  scene.lights[0].intensity *= 2.0f;
  EXPECT_EQ(bake({"--denoise", "on"}), Names{"bulb"});
  EXPECT_TRUE(kept("left.0.exr"));
  EXPECT_FALSE(kept("bulb.0.exr"));
  scene.lights[0].intensity *= 0.5f;
  EXPECT_EQ(bake({"--denoise", "on"}), Names{"bulb"});
  EXPECT_EQ(bake(), Names{});
  EXPECT_TRUE(layers() == solved);
}

TEST_F(Incremental, KilledLeavesTheOldPackageAndResumes) {
  const Names fine{"--samples", "256", "--solver", "path"};
  bake(fine);
  const auto before = layers();
  const std::string manifest = read_file(package / "manifest.json");
  scene.lights[0].intensity *= 2.0f;
  write_file(folder / "room.glb", write_glb(scene, "test"));
  const auto start = [&] {
    Names words = arguments(fine);
    words.insert(words.end(), {"--quiet", "--resume"});
    return test::start_sconce(words);
  };
  const fs::path state = package.string() + ".state";
  const pid_t pid = start();
  // Until some tiles are in the checkpoint.
  for (int i = 0; i < 3000 && (!fs::exists(state) || fs::file_size(state) < 20000); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  ::kill(pid, SIGKILL);
  int status = 0;
  ::waitpid(pid, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status)) << "it was done before it could be killed";
  EXPECT_EQ(layers(), before);
  EXPECT_EQ(read_file(package / "manifest.json"), manifest);

  const test::Outcome merge =
      test::run_sconce({"merge", state.string(), "-o", (folder / "m.sconce").string()});
  EXPECT_EQ(merge.code, 1);
  EXPECT_NE(merge.err.find("only some of the light groups"), std::string::npos) << merge.err;

  ::waitpid(start(), &status, 0);
  ASSERT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  const auto resumed = layers();
  EXPECT_EQ(resumed.at("left.0.exr"), before.at("left.0.exr"));
  EXPECT_NE(resumed.at("bulb.0.exr"), before.at("bulb.0.exr"));
  EXPECT_FALSE(fs::exists(state));
  scene.lights[0].intensity *= 0.5f;
  EXPECT_EQ(bake(fine), Names{"bulb"});
  EXPECT_EQ(layers(), before) << "back to where it began";
}

}  // namespace
}  // namespace sconce
