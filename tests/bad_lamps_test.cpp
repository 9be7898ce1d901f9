// SPDX-License-Identifier: Apache-2.0
// Measured lamps that are wrong, as users meet them: each is one line that names file and place, exit code 1,
// and nothing is written. Never a wrong lamp in silence.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>

#include "core/test_data.h"
#include "image/io.h"
#include "photometry/light_field_file.h"
#include "photometry/ray_writer.h"
#include "process.h"
#include "spots.h"

namespace sconce {
namespace {

using test::run_sconce;

/// A line of a text replaced, counted from 1; nothing: cut off from there on.
std::string with(const std::string& text, std::size_t line, std::optional<std::string> to) {
  std::vector<std::string> lines = split(text, '\n');
  if (to)
    lines.at(line - 1) = *to;
  else
    lines.resize(line - 1);
  return join(lines, "\n");
}

/// What a verb says of a bad file: one line that begins with its name, then with `says`.
void expect_refused(const std::vector<std::string>& words, const std::string& file, const std::string& says,
                    const std::filesystem::path& output) {
  const auto run = run_sconce(words);
  const std::string what = file + " " + says;
  EXPECT_EQ(run.code, 1) << what << "\n" << run.err;
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << what << "\n" << run.err;
  EXPECT_NE(run.err.find("/" + file + says), std::string::npos) << what << "\n" << run.err;
  EXPECT_FALSE(std::filesystem::exists(output)) << what;
}

struct Bad {
  std::string file, bytes, says;
};

class BadLamps : public testing::Test {
 protected:
  /// By `luminaire convert`, to a file that must not come to be.
  void refuses(const Bad& bad, const std::string& output = "out.ies") {
    const auto to = folder_ / output;
    expect_refused(
        {"luminaire", "convert", folder_.write(bad.file, bad.bytes).string(), "-o", to.string(), "--quiet"},
        bad.file, bad.says, to);
  }
  TemporaryFolder folder_;
};

const std::string kIes =
    "IESNA:LM-63-2002\n[MANUFAC] m\nTILT=NONE\n1 1000 1 3 2 1 2 0.1 0.1 0\n1 1 10\n0 45 90\n0 90\n"
    "100 50 0\n90 40 0";

TEST_F(BadLamps, Lm63) {
  EXPECT_EQ(run_sconce({"luminaire", "info", folder_.write("good.ies", kIes).string()}).code, 0);
  const struct {
    std::size_t line;
    std::optional<std::string> to;
    std::string says;
  } rows[] = {
      {3, "TILT=lost.tlt", ":3: TILT file 'lost.tlt' is not there"},
      {3, "NOTILT", ":9: ends before the line TILT="},
      {3, "TILT=INCLUDE\n1\n2\n45 0\n1 1", ":6: tilt angle 2 of 2 is not above the one before"},
      {4, "1 1000 1 3 2 4 2 0.1 0.1 0",
       ":4: the photometric type is 4 (allowed: a whole number from 1 to 3)"},
      {4, "1 1000 1 3 2 1 3 0.1 0.1 0", ":4: the units type is 3"},
      {4, "1 1000 1 -3 2 1 2 0.1 0.1 0", ":4: the number of vertical angles is -3"},
      {4, "1 1000 1 3.5 2 1 2 0.1 0.1 0", ":4: the number of vertical angles is 3.5"},
      {4, "1 1000 1 2e9 2 1 2 0.1 0.1 0", ":4: the number of vertical angles is 2e+09"},
      {4, "0 1000 1 3 2 1 2 0.1 0.1 0", ":4: the number of lamps is not positive"},
      {4, "1 1000 0 3 2 1 2 0.1 0.1 0", ":4: the candela multiplier is not positive"},
      {4, "1 1000 nan 3 2 1 2 0.1 0.1 0", ":4: 'nan' stands where the candela multiplier should"},
      {5, "0 1 10", ":5: the ballast factors are not positive"},
      {6, "0 90 45", ":6: vertical angle 3 of 3 is not above the one before"},
      {6, "0 45 200", ":6: vertical angles reach from 0 to 200"},
      {7, "0 45", ":7: horizontal angles reach from 0 to 45"},
      {7, "90 0", ":7: horizontal angle 2 of 2 is not above the one before"},
      {8, "100 x 0", ":8: 'x' stands where candela value 2 of 6 should"},
      {8, "100 inf 0", ":8: 'inf' stands where candela value 2 of 6 should"},
      {9, std::nullopt, ":8: ends before candela value 4 of 6"},
  };
  for (const auto& row : rows) refuses({"lamp.ies", with(kIes, row.line, row.to), row.says});
  // Readable, but odd: said, with its line.
  for (const auto& [line, to, says] :
       {std::tuple(4, "1 -5 1 3 2 1 2 0.1 0.1 0", "line 4: -5 lumens per lamp count as -1"),
        std::tuple(8, "100 -50 0", "line 9: 1 candela values are negative and count as 0"),
        std::tuple(9, "90 40 0 7", "line 9: text after the last candela value is ignored"),
        std::tuple(1, "IESNA:LM-63-2050", "line 1: unknown header 'IESNA:LM-63-2050'")}) {
    const auto run =
        run_sconce({"luminaire", "info",
                    folder_.write("odd.ies", with(kIes, static_cast<std::size_t>(line), to)).string()});
    EXPECT_EQ(run.code, 0) << says;
    EXPECT_NE(run.err.find("odd.ies: " + std::string(says)), std::string::npos) << run.err;
  }
}

TEST_F(BadLamps, Eulumdat) {
  const auto good = test_data() / "photometry/ldt/eulumdat-ugr/input/sample_01.ldt";
  SCONCE_NEEDS_DATA(good);
  std::string text = read_file(good);
  std::erase(text, '\r');
  const struct {
    std::size_t line;
    std::optional<std::string> to;
    std::string says;
  } rows[] = {
      {2, "9", ":2: is no type of an EULUMDAT file (allowed: 1 to 3)"},
      {3, "5", ":3: is no symmetry of an EULUMDAT file, Isym (allowed: 0 to 4)"},
      {4, "0", ":4: is no number of C planes"},
      {4, "24.5", ":4: the number of C planes, Mc is 24.5"},
      {6, "0", ":6: the number of intensities in a plane, Ng is 0"},
      {7, "x", ":7: 'x' stands where the distance of intensities, Dg should"},
      {26, "0", ":26: the number of lamp sets is '0'"},
      {29, "0", ":29: the lamps' luminous flux is not positive"},
      {44, "350", ":45: C angle 3 of 24 is not above the one before"},
      {50, "x", ":50: 'x' stands where C angle 8 of 24 should"},
      {61, std::nullopt, ":60: ends before C angle 19 of 24"},
      {11, std::nullopt, ":10: ends before"},
  };
  for (const auto& row : rows) refuses({"lamp.ldt", with(text, row.line, row.to), row.says});
}

TEST_F(BadLamps, OtherTables) {
  refuses({"lamp.xml", "<?xml version=\"1.0\"?><IESTM33-22><Version>1</Version></IESTM33-22>",
           ": has 0 emitters (allowed: one"});
  refuses({"lamp.gldf", std::string("PK\3\4") + std::string(30, '\0'), ": is a zip that is cut short"});
  refuses({"lamp.ies", "", ": is no photometric file that can be read"});
  refuses({"lamp.dat", "", ": is no lamp that can be read"});
  refuses({"lamp.txt", std::string(100, '\0'), ": is no lamp that can be read"});
}

TEST_F(BadLamps, Rays) {
  RayWriter writer(folder_ / "good.tm25ray", true);
  std::vector<SourceRay> rays(10, {Vec3(0), Vec3(0, 0, -1), 1});
  writer.add(rays);
  writer.finish();
  const std::string good = read_file(folder_ / "good.tm25ray");
  const std::size_t data = good.size() - 10 * 28;
  const auto patched = [&](std::size_t at, auto value) {
    std::string out = good;
    std::memcpy(out.data() + at, &value, sizeof value);
    return out;
  };
  const Bad rows[] = {
      {"a.tm25ray", good.substr(0, good.size() - 5), ": has 36563 bytes, which do not fit 10 rays"},
      {"a.tm25ray", good + "1234", ": has 36572 bytes, which do not fit 10 rays"},
      {"a.tm25ray", good.substr(0, 200), ": is cut short in its header"},
      {"a.tm25ray", patched(20, uint64_t{0}), ": has 36568 bytes, which do not fit 0 rays"},
      {"a.tm25ray", patched(20, uint64_t{1} << 63),
       ": has 36568 bytes, which do not fit 9223372036854775808"},
      {"a.tm25ray", patched(4, int32_t{2099}), ": is TM-25 version 2099 (allowed: 2013)"},
      {"a.tm25ray", patched(256, int32_t{0}), ": holds rays without position or direction"},
      {"a.tm25ray", patched(data + 28 + 12, std::numeric_limits<float>::quiet_NaN()),
       ": holds no ray at number 2"},
      {"a.tm25ray", patched(data + 12, 5.0f), ": holds no ray at number 1"},
      {"a.tm25ray", patched(data + 24, -1.0f), ": holds no ray at number 1"},
      {"a.ray", "# LightTools 9\nlt_startofdata\n1 2 3 0 0 1 1\n", ":3: ends before lt_endofdata"},
      {"a.ray", "# LightTools 9\nlt_startofdata\n1 2 3 0 0\nlt_endofdata\n",
       ":3: is no ray (allowed: 7 or 8"},
  };
  for (const Bad& row : rows) {
    refuses(row);
    refuses(row, "out.tm25ray");
  }
  const auto field = folder_ / "out.exr";
  expect_refused(
      {"luminaire", "field", folder_.write("cut.tm25ray", good.substr(0, good.size() - 5)).string(), "-o",
       field.string()},
      "cut.tm25ray", ": has 36563 bytes", field);
}

TEST_F(BadLamps, LightFields) {
  const auto lamp = folder_ / "lamp.exr", out = folder_ / "out.exr";
  const auto refused = [&](const std::string& says, FieldCoding coding, const auto& spoil) {
    write_light_field(lamp, test::colored_spots(), coding);
    Image image = read_exr(lamp);
    spoil(image);
    write_exr(lamp, image, PixelType::full);
    expect_refused({"luminaire", "render", lamp.string(), "-o", out.string()}, "lamp.exr", says, out);
  };
  const auto number = [](const char* name, float value) {
    return [=](Image& image) { image.number[name] = value; };
  };
  const auto text = [](const char* name, const char* value) {
    return [=](Image& image) { image.text[name] = value; };
  };
  const FieldCoding full = FieldCoding::full;
  refused(": is no light field", full, text("sconce:kind", "picture"));
  refused(": has the basis 'box' (allowed: bell, spline)", full, text("sconce:basis", "box"));
  refused(": has the coding 'rgbe' (allowed: float, half, srgbe)", full, text("sconce:coding", "rgbe"));
  refused(": has the colours 'xyz' (allowed: grey, rgb)", full, text("sconce:color", "xyz"));
  refused(": has a spacing, distance or pixel that is not positive", full, number("sconce:distance", -1));
  refused(": has a spacing, distance or pixel that is not positive", full, number("sconce:spacing", 0));
  refused(": has a grain below 0", full, number("sconce:grain", -1));
  refused(": has 2.5 columns (allowed: a whole number", full, number("sconce:columns", 2.5f));
  refused(": lacks the channel E.000.005.R", full, number("sconce:columns", 6));
  refused(": has no number sconce:pixel", full, [](Image& image) { image.number.erase("sconce:pixel"); });
  refused(": holds a value that is no number in channel E.", full,
          [](Image& image) { image.data[7] = std::numeric_limits<float>::infinity(); });
  refused(": holds a value that is no code in channel C.", FieldCoding::srgbe,
          [](Image& image) { image.data[7] = 256; });
  refused(": lacks the channel C.00000.R", full, text("sconce:coding", "srgbe"));
  write_light_field(lamp, test::spots());
  const std::string whole = read_file(lamp);
  for (const std::size_t bytes : {std::size_t{0}, std::size_t{9}, whole.size() / 2}) {
    folder_.write("lamp.exr", whole.substr(0, bytes));
    expect_refused({"luminaire", "render", lamp.string(), "-o", out.string()}, "lamp.exr", ": ", out);
  }
}

// Photographs: acquired_test has what may be wrong with them and with their settings; here is what users see.
TEST_F(BadLamps, Photographs) {
  const std::string settings =
      "[filter]\ncolumns = 2\nrows = 1\nspacing = 5\n[plane]\ndistance = 100\nwidth = 100\npixels = 10\n"
      "[camera]\ncorners = [[0, 40], [40, 40], [40, 0], [0, 0]]\n[pictures]\nname = \"{m}-{n}.exr\"\n";
  const auto out = folder_ / "out.exr";
  const auto refused = [&](const std::string& file, const std::string& says) {
    expect_refused({"luminaire", "acquire", folder_.path().string(), "-o", out.string()}, file, says, out);
  };
  const auto photograph = [&](const char* name, float value) {
    Image image = Image::rgb(40, 40);
    std::fill(image.data.begin(), image.data.end(), 0.5f);
    for (int x = 10; x < 30; ++x) image.set_rgb(x, 20, Rgb(value));
    write_exr(folder_ / name, image, PixelType::full);
  };
  folder_.write("acquire.toml", with(settings, 6, "distance = -100"));
  refused("acquire.toml", ":6: [plane] distance: the screen does not lie behind the filter");
  folder_.write("acquire.toml", with(settings, 10, "corners = [[0, 0], [40, 0], [40, 40], [0, 40]]"));
  refused("acquire.toml", ":10: [camera] corners: run round as in a mirror");
  folder_.write("acquire.toml", settings);
  photograph("0-0.exr", 0.5f);
  refused("1-0.exr", ": is missing: 1 of 2 positions are there");
  photograph("1-0.exr", std::numeric_limits<float>::infinity());
  refused("1-0.exr", ": is saturated in ");
  photograph("1-0.exr", -1);
  refused("1-0.exr", ": has negative pixels: ");
  photograph("1-0.exr", 0.5f);
  // The brighter pictures are said to be the negative ones.
  for (const char* name : {"n0-0.exr", "n1-0.exr"}) photograph(name, 0.4f);
  folder_.write("acquire.toml", settings.substr(0, settings.find("name =")) +
                                    "name = \"n{m}-{n}.exr\"\nnegative = \"{m}-{n}.exr\"\n");
  refused(folder_.path().filename().string(), ": sends -");
}

// In a scene: the side file's line, and the lamp's own.
TEST_F(BadLamps, InAScene) {
  folder_.write("room.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const auto scene = [&](const std::string& lamp, const std::string& says) {
    folder_.write("room.toml", "[[luminaire]]\nfile = \"" + lamp + "\"\nat = [0, 2, 0]\n");
    expect_refused({"bake", (folder_ / "room.obj").string()}, "room.toml", says, folder_ / "room.sconce");
  };
  scene("lost.ies", ":2: [[luminaire]] file: ");
  folder_.write("bad.ies", with(kIes, 8, "100 x 0"));
  scene("bad.ies", ":2: [[luminaire]] file: " + (folder_ / "bad.ies").string() + ":8: 'x' stands where");
  LightField dark = test::spots();
  std::fill(dark.irradiance.begin(), dark.irradiance.end(), 0.0f);
  write_light_field(folder_ / "dark.exr", dark);
  scene("dark.exr", ":2: [[luminaire]] file: " + (folder_ / "dark.exr").string() + ": sends 0 lm in all");
}

}  // namespace
}  // namespace sconce
