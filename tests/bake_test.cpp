// SPDX-License-Identifier: Apache-2.0
// A bake's bits: whatever the number of threads, shards or kills, the package is the same.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <random>
#include <thread>

#include "bake_job.h"
#include "core/files.h"
#include "core/parallel.h"
#include "process.h"
#include "small_scenes.h"

namespace fs = std::filesystem;

namespace sconce {
namespace {

class Bake : public testing::Test {
 protected:
  fs::path folder = fs::temp_directory_path() / ("sconce_bake_test-" + std::to_string(::getpid()));
  fs::path scene = folder / "room.glb";

  void SetUp() override {
    fs::create_directories(folder);
    write_file(scene, write_glb(test::two_lamp_room(), "test"));
  }
  void TearDown() override { fs::remove_all(folder); }

  app::BakeJob job(int samples = 16) const {
    app::BakeJob job;
    job.scene = scene;
    job.atlas.density = 24;
    job.params.samples = samples;
    return job;
  }
  /// Everything that must agree between two packages of one bake: the bytes of layers, noise, receivers and
  /// scene.
  static std::map<std::string, std::string> bytes(const fs::path& package) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(package))
      if (entry.is_regular_file() && entry.path().filename() != "manifest.json")
        files[fs::relative(entry.path(), package).string()] = read_file(entry.path());
    return files;
  }
  void bake_whole(const fs::path& output, int threads) const {
    const ThreadLimit limit(threads);
    const app::PreparedBake bake(job(), {});
    BakeState state = BakeState::create(output.string() + ".state", bake.header());
    app::run_bake(bake, {}, state, {});
    app::write_result(bake, std::span(&state, 1), output, {}, {});
  }
};

TEST_F(Bake, SameBitsAtAnyThreadCount) {
  bake_whole(folder / "one.sconce", 1);
  bake_whole(folder / "two.sconce", 2);
  const auto one = bytes(folder / "one.sconce");
  EXPECT_GE(one.size(), 5u);
  EXPECT_EQ(one, bytes(folder / "two.sconce"));
}

// Most texels are subnormal halves here, which Embree's threads took for 0.
TEST_F(Bake, DimLampsKeepTheirLayers) {
  Scene dim = test::two_lamp_room();
  for (Material& material : dim.materials) material.emission = material.emission * 0x1p-15f;
  write_file(scene, write_glb(dim, "test"));
  bake_whole(folder / "dim.sconce", 2);
  const Package package = Package::open(folder / "dim.sconce");
  ASSERT_GE(package.manifest().layers.size(), 2u);
  for (const LayerInfo& layer : package.manifest().layers) {
    const GroupInfo& group = package.manifest().groups[layer.group];
    ASSERT_EQ(layer.encoding, "f16");
    ASSERT_LT(group.mean_lux, 0x1p-14) << "no halves without a leading one";
    // Half a step of subnormals against the measure's floor, 1 % of the mean.
    EXPECT_LT(layer.error.relative, 0x1p-25 / (0.01 * group.mean_lux) + 0x1p-11) << group.name;
  }
}

TEST_F(Bake, ThreeShardsMergedAreTheWhole) {
  bake_whole(folder / "whole.sconce", 2);
  std::vector<BakeState> states;
  for (uint32_t i = 0; i < 3; ++i) {
    const app::PreparedBake bake(job(), {});
    states.push_back(BakeState::create(folder / ("s" + std::to_string(i)), bake.header()));
    app::run_bake(bake, {i, 3}, states.back(), {});
  }
  const app::PreparedBake bake(job(), {});
  EXPECT_THROW(app::write_result(bake, std::span(states).first(2), folder / "part.sconce", {}, {}), Error);
  EXPECT_FALSE(fs::exists(folder / "part.sconce"));
  app::write_result(bake, states, folder / "merged.sconce", {}, {});
  EXPECT_EQ(bytes(folder / "whole.sconce"), bytes(folder / "merged.sconce"));
}

TEST_F(Bake, KilledAnywhereAndResumedIsTheWhole) {
  const std::vector<std::string> arguments{"bake", scene.string(), "--density", "24", "--samples",
                                           "256",  "--quiet",      "--threads", "2"};
  const auto start = [&](const fs::path& output, bool resume) {
    std::vector<std::string> words = arguments;
    words.insert(words.end(), {"-o", output.string()});
    if (resume) words.push_back("--resume");
    return test::start_sconce(words);
  };
  const auto finish = [](pid_t pid) {
    int status = 0;
    ::waitpid(pid, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  };
  const auto clock = [] { return std::chrono::steady_clock::now(); };
  const auto begin = clock();
  ASSERT_EQ(finish(start(folder / "whole.sconce", false)), 0);
  const auto whole_time = std::chrono::duration_cast<std::chrono::microseconds>(clock() - begin);

  std::mt19937 random(std::random_device{}());
  int kills = 0;
  for (int round = 0; round < 12; ++round) {
    const pid_t pid = start(folder / "killed.sconce", true);
    std::this_thread::sleep_for(whole_time * std::uniform_real_distribution<double>(0.05, 0.7)(random));
    ::kill(pid, SIGKILL);
    if (finish(pid) == -SIGKILL) ++kills;
    EXPECT_TRUE(!fs::exists(folder / "killed.sconce") ||
                Package::open(folder / "killed.sconce").manifest().pages > 0);
    if (fs::exists(folder / "killed.sconce")) fs::remove_all(folder / "killed.sconce");
  }
  EXPECT_GT(kills, 3);
  ASSERT_EQ(finish(start(folder / "killed.sconce", true)), 0);
  EXPECT_EQ(bytes(folder / "whole.sconce"), bytes(folder / "killed.sconce"));
  EXPECT_FALSE(fs::exists(folder / "killed.sconce.state")) << "the checkpoint goes when the package stands";
}

TEST_F(Bake, TornRecordIsDroppedAndMadeAgain) {
  const app::PreparedBake bake(job(), {});
  const fs::path path = folder / "state";
  {
    BakeState state = BakeState::create(path, bake.header());
    app::run_bake(bake, {}, state, {});
  }
  const auto size = fs::file_size(path);
  fs::resize_file(path, size - 100);
  BakeState state = BakeState::open(path, true);
  EXPECT_EQ(missing_tiles(std::span(&state, 1), bake.job.params).size(), 1u);
  app::run_bake(bake, {}, state, {});
  EXPECT_TRUE(missing_tiles(std::span(&state, 1), bake.job.params).empty());
  EXPECT_EQ(fs::file_size(path), size);
}

TEST_F(Bake, DenoisingKeepsTheRawLayers) {
  const auto bake = [&](const char* name, bool denoise, int threads) {
    const ThreadLimit limit(threads);
    app::BakeJob with = job(32);
    with.denoise = denoise;
    const app::PreparedBake prepared(with, {});
    BakeState state = BakeState::create(folder / "denoise.state", prepared.header());
    app::run_bake(prepared, {}, state, {});
    app::write_result(prepared, std::span(&state, 1), folder / name, {}, {});
    return Package::open(folder / name);
  };
  const Package plain = bake("plain.sconce", false, 2), clean = bake("clean.sconce", true, 2);
  bake("again.sconce", true, 1);
  EXPECT_EQ(bytes(folder / "clean.sconce"), bytes(folder / "again.sconce"));
  for (std::size_t g = 0; g < plain.manifest().groups.size(); ++g) {
    EXPECT_EQ(clean.undenoised().layer(g, 0).data, plain.layer(g, 0).data);
    const GroupInfo &before = plain.manifest().groups[g], &after = clean.manifest().groups[g];
    EXPECT_LT(after.noise, before.noise / 2) << before.name;
    EXPECT_NEAR(after.mean_lux, before.mean_lux, 0.01 * before.mean_lux) << before.name;
  }
}

TEST_F(Bake, GroupsSumToOne) {
  app::BakeJob split = job(), whole = job();
  split.encoding = whole.encoding = "f32";
  whole.grouping = "one";
  for (app::BakeJob* j : {&split, &whole}) {
    const app::PreparedBake bake(*j, {});
    const fs::path output = folder / (j->grouping + ".sconce");
    BakeState state = BakeState::create(output.string() + ".state", bake.header());
    app::run_bake(bake, {}, state, {});
    app::write_result(bake, std::span(&state, 1), output, {}, {});
  }
  const Package parts = Package::open(folder / "auto.sconce"), all = Package::open(folder / "one.sconce");
  ASSERT_EQ(parts.manifest().groups.size(), 2u);
  ASSERT_EQ(all.manifest().groups.size(), 1u);
  const Image a = parts.layer(0, 0), b = parts.layer(1, 0), sum = all.layer(0, 0);
  double worst = 0;
  for (std::size_t i = 0; i < sum.data.size(); ++i)
    worst = std::max(worst, static_cast<double>(std::abs(a.data[i] + b.data[i] - sum.data[i]) /
                                                std::max(1e-3f, sum.data[i])));
  EXPECT_LT(worst, 1e-5);
}

}  // namespace
}  // namespace sconce
