// SPDX-License-Identifier: Apache-2.0
// An installation in a folder of its own: what is in it, and a project that finds it.
#include <gtest/gtest.h>

#include <regex>

#include "core/files.h"
#include "package/test_package.h"
#include "process.h"

namespace fs = std::filesystem;

namespace sconce {
namespace {

test::Outcome cmake(const std::vector<std::string>& words) {
  test::Outcome outcome = test::run_program(CMAKE, words);
  EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  return outcome;
}

// What the empty window offers lies where it looks, in a build folder as in an installation.
TEST(Install, ABuildFolderHasOurScenes) {
  for (const char* name : {"bathroom.glb", "theatre.glb", "theatre.toml"}) {
    const fs::path file = fs::path(SCONCE_PROGRAM).parent_path() / "scenes" / name;
    ASSERT_TRUE(fs::exists(file)) << file;
    EXPECT_EQ(read_file(file), read_file(fs::path(SCONCE_SOURCE_DIR) / "scenes" / name)) << name;
  }
}

TEST(Install, AProjectFindsIt) {
  const TemporaryFolder folder;
  const fs::path to = folder / "a prefix";
  cmake({"--install", BUILD_FOLDER, "--prefix", to.string()});
  for (const char* file : {"bin/sconce", "include/sconce.h", "share/sconce/scenes/bathroom.glb",
                           "share/sconce/scenes/theatre.glb", "share/sconce/scenes/theatre.toml",
                           "share/sconce/scenes/moods/evening.toml", "share/sconce/sconce_blender.py",
                           "share/doc/sconce/README.md", "share/doc/sconce/docs/cli.md"})
    EXPECT_TRUE(fs::exists(to / file)) << file;
  const test::Outcome version = test::run_program((to / "bin/sconce").string(), {"--version"});
  EXPECT_EQ(version.code, 0) << version.err;

  write_package(folder / "x.sconce", test_package(2, 1, 4, 4));
  const std::string build = (folder / "build").string();
  cmake({"-S", (to / "share/doc/sconce/examples/find_package").string(), "-B", build,
         "-DCMAKE_PREFIX_PATH=" + to.string()});
  cmake({"--build", build});
  const std::string lux = build + "/lux";
  EXPECT_EQ(test::run_program(lux, {(folder / "x.sconce").string()}).out, "3 lux\n");  // 1 + 2
  EXPECT_EQ(test::run_program(lux, {(folder / "x.sconce").string(), "a=off", "b=50%"}).out, "1 lux\n");
  const test::Outcome wrong = test::run_program(lux, {(folder / "y.sconce").string()});
  EXPECT_EQ(wrong.code, 1);
  EXPECT_NE(wrong.err.find("y.sconce"), std::string::npos) << wrong.err;
}

/// Engines that mix bring no ray tracer, no importers and no OpenGL of ours along.
TEST(Install, TheRuntimeIsLean) {
  const test::Outcome libraries = test::run_program("ldd", {RUNTIME_LIBRARY});
  ASSERT_EQ(libraries.code, 0) << libraries.err;
  EXPECT_NE(libraries.out.find("libOpenEXR"), std::string::npos) << libraries.out;
  const std::regex heavy("embree|assimp|draco|meshoptimizer|epoxy|libGL|libEGL|glfw|imgui|mpi",
                         std::regex::icase);
  EXPECT_FALSE(std::regex_search(libraries.out, heavy)) << libraries.out;

  const test::Outcome symbols = test::run_program("nm", {"-D", "--defined-only", RUNTIME_LIBRARY});
  ASSERT_EQ(symbols.code, 0) << symbols.err;
  std::string header = read_file(SCONCE_SOURCE_DIR "/src/runtime/sconce.h");
  int shown = 0;
  for (const std::string& line : split(symbols.out, '\n')) {
    if (line.empty()) continue;
    const std::string name = line.substr(line.rfind(' ') + 1);
    EXPECT_NE(header.find(name + "("), std::string::npos) << name << " is not in sconce.h";
    ++shown;
  }
  const std::regex declared("\nsconce_\\w+\\(|[ *]sconce_\\w+\\(");
  EXPECT_EQ(shown, std::distance(std::sregex_iterator(header.begin(), header.end(), declared), {}));
}

}  // namespace
}  // namespace sconce
