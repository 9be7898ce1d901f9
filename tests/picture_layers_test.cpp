// SPDX-License-Identifier: Apache-2.0
// render --layers, --colorspace and sequences, on a package whose content is known.
#include <gtest/gtest.h>

#include "image/io.h"
#include "image/primaries.h"
#include "picture/test_pictures.h"
#include "process.h"

namespace sconce {
namespace {

using test::Outcome;
using test::run_sconce;

class PictureLayers : public testing::Test {
 protected:
  void SetUp() override { write_package(path("wall.sconce"), lit_wall(8, 8)); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  Outcome run(std::vector<std::string> more) const {
    std::vector<std::string> args{"render", path("wall.sconce"), "--samples", "4"};
    if (std::find(more.begin(), more.end(), "--size") == more.end())
      args.insert(args.end(), {"--size", "40x30"});
    args.insert(args.end(), more.begin(), more.end());
    return run_sconce(args);
  }
  Image render(std::vector<std::string> more) const {
    more.insert(more.end(), {"-o", path("x.exr")});
    const Outcome outcome = run(more);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return read_exr(path("x.exr"));
  }
  void expect_error(const std::vector<std::string>& args, const std::string& said) const {
    const Outcome outcome = run(args);
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_NE(outcome.err.find(said), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
  TemporaryFolder folder_;
};

float value(const Image& image, std::size_t i, const std::string& channel) {
  const int c = image.channel(channel);
  EXPECT_GE(c, 0) << channel;
  return image.data[i * image.stride() + static_cast<std::size_t>(c)];
}

// Lamps of a group, one without, a sky; one group dimmed, one tinted.
TEST_F(PictureLayers, GroupsSumToTheBeauty) {
  const std::vector<std::string> mix{"a=0.3", "b=#ff8000"};
  const Image plain = render(mix);
  auto with_layers = mix;
  with_layers.insert(with_layers.end(), {"--layers", "groups"});
  const Image layered = render(with_layers);
  EXPECT_EQ(layered.text.at("sconce:groups"), "a\nb\nc\nrest");
  ASSERT_EQ(layered.stride(), 3u * 5);
  double lit = 0;
  for (std::size_t i = 0; i < layered.pixels(); ++i)
    for (const char* channel : {"R", "G", "B"}) {
      const float beauty = value(layered, i, channel);
      float sum = 0;
      for (const char* group : {"a.", "b.", "c.", "rest."})
        sum += value(layered, i, std::string(group) + channel);
      EXPECT_NEAR(sum, beauty, 1e-6f * beauty);
      EXPECT_NEAR(beauty, value(plain, i, channel), 2e-6f * beauty);
      lit += static_cast<double>(beauty);
    }
  EXPECT_GT(lit, 0);
  // What was written is a light-group picture as any other: with the same lights the same picture.
  ASSERT_EQ(run_sconce({"mix", path("x.exr"), "a=0.5", "-o", path("y.exr")}).code, 0);
  const Image mixed = read_exr(path("y.exr"));
  for (std::size_t i = 0; i < layered.pixels(); ++i)
    EXPECT_NEAR(value(mixed, i, "G"), value(layered, i, "G") - 0.5f * value(layered, i, "a.G"),
                2e-6f * value(layered, i, "G"));
}

// The camera is 2 m before a wall in z = 0 that looks towards +z, of reflectance (0.8, 0.5, 0.1).
TEST_F(PictureLayers, Surfaces) {
  const Image image = render({"--layers", "albedo,normal,position,depth,id", "--size", "41x31"});
  EXPECT_EQ(image.channel("a.R"), -1);
  const std::size_t up = 41 * 6 + 20;  // above the lamps
  EXPECT_NEAR(value(image, up, "albedo.R"), 0.8f, 1e-6f);
  EXPECT_NEAR(value(image, up, "albedo.B"), 0.1f, 1e-6f);
  EXPECT_NEAR(value(image, up, "normal.Z"), 1, 1e-6f);
  EXPECT_NEAR(value(image, up, "depth.Z"), 2, 1e-5f);
  EXPECT_NEAR(value(image, up, "position.X"), 0, 1e-5f);
  EXPECT_NEAR(value(image, up, "position.Y"), 2 * std::tan(0.65f) * 9 / 15.5f, 1e-4f);
  EXPECT_NEAR(value(image, up, "position.Z"), 0, 1e-5f);
  EXPECT_EQ(value(image, up, "id.ID"), 1);
  EXPECT_EQ(value(image, 0, "id.ID"), 0) << "past the wall's edge";
  EXPECT_EQ(value(image, 0, "depth.Z"), 1e10f);
}

TEST_F(PictureLayers, Acescg) {
  const Image plain = render({}), wide = render({"--colorspace", "acescg", "--layers", "albedo"});
  EXPECT_EQ(wide.primaries, kAcescgPrimaries);
  Image back = wide;
  to_rec709(back);
  for (std::size_t i = 0; i < plain.pixels(); ++i)
    for (const char* channel : {"R", "G", "B"})
      EXPECT_NEAR(value(back, i, channel), value(plain, i, channel), 1e-5f * (1 + value(plain, i, "B")));
  // (0.8, 0.5, 0.1) by the published matrix.
  EXPECT_NEAR(value(wide, 40 * 6 + 20, "albedo.R"), 0.613097f * 0.8f + 0.339523f * 0.5f + 0.047379f * 0.1f,
              1e-5f);
  ASSERT_EQ(run_sconce({"mix", path("wall.sconce"), "-o", path("m.exr")}).code, 0);
  ASSERT_EQ(run_sconce({"mix", path("wall.sconce"), "--colorspace", "acescg", "-o", path("w.exr")}).code, 0);
  Image m = read_exr(path("m.0.exr")), w = read_exr(path("w.0.exr"));
  EXPECT_NEAR(w.data[1], 0.070194f * m.data[0] + 0.916354f * m.data[1] + 0.013452f * m.data[2], 1e-4f);
}

// A picture keeps its own colour space, and is converted on request, there and back; its file says which.
TEST_F(PictureLayers, ColourSpacesOfPictures) {
  render({"--layers", "groups"});
  const auto mixed = [&](const std::string& from, const std::string& to,
                         const std::vector<std::string>& more) {
    std::vector<std::string> words{"mix", path(from), "a=0.5", "-o", path(to)};
    words.insert(words.end(), more.begin(), more.end());
    EXPECT_EQ(run_sconce(words).code, 0);
    return read_exr(path(to));
  };
  const Image own = mixed("x.exr", "own.exr", {}),
              wide = mixed("x.exr", "wide.exr", {"--colorspace", "acescg"});
  EXPECT_EQ(own.primaries, kRec709Primaries);
  EXPECT_EQ(wide.primaries, kAcescgPrimaries);
  ASSERT_EQ(own.pixels(), wide.pixels());
  double lit = 0;
  for (std::size_t i = 0; i < own.pixels(); ++i) {
    const float r = value(own, i, "R"), g = value(own, i, "G"), b = value(own, i, "B");
    EXPECT_NEAR(value(wide, i, "R"), 0.613097f * r + 0.339523f * g + 0.047379f * b, 1e-4f * (r + g + b));
    lit += static_cast<double>(g);
  }
  EXPECT_GT(lit, 0);
  // A picture in ACEScg with groups.
  render({"--layers", "groups", "--colorspace", "acescg"});
  EXPECT_EQ(mixed("x.exr", "kept.exr", {}).primaries, kAcescgPrimaries);
  const Image back = mixed("x.exr", "back.exr", {"--colorspace", "rec709"});
  EXPECT_EQ(back.primaries, kRec709Primaries);
  for (std::size_t i = 0; i < own.pixels(); ++i)
    EXPECT_NEAR(value(back, i, "B"), value(own, i, "B"), 1e-4f * (1 + value(own, i, "G")));
  EXPECT_EQ(run_sconce({"mix", path("x.exr"), "--colorspace", "srgb", "-o", path("y.exr")}).code, 2);
}

// Light fades linearly; the exposure, here absolute, in stops.
TEST_F(PictureLayers, Sequence) {
  folder_.write("day.toml", "ev100 = \"4\"\n[mix]\na = \"1\"\nb = \"off\"\n");
  folder_.write("night.toml", "ev100 = \"2\"\n[mix]\na = \"off\"\nb = \"0.5\"\n");
  const Outcome outcome =
      run({"--from", path("day"), "--to", path("night.toml"), "--frames", "5", "-o", path("shot.%03d.exr")});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Image day = render({"--preset", path("day.toml")}), night = render({"--preset", path("night.toml")});
  EXPECT_EQ(read_exr(path("shot.001.exr")).data, day.data);
  EXPECT_EQ(read_exr(path("shot.005.exr")).data, night.data);
  const Image second = read_exr(path("shot.002.exr"));
  const float a = day.number.at("whiteLuminance"), b = night.number.at("whiteLuminance");
  EXPECT_NEAR(a / b, 4, 1e-5f);
  EXPECT_NEAR(second.number.at("whiteLuminance"), a / std::sqrt(2.0f), 1e-5f * a);
  for (std::size_t i = 0; i < second.data.size(); ++i)
    EXPECT_NEAR(second.data[i] * a / std::sqrt(2.0f), 0.75f * day.data[i] * a + 0.25f * night.data[i] * b,
                1e-5f * a);
  ASSERT_EQ(run({"--from", path("day"), "--to", path("night"), "--frames", "2", "-o", path("p%d.png")}).code,
            0);
  EXPECT_TRUE(std::filesystem::exists(path("p1.png")));
  EXPECT_TRUE(std::filesystem::exists(path("p2.png")));
}

// The second of eight pictures is taken from 45 degrees to the right.
TEST_F(PictureLayers, Turntable) {
  const std::vector<std::string> from{"--eye", "0,0.3,2", "--target", "0,0,0"};
  std::vector<std::string> turn = from;
  turn.insert(turn.end(), {"--turntable", "8", "-o", path("turn.%d.exr")});
  ASSERT_EQ(run(turn).code, 0);
  EXPECT_EQ(read_exr(path("turn.1.exr")).data, render(from).data);
  const Image turned = read_exr(path("turn.2.exr")),
              beside = render({"--eye", "1.41421356,0.3,1.41421356", "--target", "0,0,0"});
  double difference = 0, light = 0;
  for (std::size_t i = 0; i < beside.data.size(); ++i) {
    difference += std::abs(double{turned.data[i]} - double{beside.data[i]});
    light += double{beside.data[i]};
  }
  EXPECT_LT(difference, 0.01 * light);
  EXPECT_TRUE(std::filesystem::exists(path("turn.8.exr")));
  EXPECT_FALSE(std::filesystem::exists(path("turn.9.exr")));
  ASSERT_EQ(run({"--turntable", "2", "-o", path("t%d.png")}).code, 0);
  EXPECT_TRUE(std::filesystem::exists(path("t2.png")));
}

// A film is what ffmpeg makes of the pictures; here a stand-in that keeps the first of them.
TEST_F(PictureLayers, Films) {
  std::filesystem::create_directory(path("bin"));
  const auto stand_in = [&](const std::string& script) {
    const auto tool = folder_.write("bin/ffmpeg", "#!/bin/sh\n[ \"$1\" = -version ] && exit 0\n" + script);
    std::filesystem::permissions(tool, std::filesystem::perms::owner_all);
  };
  const auto film_by = [&](const std::string& tools) {
    return run_sconce({"render", path("wall.sconce"), "--samples", "4", "--size", "40x30", "--turntable", "3",
                       "-o", path("turn.mp4")},
                      "env PATH=" + tools);
  };
  stand_in(R"(while [ $# -gt 1 ]; do [ "$1" = -i ] && first=$(printf "$2" 1); shift; done
cp "$first" "$1"
)");
  const std::string found = path("bin") + ":/usr/bin:/bin";
  ASSERT_EQ(film_by(found).code, 0);
  ASSERT_EQ(run({"-o", path("still.png")}).code, 0);
  EXPECT_EQ(read_file(path("turn.mp4")), read_file(path("still.png")));
  std::filesystem::remove(path("turn.mp4"));
  const Outcome none = film_by(path("no"));
  EXPECT_EQ(none.code, 1);
  EXPECT_NE(none.err.find("ffmpeg, which is not installed"), std::string::npos) << none.err;
  EXPECT_NE(none.err.find("turn.%04d.png"), std::string::npos) << none.err;
  stand_in("echo 'no such codec' >&2\nexit 1\n");
  const Outcome failed = film_by(found);
  EXPECT_EQ(failed.code, 1);
  EXPECT_NE(failed.err.find("turn.mp4: ffmpeg failed: no such codec"), std::string::npos) << failed.err;
  EXPECT_FALSE(std::filesystem::exists(path("turn.mp4")));
}

TEST_F(PictureLayers, Errors) {
  expect_error({"--layers", "albedo", "-o", path("x.png")}, "OpenEXR");
  expect_error({"--layers", "albedos", "-o", path("x.exr")}, "groups, albedo, normal, position, depth, id");
  expect_error({"--colorspace", "acescg", "-o", path("x.png")}, "-o FILE.exr");
  expect_error({"--colorspace", "aces", "-o", path("x.exr")}, "rec709, acescg");
  expect_error({"--from", "day", "-o", path("x%d.png")}, "--from, --to and --frames");
  expect_error({"--from", "a", "--to", "b", "--frames", "9", "-o", path("x.png")}, "%04d");
  expect_error({"--turntable", "1", "-o", path("x%d.png")}, "2 to 100000");
  expect_error({"--turntable", "9", "-o", path("x.png")}, "%04d");
  expect_error({"--turntable", "9", "--frames", "9", "-o", path("x%d.png")}, "exclude each other");
  expect_error({"-o", path("x.mp4")}, "--turntable");
  expect_error({"--turntable", "9", "--fps", "25", "-o", path("x%d.png")}, "only films");
  folder_.write("a.toml", "camera = \"main\"\n");
  folder_.write("b.toml", "camera = \"other\"\n");
  expect_error({"--from", path("a"), "--to", path("b"), "--frames", "9", "-o", path("x%d.png")}, "--camera");
}

}  // namespace
}  // namespace sconce
