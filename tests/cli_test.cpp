// SPDX-License-Identifier: Apache-2.0
// The program as a process: exit codes, one clear line per error, nothing half-written.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>

#include "process.h"

using namespace sconce;
using test::Outcome;
using test::run_sconce;
namespace fs = std::filesystem;

namespace {

const std::vector<std::string> kVerbs = {"info", "bake", "merge", "mix", "render", "diff"};

/// A floor of 4 x 4 m, a lamp of 1 x 1 m and another of the same size at 2 m, each a group of its own.
constexpr const char* kRoomObj =
    "mtllib room.mtl\n"
    "v -2 0 2\nv 2 0 2\nv 2 0 -2\nv -2 0 -2\n"
    "v -1.5 2 -0.5\nv -0.5 2 -0.5\nv -0.5 2 0.5\nv -1.5 2 0.5\n"
    "v 0.5 2 -0.5\nv 1.5 2 -0.5\nv 1.5 2 0.5\nv 0.5 2 0.5\n"
    "o floor\nusemtl floor\nf 1 2 3 4\n"
    "o left\nusemtl left\nf 5 6 7 8\n"
    "o right\nusemtl right\nf 9 10 11 12\n";
constexpr const char* kRoomMtl =
    "newmtl floor\nKd 0.5 0.5 0.5\n"
    "newmtl left\nKd 0 0 0\nKe 100 100 100\n"
    "newmtl right\nKd 0 0 0\nKe 50 20 10\n";

std::string write_room(const TemporaryFolder& folder) {
  folder.write("room.mtl", kRoomMtl);
  return folder.write("room.obj", kRoomObj);
}

/// The room baked once for all tests of a process.
class Baked : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    const Outcome bake =
        run_sconce({"bake", write_room(*folder_), "--atlas", "64", "--samples", "8", "--bounces", "1"});
    ASSERT_EQ(bake.code, 0) << bake.err;
  }
  static void TearDownTestSuite() {
    delete folder_;
    folder_ = nullptr;
  }
  static std::string package() { return (*folder_ / "room.sconce").string(); }
  static std::string path(const std::string& name) { return (*folder_ / name).string(); }
  /// A copy that a test may damage.
  static std::string copy_to(const TemporaryFolder& folder) {
    fs::copy(package(), folder / "copy.sconce", fs::copy_options::recursive);
    return (folder / "copy.sconce").string();
  }

 private:
  static TemporaryFolder* folder_;
};
TemporaryFolder* Baked::folder_ = nullptr;

/// One line on standard error that names the verb, nothing on standard output.
void expect_error(const Outcome& outcome, int code, const std::string& verb,
                  const std::vector<std::string>& parts) {
  EXPECT_EQ(outcome.code, code) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_TRUE(outcome.err.starts_with("sconce " + verb + ": ") || verb.empty()) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  for (const std::string& part : parts)
    EXPECT_NE(outcome.err.find(part), std::string::npos) << part << "\n" << outcome.err;
}

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

TEST(Cli, SeveralProcessesWithoutMpiAreOneClearLine) {
  if (SCONCE_HAS_MPI) GTEST_SKIP() << "this build has MPI";
  const Outcome outcome = run_sconce({"bake", "any.glb"}, "OMPI_COMM_WORLD_SIZE=2 OMPI_COMM_WORLD_RANK=0");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_NE(outcome.err.find("built without MPI"), std::string::npos) << outcome.err;
}

}  // namespace

TEST(Cli, HelpAndVersion) {
  const Outcome help = run_sconce({"--help"});
  EXPECT_EQ(help.code, 0);
  for (const std::string& verb : kVerbs) {
    EXPECT_NE(help.out.find("  " + verb), std::string::npos) << verb;
    const Outcome one = run_sconce({verb, "--help"});
    EXPECT_EQ(one.code, 0) << one.err;
    EXPECT_TRUE(one.out.starts_with("usage: sconce " + verb)) << one.out;
    EXPECT_EQ(one.err, "");
    for (const char* common : {"--json", "--quiet", "--threads", "--config", "--help"}) {
      EXPECT_NE(one.out.find(common), std::string::npos) << verb << " " << common;
    }
  }
  const std::string version = run_sconce({"--version"}).out;
  EXPECT_TRUE(version.starts_with("sconce " SCONCE_VERSION "\n")) << version;
  for (const char* part : {"radiosity", "bc6h", "agx", ".glb", "x86-64", "Embree"})
    EXPECT_NE(version.find(part), std::string::npos) << part << "\n" << version;
}

TEST(Cli, AloneSaysWhatItIsAndHowToBegin) {
  const Outcome alone = run_sconce({});
  EXPECT_EQ(alone.code, 2);
  EXPECT_EQ(alone.out, "");
  const std::size_t gap = alone.err.find("\n\n");
  ASSERT_NE(gap, std::string::npos);
  EXPECT_EQ(std::count(alone.err.begin(), alone.err.begin() + static_cast<std::ptrdiff_t>(gap) + 1, '\n'), 5);
  EXPECT_EQ(std::count(alone.err.begin() + static_cast<std::ptrdiff_t>(gap) + 2, alone.err.end(), '\n'), 3);
}

TEST(Cli, ReferenceIsWhatHelpSays) {
  EXPECT_EQ(read_file(fs::path(SCONCE_SOURCE_DIR) / "docs/cli.md"), run_sconce({"help", "--markdown"}).out)
      << "`make docs` writes it";
}

/// Every verb ends its help with two examples and a next step, of verbs and options that there are.
TEST(Cli, ExamplesAreOfOptionsThatThereAre) {
  std::map<std::string, std::string> helps;  // by "sconce VERB", "sconce luminaire ACTION"
  std::istringstream reference(read_file(fs::path(SCONCE_SOURCE_DIR) / "docs/cli.md"));
  std::string line, verb;
  while (std::getline(reference, line)) {
    if (line.starts_with("## ") || line.starts_with("### "))
      verb = "sconce " + line.substr(line.find(' ') + 1);
    else if (!verb.empty())
      helps[verb] += line + "\n";
  }
  const std::regex example("(?:  |next: )(sconce .*)"), option(" (--?[a-z][a-z0-9-]*)");
  for (const auto& [name, help] : helps) {
    if (name == "sconce luminaire") continue;
    int examples = 0;
    std::istringstream lines(help);
    while (std::getline(lines, line)) {
      std::smatch match;
      if (!std::regex_match(line, match, example)) continue;
      ++examples;
      const std::string command = match[1];
      std::string known;
      for (const auto& [other, text] : helps)
        if (command.starts_with(other + " ")) known = text;  // the longest name comes last
      ASSERT_FALSE(known.empty()) << command;
      for (std::sregex_iterator i(command.begin(), command.end(), option), end; i != end; ++i)
        EXPECT_TRUE(std::regex_search(known, std::regex("  (-., )?" + (*i)[1].str() + "[ ,\n]"))) << command;
    }
    EXPECT_GE(examples, 2) << name;
    EXPECT_NE(help.find("\nnext: "), std::string::npos) << name;
  }
}

TEST(Cli, ColourOnlyOnTerminalsThatWantIt) {
  const auto on_terminal = [](const std::string& variable) {
    const std::string command = variable + " " + shell_word(SCONCE_PROGRAM) + " rendr";
    return test::run_program("script", {"-qec", command, "/dev/null"}).out;
  };
  EXPECT_NE(on_terminal("TERM=xterm").find("\033[1;31m"), std::string::npos);
  const std::string plain = on_terminal("TERM=xterm NO_COLOR=1");
  EXPECT_NE(plain.find("unknown verb"), std::string::npos) << plain;
  EXPECT_EQ(plain.find('\033'), std::string::npos) << plain;
  EXPECT_EQ(run_sconce({"rendr"}).err.find('\033'), std::string::npos);
}

TEST(Cli, UsageErrorsExitWithTwo) {
  expect_error(run_sconce({"rendr"}), 2, "", {"unknown verb 'rendr'", "did you mean 'render'?"});
  expect_error(run_sconce({"--quite"}), 2, "", {"unknown option '--quite'"});
  for (const std::string& verb : kVerbs) {
    const auto run = [&](std::vector<std::string> args) {
      args.insert(args.begin(), {verb, "x"});
      if (verb == "diff") args.insert(args.begin() + 2, "y");
      return run_sconce(args);
    };
    expect_error(run_sconce({verb}), 2, verb, {"missing argument"});
    expect_error(run({"--thraeds", "2"}), 2, verb, {"unknown option '--thraeds'", "'--threads'"});
    expect_error(run({"--threads", "many"}), 2, verb, {"--threads", "whole number", "'many'"});
    expect_error(run({"--config", "/nonexistent.toml"}), 2, verb, {"/nonexistent.toml: no such file"});
  }
}

TEST(Cli, MissingInputsExitWithOne) {
  expect_error(run_sconce({"info", "/nonexistent.glb"}), 1, "info", {"/nonexistent.glb", "no such file"});
  expect_error(run_sconce({"bake", "/nonexistent.glb"}), 1, "bake", {"/nonexistent.glb", "no such file"});
  expect_error(run_sconce({"mix", "/nonexistent.sconce", "-o", "/tmp/x.exr"}), 1, "mix",
               {"/nonexistent.sconce"});
  expect_error(run_sconce({"render", "/nonexistent.sconce"}), 1, "render", {"/nonexistent.sconce"});
  expect_error(run_sconce({"diff", "/nonexistent.exr", "/nonexistent.exr"}), 1, "diff", {"/nonexistent.exr"});
  const TemporaryFolder folder;
  expect_error(run_sconce({"info", folder.write("x.txt", "hello\n")}), 1, "info", {"x.txt", "glTF"});
  expect_error(run_sconce({"info", folder.path().string()}), 1, "info", {"no sconce package"});
}

TEST(Cli, SceneWithoutGeometry) {
  const TemporaryFolder folder;
  const std::string scene = folder.write(
      "lamp.gltf",
      R"({"asset":{"version":"2.0"},"extensionsUsed":["KHR_lights_punctual"],"scene":0,"scenes":[{"nodes":[0]}],)"
      R"("nodes":[{"name":"lamp","extensions":{"KHR_lights_punctual":{"light":0}}}],)"
      R"("extensions":{"KHR_lights_punctual":{"lights":[{"type":"point","intensity":10}]}}})");
  const Outcome info = run_sconce({"info", scene});
  EXPECT_EQ(info.code, 0);
  EXPECT_NE(info.out.find("0 triangles"), std::string::npos) << info.out;
  EXPECT_NE(info.err.find("lamp.gltf: the scene has no triangles"), std::string::npos) << info.err;
  expect_error(run_sconce({"bake", scene}), 1, "bake", {"lamp", "no triangles"});
  EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{"lamp.gltf"});
}

TEST(Cli, SceneInfo) {
  const TemporaryFolder folder;
  const std::string scene = write_room(folder);
  const Outcome text = run_sconce({"info", scene});
  EXPECT_EQ(text.code, 0) << text.err;
  for (const char* part : {"6 triangles", "light groups  2", "left", "right"}) {
    EXPECT_NE(text.out.find(part), std::string::npos) << part << "\n" << text.out;
  }
  const Outcome json = run_sconce({"info", scene, "--json", "--groups", "one"});
  EXPECT_EQ(json.code, 0) << json.err;
  EXPECT_EQ(json.out.front(), '{');
  EXPECT_NE(json.out.find("\"triangles\": 6"), std::string::npos) << json.out;
  folder.write("room.toml", "\n[options]\natlas = 64\n");
  const Outcome options = run_sconce({"info", scene, "--options"});
  EXPECT_EQ(options.code, 0) << options.err;
  EXPECT_TRUE(std::regex_search(options.out, std::regex("atlas +64 +room.toml:3\n"))) << options.out;
  EXPECT_TRUE(std::regex_search(options.out, std::regex("solver +radiosity +default\n"))) << options.out;
  EXPECT_TRUE(options.out.ends_with("next: sconce bake " + scene + " --quality draft\n")) << options.out;
  expect_error(run_sconce({"info", scene, "--groups", "some"}), 2, "info", {"'some'", "per-light"});
}

TEST(Cli, SideFileErrorsNameTheLine) {
  const TemporaryFolder folder;
  const std::string scene = write_room(folder);
  folder.write("room.toml", "[options]\natlas = 64\nsampels = 3\n");
  expect_error(run_sconce({"bake", scene}), 2, "bake",
               {"room.toml:3", "'sampels'", "did you mean 'samples'?"});
  folder.write("room.toml", "[options]\natlas = \"large\"\n");
  expect_error(run_sconce({"bake", scene}), 2, "bake", {"room.toml:2", "'atlas'", "whole number"});
  EXPECT_FALSE(fs::exists(folder / "room.sconce"));
}

TEST(Cli, UnwritableOutputLeavesNothing) {
  const TemporaryFolder folder;
  const std::string scene = write_room(folder);
  expect_error(run_sconce({"bake", scene, "-o", (folder / "missing/room.sconce").string(), "--atlas", "64"}),
               1, "bake", {"missing/room.sconce", "cannot be written"});
  folder.write("taken.sconce", "not a package");
  expect_error(run_sconce({"bake", scene, "-o", (folder / "taken.sconce").string(), "--atlas", "64"}), 1,
               "bake", {"taken.sconce"});
  EXPECT_EQ(read_file(folder / "taken.sconce"), "not a package");
  EXPECT_EQ(names_in(folder.path()), (std::vector<std::string>{"room.mtl", "room.obj", "taken.sconce"}));
}

TEST(Cli, FullDiskLeavesNoPackage) {
  const TemporaryFolder folder;
  const std::string scene = write_room(folder);
  // A limit on the size of files fails as a full disk does.
  const Outcome bake = run_sconce({"bake", scene, "--atlas", "128", "--samples", "8", "--quiet"},
                                  "trap '' XFSZ; ulimit -f 16;");
  expect_error(bake, 1, "bake", {});
  EXPECT_FALSE(fs::exists(folder / "room.sconce"));
}

TEST(Cli, InterruptedBakeStopsCleanly) {
  const TemporaryFolder folder;
  const std::string scene = write_room(folder);
  const Outcome bake = run_sconce({"bake", scene, "--atlas", "2048", "--samples", "512"},
                                  "timeout --foreground --preserve-status -k 30 -s INT 2");
  expect_error(bake, 1, "bake", {"cancelled"});
  EXPECT_FALSE(fs::exists(folder / "room.sconce"));
}

TEST_F(Baked, PackageInfo) {
  const Outcome text = run_sconce({"info", package(), "--options"});
  EXPECT_EQ(text.code, 0) << text.err;
  for (const char* part : {"left", "right", "64 x 64", "f16", "command line", "default"}) {
    EXPECT_NE(text.out.find(part), std::string::npos) << part << "\n" << text.out;
  }
  const Outcome json = run_sconce({"info", package(), "--json"});
  for (const char* part :
       {"\"kind\": \"package\"", "\"mean_lux\"", "\"noise\"", "\"encoding\": \"f16\"", "\"source\""}) {
    EXPECT_NE(json.out.find(part), std::string::npos) << part << "\n" << json.out;
  }
}

TEST_F(Baked, UnknownGroupsNameTheKnownOnes) {
  for (const char* verb : {"mix", "render"}) {
    const std::string out = path(std::string(verb) + ".exr");
    expect_error(run_sconce({verb, package(), "lef=1", "-o", out}), 2, verb,
                 {"'lef'", "did you mean 'left'?", "right"});
    expect_error(run_sconce({verb, package(), "left=bright", "-o", out}), 2, verb, {"bright"});
    EXPECT_FALSE(fs::exists(out));
  }
  expect_error(run_sconce({"render", package(), "--tone", "filmic", "-o", path("x.png")}), 2, "render",
               {"filmic", "agx"});
  expect_error(run_sconce({"render", package(), "--camera", "front", "-o", path("x.png")}), 2, "render",
               {"front"});
}

TEST_F(Baked, MixRenderAndDiff) {
  EXPECT_EQ(run_sconce({"mix", package(), "left=0.5", "-o", path("mix.exr")}).code, 0);
  const std::vector<std::string> view = {"--eye", "0,1,3", "--target", "0,0,0",
                                         "--fov", "60",    "--size",   "48x32"};
  const auto render = [&](std::vector<std::string> args) {
    args.insert(args.begin(), {"render", package()});
    args.insert(args.end(), view.begin(), view.end());
    return run_sconce(args);
  };
  for (const char* name : {"a.exr", "b.exr"}) {
    const Outcome outcome = render({"--tone", "linear", "-o", path(name)});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
  }
  EXPECT_EQ(render({"--others", "off", "left=1", "--tone", "linear", "-o", path("left.exr")}).code, 0);
  EXPECT_EQ(render({"left=2700K", "-o", path("a.png")}).code, 0);
  EXPECT_TRUE(fs::exists(path("a.png")));
  EXPECT_EQ(run_sconce({"diff", path("a.exr"), path("b.exr"), "--metric", "max", "--fail-above", "0"}).code,
            0);
  EXPECT_EQ(run_sconce({"diff", path("left.exr"), path("b.exr"), "--fail-above", "0.1%"}).code, 3);
  EXPECT_EQ(render({"right=off", "-o", path("b.png")}).code, 0);
  EXPECT_EQ(run_sconce({"diff", path("a.png"), path("a.png"), "--metric", "flip", "--fail-above", "0"}).code,
            0);
  const Outcome flip = run_sconce({"diff", path("a.png"), path("b.png"), "--metric", "flip", "--fail-above",
                                   "0.001", "--json", "-o", path("flip.png")});
  EXPECT_EQ(flip.code, 3) << flip.err;
  EXPECT_GT(nlohmann::json::parse(flip.out).at("flip"), 0.001);
  EXPECT_TRUE(fs::exists(path("flip.png")));
  expect_error(run_sconce({"diff", path("a.exr"), path("b.exr"), "--metric", "flip"}), 1, "diff",
               {"FLIP", "0 to 1"});
  expect_error(run_sconce({"diff", path("a.exr"), path("b.exr"), "--metric", "ssim"}), 2, "diff",
               {"ssim", "flip"});
}

TEST_F(Baked, UnwritablePictures) {
  expect_error(run_sconce({"mix", package(), "-o", path("missing/mix.exr")}), 1, "mix", {"missing/mix.exr"});
  expect_error(run_sconce({"render", package(), "--size", "8x8", "--eye", "0,1,3", "--target", "0,0,0", "-o",
                           path("missing/a.png")}),
               1, "render", {"missing/a.png"});
}

TEST_F(Baked, PackageOfAnotherVersion) {
  const TemporaryFolder folder;
  const std::string copy = copy_to(folder);
  std::string manifest = read_file(fs::path(copy) / "manifest.json");
  const std::string key = "\"version\": ";
  const std::size_t at = manifest.find(key);
  ASSERT_NE(at, std::string::npos);
  manifest.replace(at + key.size(), 1, "99");
  write_file(fs::path(copy) / "manifest.json", manifest);
  for (const char* verb : {"info", "render"}) expect_error(run_sconce({verb, copy}), 1, verb, {"99", "1"});
}

TEST_F(Baked, DamagedPackage) {
  const TemporaryFolder folder;
  const std::string copy = copy_to(folder);
  const fs::path layer = fs::directory_iterator(fs::path(copy) / "layers")->path();
  fs::resize_file(layer, fs::file_size(layer) / 2);
  expect_error(run_sconce({"info", copy}), 1, "info", {layer.filename().string()});
}

TEST_F(Baked, BakesAgainOnlyWhenNeeded) {
  const Outcome again =
      run_sconce({"bake", path("room.obj"), "--atlas", "64", "--samples", "8", "--bounces", "1"});
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_NE(again.out.find("up to date"), std::string::npos) << again.out;
}
