// SPDX-License-Identifier: Apache-2.0
// What `export` and `serve` say before there is any page.
#include <gtest/gtest.h>

#include <algorithm>

#include "package/test_package.h"
#include "process.h"

namespace fs = std::filesystem;

namespace sconce {
namespace {

void expect_refused(const test::Outcome& outcome, int code, const std::string& word) {
  EXPECT_EQ(outcome.code, code) << outcome.err;
  EXPECT_NE(outcome.err.find(word), std::string::npos) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
}

// A program without the page beside it, as a build without npm leaves it.
TEST(Export, SaysThatThePageIsNotBuilt) {
  const TemporaryFolder folder;
  fs::copy_file(SCONCE_PROGRAM, folder / "sconce");
  write_package(folder / "x.sconce", test_package(1, 1, 8, 8));
  const std::string package = (folder / "x.sconce").string(), site = (folder / "site").string();
  const std::string program = (folder / "sconce").string();
  expect_refused(test::run_program(program, {"export", package, "--web", site, "--quiet"}), 1, "make web");
  EXPECT_FALSE(fs::exists(site));
  expect_refused(test::run_program(program, {"serve", package, "--port", "0", "--quiet"}), 1, "make web");
}

TEST(Export, RefusesWhatItDoesNotKnow) {
  expect_refused(test::run_sconce({"export", "x.sconce"}), 2, "--web DIR");
  expect_refused(test::run_sconce({"export", "x.sconce", "--web", "d", "--tiers", "best"}), 2, "unfiltered");
  expect_refused(test::run_sconce({"export", "x.sconce", "--web", "d", "--encoding", "mp3"}), 2, "exp8");
  expect_refused(test::run_sconce({"serve", "x.sconce", "--port", "70000"}), 2, "65535");
}

// Folders that hold something else are not replaced.
TEST(Export, LeavesOtherFoldersAlone) {
  const TemporaryFolder folder;
  folder.write("thesis.txt", "mine");
  expect_refused(test::run_sconce({"export", "x.sconce", "--web", folder.path().string(), "--quiet"}), 1,
                 "something else");
  EXPECT_EQ(read_file(folder / "thesis.txt"), "mine");
}

}  // namespace
}  // namespace sconce
