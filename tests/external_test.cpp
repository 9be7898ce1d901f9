// SPDX-License-Identifier: Apache-2.0
// Solver external:CMD with a fake program: what it is given, what comes back, and every way in which it can
// fail.
#include "solve/external.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <nlohmann/json.hpp>
#include <thread>

#include "bake_job.h"
#include "fake_solver.h"
#include "process.h"
#include "small_scenes.h"

namespace fs = std::filesystem;

namespace sconce {
namespace {

using test::fake_value;
using test::Outcome;
using test::run_sconce;

class External : public testing::Test {
 protected:
  TemporaryFolder folder;
  std::string scene = folder.write("room.glb", write_glb(test::two_lamp_room(), "test"));
  fs::path output = folder / "out.sconce", work = folder / "out.sconce.external";

  static std::string command(const std::string& mode) { return std::string("'") + FAKE_SOLVER + "' " + mode; }
  std::vector<std::string> words(const std::string& mode) const {
    return {"bake",      scene, "--solver",   "external:" + command(mode),
            "--atlas",   "64",  "--encoding", "f32",
            "--samples", "5",   "--seed",     "7",
            "--bounces", "3",   "-o",         output.string(),
            "--quiet"};
  }
  Outcome bake(const std::string& mode) const { return run_sconce(words(mode)); }
  fs::path kept(const std::string& name) const { return work / "left" / name; }
};

TEST_F(External, PagesBecomeLayers) {
  const Outcome outcome = bake("good");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_FALSE(fs::exists(work)) << "the work folder goes";
  const Package package = Package::open(output);
  ASSERT_EQ(package.manifest().groups.size(), 2u);
  const Image receivers = package.receivers(0);
  const int weight = receivers.channel("weight");
  std::size_t seen = 0;
  for (std::size_t g = 0; g < 2; ++g) {
    const Image layer = package.layer(g, 0);
    for (int y = 0; y < layer.height; ++y)
      for (int x = 0; x < layer.width; ++x) {
        if (receivers.at(x, y)[weight] == 0) continue;
        const float* pixel = layer.at(x, y);
        const Rgb expected = fake_value(package.manifest().groups[g].name, 0, x, y);
        ASSERT_EQ(Rgb(pixel[0], pixel[1], pixel[2]), expected) << x << ", " << y;
        ++seen;
      }
    EXPECT_EQ(package.manifest().groups[g].noise, 0) << "not known";
  }
  EXPECT_GT(seen, 2000u);
}

TEST_F(External, JobSaysWhatToBake) {
  ASSERT_EQ(bake("keep '" + folder.path().string() + "'").code, 0);
  const Manifest manifest = Package::open(output).manifest();
  for (const std::string group : {"left", "right"}) {
    const auto job = nlohmann::json::parse(read_file(folder / group / "job.json"));
    EXPECT_EQ(job["version"], 1);
    EXPECT_EQ(job["group"], group);
    EXPECT_EQ(job["width"], manifest.width);
    EXPECT_EQ(job["height"], manifest.height);
    EXPECT_EQ(job["pages"], manifest.pages);
    EXPECT_EQ(job["lightmap_set"], manifest.lightmap_set);
    EXPECT_EQ(job["samples"], 5);
    EXPECT_EQ(job["bounces"], 3);
    EXPECT_EQ(job["seed"], 7);
    EXPECT_EQ(job["unit"], "lux");
    EXPECT_EQ(job["outputs"].size(), static_cast<std::size_t>(manifest.pages));
    EXPECT_EQ(job["outputs"][0], (work / group / "page.0.exr").string());
    EXPECT_EQ(job["sky"].size(), 0u);
    ASSERT_EQ(job["instances"].size(), manifest.instance_pages.size());
    for (std::size_t i = 0; i < job["instances"].size(); ++i) {
      EXPECT_EQ(job["instances"][i]["node"], i);
      EXPECT_EQ(job["instances"][i]["page"], manifest.instance_pages[i]);
    }

    const Scene given = read_glb(read_file(folder / group / "scene.glb"), "scene.glb");
    ASSERT_EQ(given.instances.size(), manifest.instance_pages.size()) << "all of the geometry stays";
    int shining = 0, dark = 0;
    for (const Instance& instance : given.instances) {
      const bool lamp = instance.name.starts_with("lamp");
      if (!lamp) continue;
      const bool mine = instance.name == "lamp " + group;
      EXPECT_EQ(given.emits(instance), mine) << instance.name;
      ++(given.emits(instance) ? shining : dark);
    }
    EXPECT_EQ(shining, 1);
    EXPECT_EQ(dark, 1);
  }
}

// A lamp without surface, and a sky, which travels beside the scene.
TEST_F(External, LampsOfOtherGroupsStayAway) {
  Scene room = test::two_lamp_room();
  for (const char* name : {"bulb", "spark"}) {
    Light light;
    light.name = light.group_name = name;
    light.intensity = Rgb(3);
    light.frame[3] = glm::vec4(0, 1, 0, 1);
    room.lights.push_back(light);
  }
  folder.write("room.glb", write_glb(room, "test"));
  folder.write("room.toml", "[sky]\nluminance = 5\n");
  ASSERT_EQ(bake("keep '" + folder.path().string() + "'").code, 0);
  const auto lights = [&](const std::string& group) {
    return read_glb(read_file(folder / group / "scene.glb"), "scene.glb").lights;
  };
  const auto skies = [&](const std::string& group) {
    return nlohmann::json::parse(read_file(folder / group / "job.json"))["sky"];
  };
  ASSERT_EQ(lights("bulb").size(), 1u);
  EXPECT_EQ(lights("bulb")[0].name, "bulb");
  EXPECT_EQ(lights("left").size(), 0u);
  EXPECT_EQ(skies("bulb").size(), 0u);
  ASSERT_EQ(skies("sky").size(), 1u);
  EXPECT_TRUE(skies("sky")[0]["image"].is_null());
  EXPECT_GT(skies("sky")[0]["radiance"][1], 1);
}

struct Failure {
  const char *mode, *says, *file;
};
void PrintTo(const Failure& failure, std::ostream* out) {
  *out << failure.mode;
}
class ExternalFails : public External, public testing::WithParamInterface<Failure> {};
INSTANTIATE_TEST_SUITE_P(
    Modes, ExternalFails,
    testing::Values(Failure{"fail", "ended with exit code 3: second / third / last words", "job.json"},
                    Failure{"abort", "ended with signal 6", "scene.glb"},
                    Failure{"nothing", "page.0.exr: was not written", "job.json"},
                    Failure{"size", "page.0.exr: is 32 x 64", "page.0.exr"},
                    Failure{"nan", "page.0.exr: holds nan at texel (", "page.0.exr"},
                    Failure{"negative", "page.0.exr: holds -1 at texel (", "page.0.exr"},
                    Failure{"black", "page.0.exr: is black, though", "page.0.exr"},
                    Failure{"channels", "page.0.exr: lacks a channel", "page.0.exr"},
                    Failure{"unit", "page.0.exr: is in 'cd/m2'", "page.0.exr"},
                    Failure{"garbage", "page.0.exr", "page.0.exr"}),
    [](const auto& failure) { return std::string(failure.param.mode); });

TEST_P(ExternalFails, WithOneLineAndItsFilesKept) {
  const Outcome outcome = bake(GetParam().mode);
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  for (const std::string part : {"group 'left'", "fake_solver", GetParam().says, "last words", "kept in "})
    EXPECT_NE(outcome.err.find(part), std::string::npos) << part << "\n" << outcome.err;
  EXPECT_NE(outcome.err.find(fs::canonical(work / "left").string()), std::string::npos) << outcome.err;
  EXPECT_TRUE(fs::exists(kept(GetParam().file)));
  EXPECT_FALSE(fs::exists(output));
  EXPECT_EQ(bake("good").code, 0) << "what was kept does not stand in the way";
}

TEST_F(External, AProgramThatCannotBeStartedLeavesNothing) {
  const Outcome outcome = run_sconce(
      {"bake", scene, "--solver", "external:no-such-program --fast", "--atlas", "64", "-o", output.string()});
  EXPECT_EQ(outcome.code, 1);
  for (const char* part : {"group 'left'", "no-such-program --fast", "No such file"})
    EXPECT_NE(outcome.err.find(part), std::string::npos) << part << "\n" << outcome.err;
  EXPECT_FALSE(fs::exists(work));
}

TEST_F(External, WrongUsage) {
  const auto says = [&](const std::string& solver, std::vector<std::string> more, const std::string& part) {
    more.insert(more.begin(), {"bake", scene, "--solver", solver, "-o", output.string()});
    const Outcome outcome = run_sconce(more);
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_NE(outcome.err.find(part), std::string::npos) << part << "\n" << outcome.err;
  };
  says("external", {}, "names no program");
  says("external:", {}, "names no program");
  says("external:'a", {}, "has no closing '");
  says("externals:a", {}, "external:CMD");
  says("path:a", {}, "unknown solver 'path:a'");
  says("external:true", {"--noise", "2%"}, "--noise");
  says("external:true", {"--shard", "0/2"}, "--shard");
}

TEST_F(External, NeedsAnAtlas) {
  Scene room = test::two_lamp_room();
  assign_groups(room, Grouping::automatic);
  const World world = make_world(room);
  const Tracer tracer(room, world);
  const Lamps lamps(room, world);
  BakeParams params;
  params.command = command("good");
  params.work_folder = work;
  try {
    find_solver("external:x").prepare({room, world, tracer, lamps}, params, {});
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("needs a lightmap atlas"), std::string::npos) << error.what();
  }
  EXPECT_FALSE(fs::exists(work));
}

TEST_F(External, ControlCEndsTheProgram) {
  const pid_t pid = test::start_sconce(words("hang '" + folder.path().string() + "'"));
  for (int i = 0; i < 1000 && !fs::exists(folder / "started"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  ASSERT_TRUE(fs::exists(folder / "started"));
  const std::string children =
      read_file("/proc/" + std::to_string(pid) + "/task/" + std::to_string(pid) + "/children");
  const pid_t child = std::stoi(children);
  ::kill(pid, SIGINT);
  int status = 0;
  ::waitpid(pid, &status, 0);
  EXPECT_FALSE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  EXPECT_FALSE(fs::exists("/proc/" + std::to_string(child)));
  EXPECT_FALSE(fs::exists(work)) << "nothing of a stopped bake is worth keeping";
  EXPECT_FALSE(fs::exists(output));
}

}  // namespace
}  // namespace sconce
