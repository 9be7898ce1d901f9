// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <fstream>

#include "core/error.h"
#include "core/files.h"
#include "core/parallel.h"
#include "core/receiver.h"
#include "core/text.h"

namespace fs = std::filesystem;

namespace sconce {
namespace {

TEST(Text, NumbersAreWholeAndIgnoreTheLocale) {
  EXPECT_EQ(parse_number("+1.5"), 1.5);
  EXPECT_EQ(parse_number("-2e3"), -2000);
  for (const char* wrong : {"", "1,5", "1.5x", " 1", "+", "nan", "-inf", "1e999"})
    EXPECT_FALSE(parse_number(wrong)) << wrong;
}

TEST(Text, Globs) {
  EXPECT_TRUE(glob_match("ceil*", "ceiling"));
  EXPECT_TRUE(glob_match("*", ""));
  EXPECT_TRUE(glob_match("a?c*e", "abcde"));
  EXPECT_FALSE(glob_match("ceil", "ceiling"));
  EXPECT_FALSE(glob_match("?", ""));
}

TEST(Text, NearestNameIsWithinAThird) {
  const std::vector<std::string> names{"ceiling", "mirror", "window"};
  EXPECT_EQ(nearest_name("cieling", names), "ceiling");
  EXPECT_EQ(nearest_name("Windows", names), "window");
  EXPECT_EQ(nearest_name("lamp", names), std::nullopt);
}

TEST(Text, FileNamesAreSafeAndApart) {
  EXPECT_EQ(safe_file_name("ceiling-1"), "ceiling-1");
  EXPECT_NE(safe_file_name("a/b"), safe_file_name("a.b"));
  EXPECT_EQ(safe_file_name("../x").find('/'), std::string::npos);
  EXPECT_FALSE(safe_file_name("").empty());
}

TEST(Errors, AreOneLineWithPlaceAndChoices) {
  EXPECT_STREQ(Error("a.toml:3", "unknown key 'x'", "y, z").what(),
               "a.toml:3: unknown key 'x' (allowed: y, z)");
}

TEST(Parallel, CallsEachIndexOnceAndRethrows) {
  std::vector<std::atomic<int>> calls(1000);
  parallel_for(calls.size(), 7, [&](std::size_t i) { ++calls[i]; });
  for (const auto& c : calls) EXPECT_EQ(c, 1);
  EXPECT_THROW(parallel_for(10, 1,
                            [](std::size_t i) {
                              if (i == 3) throw Error("x", "y");
                            }),
               Error);
}

TEST(Files, WritingReplacesWholeOrNotAtAll) {
  const fs::path folder = fs::temp_directory_path() / "sconce_core_test";
  fs::remove_all(folder);
  fs::create_directories(folder);
  const fs::path file = folder / "a.txt";
  write_file(file, "one");
  write_file(file, "two");
  EXPECT_EQ(read_file(file), "two");
  {
    const Beside abandoned(file);
    std::ofstream(abandoned.path()) << "half";
  }
  EXPECT_EQ(read_file(file), "two");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1);
  EXPECT_THROW(write_file(folder / "no" / "where.txt", "x"), Error);

  const fs::path package = folder / "p";
  fs::create_directories(package / "old");
  Beside beside(package);
  fs::create_directories(beside.path() / "new");
  beside.commit();
  EXPECT_TRUE(fs::exists(package / "new"));
  EXPECT_FALSE(fs::exists(package / "old"));
  fs::remove_all(folder);
}

TEST(Footprint, SamplesPiecesByArea) {
  FootprintPiece small, large;
  const Vec3 up(0, 0, 1);
  small.n0 = small.n1 = small.n2 = small.geometric_normal = up;
  large = small;
  small.p0 = Vec3(0), small.p1 = Vec3(1, 0, 0), small.p2 = Vec3(0, 1, 0);
  large.p0 = Vec3(10, 0, 0), large.p1 = Vec3(12, 0, 0), large.p2 = Vec3(10, 3, 0);
  small.cumulative = 0.5f / 3.5f, large.cumulative = 1;
  const Footprint footprint{ReceiverKind::texel, 0, {small, large}, 3.5f};
  int in_small = 0;
  Vec3 mean(0);
  const int n = 64;
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const Vec3 p = footprint.sample((Vec2(x, y) + 0.5f) / static_cast<float>(n)).position;
      in_small += p.x < 5;
      mean += p / static_cast<float>(n * n);
    }
  EXPECT_NEAR(in_small / static_cast<double>(n * n), 1 / 7.0, 0.01);
  // Centroid: (1/7)(1/3, 1/3) + (6/7)(10 2/3, 1).
  EXPECT_NEAR(mean.x, (1 / 3.0 + 6 * (10 + 2 / 3.0)) / 7, 0.1);
  EXPECT_NEAR(mean.y, (1 / 3.0 + 6) / 7, 0.02);
}

TEST(Text, AShellReadsWordsBack) {
  EXPECT_EQ(shell_word("out/a-b_1.png"), "out/a-b_1.png");
  EXPECT_EQ(shell_word("two words"), "'two words'");
  EXPECT_EQ(shell_word("it's"), "'it'\\''s'");
  EXPECT_EQ(shell_word(""), "''");
}

}  // namespace
}  // namespace sconce
