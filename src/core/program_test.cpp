// SPDX-License-Identifier: Apache-2.0
#include "core/program.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <thread>

#include "core/files.h"

namespace fs = std::filesystem;

namespace sconce {
namespace {

using Words = std::vector<std::string>;

TEST(Program, WordsEndAtBlanksOutsideQuotes) {
  EXPECT_EQ(command_words("blender  -b\t-P x.py "), (Words{"blender", "-b", "-P", "x.py"}));
  EXPECT_EQ(command_words("a 'b \"c\\' d\"e f\"\\ g"), (Words{"a", "b \"c\\", "de f g"}));
  EXPECT_EQ(command_words("a '' $HOME;ls|b"), (Words{"a", "", "$HOME;ls|b"})) << "there is no shell";
  for (const char* wrong : {"", "  ", "'a", "a \"b", "''"})
    EXPECT_THROW(command_words(wrong), UsageError) << wrong;
}

class Programs : public testing::Test {
 protected:
  fs::path folder = fs::temp_directory_path() / ("sconce program " + std::to_string(::getpid()));
  fs::path out = folder / "out", err = folder / "err";

  void SetUp() override { fs::create_directories(folder); }
  void TearDown() override { fs::remove_all(folder); }
  int run(const Words& words, const Progress& progress = {}) const {
    return run_program(words, out, err, progress);
  }
};

TEST_F(Programs, APathWithBlanksIsOneWord) {
  const fs::path file = folder / "it's a file";
  write_file(file, "");
  EXPECT_EQ(command_words(file.string()), Words{file.string()});
}

TEST_F(Programs, ExitCodesSignalsAndOutput) {
  EXPECT_EQ(run({"sh", "-c", "echo \"$1\"; echo two >&2; exit 3", "sh", "one; $HOME"}), 3);
  EXPECT_EQ(read_file(out), "one; $HOME\n");
  EXPECT_EQ(read_file(err), "two\n");
  EXPECT_EQ(run({"true"}), 0);
  EXPECT_EQ(run({"sh", "-c", "kill -9 $$"}), 128 + 9);
}

TEST_F(Programs, WhatCannotBeStartedIsAnErrorThatNamesIt) {
  try {
    run({"no-such-program-anywhere"});
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("no-such-program-anywhere"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("No such file"), std::string::npos) << error.what();
  }
}

// The program's own children end too, even those that ignore SIGTERM.
TEST_F(Programs, AStopEndsTheWholeGroup) {
  std::stop_source stop;
  Progress progress;
  progress.stop = stop.get_token();
  const fs::path pid = folder / "pid";
  std::thread watcher([&] {
    while (!fs::exists(pid) || read_file(pid).empty())
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    stop.request_stop();
  });
  EXPECT_THROW(run({"sh", "-c", "trap '' TERM; sleep 1000 & echo $! > \"$0\"; wait", pid.string()}, progress),
               Cancelled);
  watcher.join();
  const fs::path process = fs::path("/proc") / read_file(pid).substr(0, read_file(pid).find('\n'));
  for (int i = 0; i < 200 && fs::exists(process); ++i) {
    const std::string status = read_file(process / "status");
    if (status.find("State:\tZ") != std::string::npos) break;  // dead, and nobody has asked for its status
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  if (fs::exists(process)) {
    EXPECT_NE(read_file(process / "status").find("State:\tZ"), std::string::npos);
  }
}

}  // namespace
}  // namespace sconce
