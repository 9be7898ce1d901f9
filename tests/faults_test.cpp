// SPDX-License-Identifier: Apache-2.0
// What goes wrong around a program: full and read-only disks, two at once, clocks, no home, commas, odd
// paths, large files.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <xxhash.h>

#include <chrono>
#include <clocale>
#include <thread>

#include "app.h"
#include "faulty_room.h"
#include "solve/state.h"

namespace fs = std::filesystem;

namespace sconce {
namespace {

using test::Outcome;

/// One line on standard error with these words in it.
void expect_line(const Outcome& outcome, const std::vector<std::string>& words) {
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  for (const std::string& word : words) EXPECT_NE(outcome.err.find(word), std::string::npos) << outcome.err;
}

class Faults : public test::FaultyRoom {
 protected:
  /// Everything that writes, into `to`.
  struct Write {
    std::string target;
    std::vector<std::string> words;
  };
  std::vector<Write> writes(const std::string& to) {
    for (const std::string shard : {"0", "1"}) {
      std::vector<std::string> part = bake("s.sconce", "3");
      part.insert(part.end(), {"--shard", shard + "/2"});
      done(part);
    }
    done(bake("x.sconce", "1"));
    std::vector<std::string> transfer = test::kSmallTransfer;
    transfer.push_back(to + "/x.sconce");
    const std::string x = path("x.sconce");
    return {
        {"x.sconce",
         {"bake", path("room.glb"), "-o", to + "/x.sconce", "--atlas", "64", "--samples", "8", "--quiet"}},
        {"x.sconce",
         {"merge", path("s.shard-0-of-2"), path("s.shard-1-of-2"), "-o", to + "/x.sconce", "--quiet"}},
        {"m.exr", {"mix", x, "-o", to + "/m.exr", "--quiet"}},
        {"m.png", {"render", x, "-o", to + "/m.png", "--size", "256", "--device", "cpu", "--quiet"}},
        {"lit.glb", {"export", x, "--scene", to + "/lit.glb", "--quiet"}},
        {"x.glsl", {"shader", x, "-o", to + "/x.glsl", "--quiet"}},
        {"operators/lightmap.bin", transfer}};
  }
  /// `sconce WORDS` where DISK is a file system of its own, made by `mount` and filled from x.sconce; its
  /// files at the end are what comes on standard output.
  Outcome on_disk(const std::string& mount, const std::vector<std::string>& words) const {
    std::string run = shell_word(SCONCE_PROGRAM);
    for (const std::string& word : words) run += " " + shell_word(word);
    const std::string disk = shell_word(path("disk"));
    return test::run_program(
        "unshare", {"-rm", "sh", "-c",
                    "mkdir -p " + disk + " && mount -t tmpfs tmpfs " + disk + " && cp -r " +
                        shell_word(path("x.sconce")) + " " + disk + " && " + mount + " && { " + run +
                        "; code=$?; find " + disk + " -type f -printf '%P %s\\n' | sort; exit $code; }"});
  }
};

TEST_F(Faults, FullDisk) {
  const std::vector<Write> all = writes(path("disk"));
  const Outcome before = on_disk("true", {"--version"});
  ASSERT_EQ(before.code, 0) << before.err;
  // Room for 4 kB more than what stands.
  const std::string fill = "mount -o remount,size=$(($(du -sk " + shell_word(path("disk")) +
                           " | cut -f1) + 4))k " + shell_word(path("disk"));
  const std::string old = before.out.substr(before.out.find("x.sconce/"));
  for (const Write& write : all) {
    const Outcome outcome = on_disk(fill, write.words);
    expect_line(outcome, {write.target, "No space left on device"});
    std::string left = outcome.out;
    if (const std::size_t state = left.find(".state"); state != std::string::npos)  // to go on with
      left.erase(left.rfind('\n', state) + 1, left.find('\n', state) - left.rfind('\n', state));
    EXPECT_EQ(left, old) << write.words.front();
  }
}

TEST_F(Faults, ReadOnlyTarget) {
  const std::string read_only = "mount -o remount,ro " + shell_word(path("disk"));
  for (const Write& write : writes(path("disk")))
    expect_line(on_disk(read_only, write.words), {write.target, "Read-only file system"});
  // What only reads works.
  EXPECT_EQ(on_disk(read_only, {"info", path("disk/x.sconce")}).code, 0);
  EXPECT_EQ(on_disk(read_only, bake("disk/x.sconce", "1")).code, 0) << "up to date";
}

TEST_F(Faults, OneWriterAtATime) {
  const std::vector<Write> all = writes(folder.path().string());
  std::vector<std::string> words = bake("x.sconce", "2");
  words[7] = "1000000";  // samples
  const pid_t first = test::start_sconce(words);
  for (int i = 0; i < 1000 && !fs::exists(path("x.sconce.lock")); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  const Outcome second = test::run_sconce(bake("x.sconce", "1"));
  for (const std::size_t i : {0, 1, 6})
    expect_line(test::run_sconce(all[i].words),
                {"x.sconce", "is being written by another process, " + std::to_string(first)});
  ::kill(first, SIGKILL);
  ::waitpid(first, nullptr, 0);
  EXPECT_TRUE(fs::exists(path("x.sconce.lock"))) << "as a killed process leaves it";
  EXPECT_EQ(test::run_sconce(all[1].words).code, 0);
  EXPECT_FALSE(fs::exists(path("x.sconce.lock")));
}

/// What is up to date is told by content: clocks that jump change nothing.
TEST_F(Faults, ClocksDoNotDecide) {
  done(bake("x.sconce", "1"));
  const auto now = fs::file_time_type::clock::now();
  std::vector<std::string> words = bake("x.sconce", "1");
  words.pop_back();  // --quiet
  for (const int years : {-50, 50}) {
    for (const auto& entry : fs::recursive_directory_iterator(folder.path()))
      if (entry.is_regular_file()) fs::last_write_time(entry, now + std::chrono::hours(24 * 365 * years));
    fs::last_write_time(path("room.glb"), now - std::chrono::hours(24 * 365 * years));
    EXPECT_NE(test::run_sconce(words).out.find("is up to date"), std::string::npos);
  }
  const std::string before = content(path("x.sconce"));
  Scene changed = test::two_lamp_room();
  changed.materials[0].base_color = Rgb(0.3f);
  folder.write("room.glb", write_glb(changed, "test"));
  fs::last_write_time(path("room.glb"), now - std::chrono::hours(24 * 365 * 50));
  done(words);
  EXPECT_NE(content(path("x.sconce")), before);
}

TEST_F(Faults, WithoutHome) {
  const std::string bare = "env -i PATH=/usr/bin:/bin";
  for (const Write& write : writes(folder.path().string())) {
    const Outcome outcome = test::run_sconce(write.words, bare);
    EXPECT_EQ(outcome.code, 0) << write.words.front() << outcome.err;
  }
  folder.write("script.txt", "set left=0.5\nsettle\n");
  const Outcome view =
      test::run_sconce({"view", path("x.sconce"), "--script", path("script.txt")},
                       "env -u HOME -u XDG_STATE_HOME " + test::with_display("900x560", 100));
  EXPECT_EQ(view.code, 0) << view.err;
}

TEST_F(Faults, PathsWithBlanksAndUmlauts) {
  const fs::path odd = folder /
                       "K\xc3\xbc"
                       "che 'Nord' & S\xc3\xbc"
                       "d; $HOME";
  fs::create_directory(odd);
  fs::copy(path("room.glb"), odd / "der Raum.glb");
  const std::string package = (odd / "mein Paket.sconce").string();
  done(
      {"bake", (odd / "der Raum.glb").string(), "-o", package, "--atlas", "64", "--samples", "8", "--quiet"});
  done({"info", package});
  done({"mix", package, "left=off", "-o", (odd / "gemischt \xc3\xa4.exr").string(), "--quiet"});
  done({"render", package, "-o", (odd / "Bild \xc3\xb6.png").string(), "--size", "64", "--quiet"});
  done({"export", package, "--scene", (odd / "neu \xc3\x9f.glb").string(), "--quiet"});
  done({"probe", package, "--at", "0,1,0", "-o", (odd / "Werte.csv").string(), "--quiet"});
  std::vector<std::string> transfer = test::kSmallTransfer;
  transfer.push_back(package);
  done(transfer);
  for (const char* file : {"gemischt \xc3\xa4.exr", "Bild \xc3\xb6.png", "neu \xc3\x9f.glb", "Werte.csv"})
    EXPECT_TRUE(fs::exists(odd / file)) << file;
}

/// A host that has set a locale with a decimal comma: files come out byte for byte the same. The program
/// itself sets none.
TEST_F(Faults, DecimalCommas) {
  fs::create_directory(folder / "locales");
  const Outcome made =
      test::run_program("localedef", {"-i", "de_DE", "-f", "UTF-8", path("locales/de_DE.UTF-8")});
  ASSERT_EQ(made.code, 0) << made.err << "needs the package locales";
  folder.write(
      "room.toml",
      "[[light]]\nname = \"spot\"\ntype = \"spot\"\nposition = [0.25, 1.5, 0.25]\ntarget = [0.0, 0.0, 0.0]\n"
      "outer = 30.5\nlumens = 450.5\nkelvin = 2700.5\n");
  folder.write("room.mtl", "newmtl m\nKd 0.75 0.5 0.25\n");
  folder.write("box.obj",
               "mtllib room.mtl\nusemtl m\nv -0.5 0.25 -0.5\nv 0.5 0.25 -0.5\nv 0.5 0.25 0.5\nf 3 2 1\n");
  const auto run_all = [&](const std::string& to) {
    fs::create_directory(folder / to);
    const auto run = [](int (*verb)(int, const char* const*), std::vector<std::string> words) {
      std::vector<const char*> argv;
      for (std::size_t i = 1; i < words.size(); ++i) argv.push_back(words[i].c_str());
      EXPECT_EQ(verb(static_cast<int>(argv.size()), argv.data()), 0) << join(words, " ");
    };
    const auto out = [&](const std::string& name) { return path(to + "/" + name); };
    run(app::run_bake,
        {"bake", path("room.glb"), "-o", out("x.sconce"), "--atlas", "64", "--samples", "8", "--quiet"});
    run(app::run_bake,
        {"bake", path("box.obj"), "-o", out("box.sconce"), "--atlas", "64", "--samples", "1", "--quiet"});
    run(app::run_mix, {"mix", out("x.sconce"), "left=0.5,2700.5K", "-o", out("m.exr"), "--quiet"});
    run(app::run_render, {"render", out("x.sconce"), "left=+1.5ev", "--size", "64", "--device", "cpu", "-o",
                          out("r.png"), "--quiet"});
    run(app::run_probe, {"probe", out("x.sconce"), "--at", "0.25,0.5,0.25", "-o", out("p.csv"), "--quiet"});
    run(app::run_export, {"export", out("x.sconce"), "left=0.5", "--scene", out("lit.glb"), "--quiet"});
    run(app::run_shader, {"shader", out("x.sconce"), "-o", out("x.glsl"), "--quiet"});
  };
  run_all("c");
  ::setenv("LOCPATH", path("locales").c_str(), 1);
  ASSERT_NE(std::setlocale(LC_ALL, "de_DE.UTF-8"), nullptr);
  char half[8];
  std::snprintf(half, sizeof half, "%.1f", 0.5);
  EXPECT_STREQ(half, "0,5");
  run_all("d");
  std::setlocale(LC_ALL, "C");
  ::unsetenv("LOCPATH");
  for (const char* name : {"x.sconce", "box.sconce", "m.exr", "r.png", "p.csv", "lit.glb", "x.glsl"})
    EXPECT_EQ(content(folder / "c" / name), content(folder / "d" / name)) << name;
}

/// Records beyond 4 GB of a state file, which is sparse here.
TEST_F(Faults, StatesBeyondFourGigabytes) {
  constexpr uint32_t kTile = 1u << 16, kLayers = 512;  // 512 MB a tile
  constexpr uint64_t kValues = uint64_t{kTile} * kLayers;
  const fs::path file = folder / "x.state";
  BakeState::create(file, {"hash", "isa", kLayers, 11 * uint64_t{kTile}, kTile, "job"});
  {
    const std::vector<GroupValue> dark(kValues);
    BakeState state = BakeState::open(file, true);
    const int fd = ::open(file.c_str(), O_WRONLY);
    for (uint32_t tile = 0; tile < 10; ++tile) {  // heads alone; zeros are holes
      struct {
        uint32_t magic = 0x454c4954, tile, made_with_size = 0, values = kValues;
        uint64_t checksum;
      } head;
      head.tile = tile;
      head.checksum = XXH3_64bits_withSeed(dark.data(), kValues * sizeof(GroupValue), XXH3_64bits("", 0));
      const auto at = static_cast<off_t>(fs::file_size(file));
      ASSERT_EQ(::pwrite(fd, &head, sizeof head, at), static_cast<ssize_t>(sizeof head));
      ASSERT_EQ(::ftruncate(fd, at + static_cast<off_t>(sizeof head + kValues * sizeof(GroupValue))), 0);
    }
    ::close(fd);
  }
  ASSERT_GT(fs::file_size(file), uint64_t{5} * 1000 * 1000 * 1000);
  BakeState state = BakeState::open(file, true);
  EXPECT_TRUE(state.has(9));
  EXPECT_FALSE(state.has(10));
  EXPECT_EQ(state.read(9, kLayers - 1)[7].illuminance, Rgb(0));
}

/// And beyond 4 GB of a package's file: sizes, checksums, and what is damaged there.
TEST_F(Faults, PackagesBeyondFourGigabytes) {
  done(bake("x.sconce", "1"));
  const fs::path layout = folder / "x.sconce/layout.bin", manifest = folder / "x.sconce/manifest.json";
  const std::string small = hash_file(layout);
  fs::resize_file(layout, (uint64_t{4} << 30) + 4096);
  std::string text = read_file(manifest);
  text.replace(text.find(small), small.size(), hash_file(layout));
  write_file(manifest, text);
  EXPECT_NO_THROW(Package::open(folder / "x.sconce", true));
  const int fd = ::open(layout.c_str(), O_WRONLY);
  ASSERT_EQ(::pwrite(fd, "x", 1, (off_t{4} << 30) + 99), 1);
  ::close(fd);
  try {
    Package::open(folder / "x.sconce", true);
    FAIL() << "the change beyond 4 GB went unseen";
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("layout.bin"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace sconce
