// SPDX-License-Identifier: Apache-2.0
// One bake on several processes: the same bits, one voice, and what a dead one leaves behind.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <map>
#include <thread>

#include "core/test_data.h"
#include "process.h"
#include "small_scenes.h"

namespace fs = std::filesystem;

namespace sconce {
namespace {

using Words = std::vector<std::string>;

class Mpi : public testing::Test {
 protected:
  TemporaryFolder folder;
  std::string scene;

  void SetUp() override {
    if (!SCONCE_HAS_MPI || std::system("command -v mpirun >/dev/null") != 0) {
      if (test_data_required()) FAIL() << "no MPI here: libopenmpi-dev, openmpi-bin";
      GTEST_SKIP() << "no MPI here: libopenmpi-dev, openmpi-bin";
    }
    ::setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
    ::setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
    scene = folder.write("room.glb", write_glb(test::two_lamp_room(), "test"));
  }
  std::string mpirun(int ranks) const {
    return "mpirun --oversubscribe --bind-to none -n " + std::to_string(ranks);
  }
  Words bake(const std::string& output, const Words& more = {}) const {
    Words words{"bake", scene,       "-o", (folder / output).string(), "--density", "20", "--samples",
                "16",   "--threads", "1"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  std::map<std::string, std::string> bytes(const std::string& package) const {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder / package))
      if (entry.is_regular_file() && entry.path().filename() != "manifest.json")
        files[fs::relative(entry.path(), folder / package).string()] = read_file(entry.path());
    return files;
  }
};

/// Processes of a rank of this output, by their command line and environment.
std::vector<pid_t> processes(const std::string& output, const std::string& variable) {
  std::vector<pid_t> found;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    const std::string name = entry.path().filename().string();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    const auto text = [&](const char* file) {
      std::ifstream in(entry.path() / file, std::ios::binary);
      return std::string(std::istreambuf_iterator<char>(in), {});
    };
    const std::string environment = '\0' + text("environ"), command = text("cmdline");
    if (command.starts_with(SCONCE_PROGRAM) && command.find(output) != std::string::npos &&
        environment.find('\0' + variable + '\0') != std::string::npos)
      found.push_back(std::stoi(name));
  }
  return found;
}

TEST_F(Mpi, AnyNumberOfRanksGivesTheSameBits) {
  for (const std::string solver : {"radiosity", "path"}) {
    ASSERT_EQ(test::run_sconce(bake("one-" + solver, {"--solver", solver})).code, 0);
    const auto one = bytes("one-" + solver);
    ASSERT_GE(one.size(), 5u);
    for (const int ranks : {2, 3}) {
      const std::string output = solver + std::to_string(ranks);
      const test::Outcome outcome = test::run_sconce(bake(output, {"--solver", solver}), mpirun(ranks));
      ASSERT_EQ(outcome.code, 0) << outcome.err;
      EXPECT_EQ(bytes(output), one) << output;
      EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 4) << "said once: " << outcome.out;
      EXPECT_FALSE(fs::exists(folder / (output + ".state")));
      EXPECT_FALSE(fs::exists(folder / (output + ".state.1")));
    }
  }
}

// An operator, and what is left of one by another number of ranks.
TEST_F(Mpi, TransferGivesTheSameBitsAndGoesOn) {
  ASSERT_EQ(test::run_sconce(bake("room.sconce", {"--solver", "path"})).code, 0);
  const fs::path op = folder / "room.sconce" / "operators" / "lightmap.bin";
  const Words transfer{"transfer",  (folder / "room.sconce").string(),
                       "--gather",  "1024",
                       "--rays",    "64",
                       "--lights",  "32",
                       "--threads", "1"};
  ASSERT_EQ(test::run_sconce(transfer).code, 0);
  const std::string one = read_file(op);
  for (const int ranks : {2, 3}) {
    fs::remove(op);
    const test::Outcome outcome = test::run_sconce(transfer, mpirun(ranks));
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 2) << "said once: " << outcome.out;
    EXPECT_TRUE(read_file(op) == one) << ranks;
  }
  Words on = transfer;
  on.emplace_back("--resume");
  fs::remove(op);
  fs::create_directory(op);  // so that the end cannot be written: the rows stay in the states
  const test::Outcome stopped = test::run_sconce(transfer, mpirun(2));
  EXPECT_EQ(stopped.code, 1);
  EXPECT_NE(stopped.err.find("lightmap.bin"), std::string::npos) << stopped.err;
  fs::remove(op);
  const fs::path state = fs::path(op) += ".state", second = fs::path(op) += ".state.1";
  ASSERT_TRUE(fs::exists(state));
  ASSERT_TRUE(fs::exists(second));
  fs::resize_file(second, fs::file_size(second) - 100);
  ASSERT_EQ(test::run_sconce(on, mpirun(3)).code, 0);
  constexpr std::size_t kHead = 512;  // names the options, --resume among them
  EXPECT_TRUE(read_file(op).substr(kHead) == one.substr(kHead));
  EXPECT_FALSE(fs::exists(state));
  EXPECT_FALSE(fs::exists(second));
  // What cannot be is said once, and before anything is written.
  Words odd = transfer;
  odd[3] = "1000";
  const test::Outcome refused = test::run_sconce(odd, mpirun(2));
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("a power of four"), std::string::npos) << refused.err;
  EXPECT_FALSE(fs::exists(state));
}

TEST_F(Mpi, ChangedLampIsSolvedAlone) {
  ASSERT_EQ(test::run_sconce(bake("room"), mpirun(2)).code, 0);
  const auto before = bytes("room");
  Scene changed = test::two_lamp_room();
  for (Material& material : changed.materials)
    if (material.name == "cool") material.emission *= 2.0f;
  write_file(scene, write_glb(changed, "test"));
  const test::Outcome outcome = test::run_sconce(bake("room"), mpirun(2));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto after = bytes("room");
  EXPECT_EQ(after.at("layers/left.0.exr"), before.at("layers/left.0.exr"));
  EXPECT_NE(after.at("layers/right.0.exr"), before.at("layers/right.0.exr"));
  ASSERT_EQ(test::run_sconce(bake("alone")).code, 0);
  EXPECT_EQ(after.at("layers/right.0.exr"), bytes("alone").at("layers/right.0.exr"));
}

TEST_F(Mpi, ErrorsAreSaidOnce) {
  const test::Outcome outcome = test::run_sconce(bake("x", {"--solver", "magic"}), mpirun(3));
  EXPECT_EQ(outcome.code, 2);
  const std::string line = "sconce bake: --solver: unknown solver 'magic'";
  const std::size_t at = outcome.err.find(line);
  ASSERT_NE(at, std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find(line, at + 1), std::string::npos) << outcome.err;
}

TEST_F(Mpi, RankThatSeesAnotherSceneOrNoneIsNamed) {
  Scene changed = test::two_lamp_room();
  changed.materials.front().base_color *= 0.5f;
  const std::string other = folder.write("other.glb", write_glb(changed, "test")),
                    broken = folder.write("broken.glb", "glTF");
  for (const auto& [second, line] :
       {std::pair(other, std::string("rank 1: sees another scene")), {broken, "rank 1: " + broken}}) {
    Words words = bake("x");
    words[1] = second;
    std::string prefix = mpirun(1) + " " SCONCE_PROGRAM;
    for (const std::string& word : bake("x")) prefix += " " + word;
    const test::Outcome outcome = test::run_sconce(words, prefix + " : -n 1");
    EXPECT_NE(outcome.code, 0);
    EXPECT_NE(outcome.err.find("sconce bake: " + line), std::string::npos) << outcome.err;
    EXPECT_FALSE(fs::exists(folder / "x"));
  }
}

TEST_F(Mpi, DeadRankEndsTheJobAndAnotherNumberOfRanksResumes) {
  const Words fine{"--samples", "512", "--solver", "path", "--resume"};
  const auto run = [&](const std::string& output, const std::string& prefix) {
    Words words = bake(output);
    words.erase(std::find(words.begin(), words.end(), "--samples"),
                std::find(words.begin(), words.end(), "--threads"));
    words.insert(words.end(), fine.begin(), fine.end());
    return test::run_sconce(words, prefix);
  };
  test::Outcome outcome;
  std::thread job([&] { outcome = run("killed", mpirun(2)); });
  const auto size = [&](const char* name) {
    std::error_code ec;
    const auto bytes = fs::file_size(folder / name, ec);
    return ec ? 0 : bytes;
  };
  for (int i = 0; i < 6000 && (size("killed.state") < 20000 || size("killed.state.1") < 20000); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  const std::vector<pid_t> second = processes((folder / "killed").string(), "OMPI_COMM_WORLD_RANK=1");
  for (const pid_t pid : second) ::kill(pid, SIGKILL);
  job.join();
  ASSERT_EQ(second.size(), 1u);
  EXPECT_NE(outcome.code, 0);
  EXPECT_NE(outcome.err.find("signal 9"), std::string::npos) << outcome.err;
  EXPECT_FALSE(fs::exists(folder / "killed"));
  ASSERT_GE(size("killed.state"), 20000u);
  ASSERT_GE(size("killed.state.1"), 20000u);

  fs::copy(folder / "killed.state", folder / "alone.state");
  fs::copy(folder / "killed.state.1", folder / "alone.state.1");
  ASSERT_EQ(run("whole", "").code, 0);
  outcome = run("killed", mpirun(3));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(bytes("killed"), bytes("whole"));
  ASSERT_EQ(run("alone", "").code, 0);
  EXPECT_EQ(bytes("alone"), bytes("whole"));
  for (const char* name :
       {"killed.state", "killed.state.1", "killed.state.2", "alone.state", "alone.state.1"})
    EXPECT_FALSE(fs::exists(folder / name)) << name;
}

}  // namespace
}  // namespace sconce
