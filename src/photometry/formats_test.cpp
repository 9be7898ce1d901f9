// SPDX-License-Identifier: Apache-2.0
// Photometric files: other people's, and small ones with known answers.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/files.h"
#include "core/test_data.h"
#include "core/test_folder.h"
#include "core/text.h"
#include "photometry/formats.h"
#include "photometry/lines.h"

namespace sconce {
namespace {

namespace fs = std::filesystem;

fs::path folder() {
  return test_data() / "photometry";
}

/// A type C file whose plane i is 100 + i cd from nadir to zenith.
std::string ies(const std::string& planes, int count, const std::string& first = "IESNA:LM-63-2002",
                const std::string& sizes = "2 0.3 0.6 0", const std::string& factors = "1 1 30") {
  std::string text = first + "\n[TEST] x\nTILT=NONE\n1 1000 2 2 " + std::to_string(count) + " 1 " + sizes +
                     "\n" + factors + "\n0 180\n" + planes + "\n";
  for (int i = 0; i < count; ++i) text += std::to_string(100 + i) + " " + std::to_string(100 + i) + "\n";
  return text;
}

// methods.md test 13: 1 cd all around is 4 pi lm; multiplier and factors apply once.
TEST(Formats, FactorsApplyOnce) {
  const auto lumens = [](const std::string& text) {
    return flux(parse_ies(text, "x")) / (4 * std::numbers::pi);
  };
  EXPECT_NEAR(lumens(ies("0", 1)), 200, 1e-10);
  EXPECT_NEAR(lumens(ies("0", 1, "IESNA:LM-63-2002", "2 0 0 0", "0.9 0.5 30")), 90, 1e-10);
  EXPECT_NEAR(lumens(ies("0", 1, "IES:LM-63-2019", "2 0 0 0", "0.9 1.00001 30")), 180, 1e-10)
      << "the second is a file generation type";
}

TEST(Formats, SymmetriesAreFilledIn) {
  const double plane = 2;  // multiplier
  const Photometry quadrant = parse_ies(ies("0 45 90", 3), "x");
  for (const double c : {45.0, 135.0, 225.0, 315.0})
    EXPECT_EQ(intensity_at(quadrant, c, 40), 101 * plane) << c;
  EXPECT_EQ(intensity_at(quadrant, 180, 40), 100 * plane);
  EXPECT_EQ(intensity_at(quadrant, 270, 40), 102 * plane);
  EXPECT_EQ(symmetry_of(quadrant), Symmetry::quadrants);
  const Photometry half = parse_ies(ies("0 90 180", 3), "x");
  EXPECT_EQ(intensity_at(half, 270, 40), 101 * plane);
  EXPECT_EQ(intensity_at(half, 225, 40), 101.5 * plane);
  EXPECT_EQ(symmetry_of(half), Symmetry::about_c0);
  const Photometry side = parse_ies(ies("90 180 270", 3), "x");
  EXPECT_EQ(intensity_at(side, 0, 40), intensity_at(side, 180, 40));
  EXPECT_EQ(intensity_at(side, 45, 40), intensity_at(side, 135, 40));
  EXPECT_EQ(intensity_at(side, 300, 40), intensity_at(side, 240, 40));
  EXPECT_EQ(symmetry_of(side), Symmetry::about_c90);
  const Photometry odd = parse_ies(ies("90 135 225 270", 4), "x");
  EXPECT_EQ(intensity_at(odd, 0, 40), 101.5 * plane) << "between the mirrored 135 and 225";
  EXPECT_EQ(intensity_at(odd, 360, 40), intensity_at(odd, 0, 40));
  const Photometry open = parse_ies(ies("0 120 240", 3), "x");
  EXPECT_EQ(intensity_at(open, 300, 40), 101 * plane) << "the circle closes";
  EXPECT_EQ(open.notes.size(), 1u);
}

TEST(Formats, SizesInFeetAndTheirSigns) {
  const auto opening = [](const char* sizes) {
    return parse_ies(ies("0", 1, "IESNA:LM-63-2002", sizes), "x").opening;
  };
  EXPECT_NEAR(opening("1 1 2 0").size.x, 2 * 0.3048, 1e-6) << "length lies along C0";
  EXPECT_NEAR(opening("1 1 2 0").size.y, 0.3048, 1e-6);
  EXPECT_EQ(opening("2 0 0 0").is_point(), true);
  EXPECT_EQ(opening("2 -0.2 -0.2 0").shape, Opening::Shape::cylinder);
  EXPECT_EQ(opening("2 -0.2 0 0").size, Vec3(0.2f, 0.2f, 0)) << "1995 leaves the length out";
  EXPECT_EQ(opening("2 -0.2 -0.2 -0.2").shape, Opening::Shape::ellipsoid);
  EXPECT_EQ(opening("2 0.2 -0.3 -0.3").axis, 1);
  EXPECT_EQ(opening("2 -0.3 0.2 -0.3").axis, 0);
}

// Weight sine over a cosine of latitude: a type B table of 1 cd over its hemisphere gives 2 pi lm, and its
// horizontal angle is the latitude. Of the two readings of the file below only this one gives the flux it
// states.
TEST(Formats, TypesAAndB) {
  for (const int type : {2, 3}) {
    const Photometry one = parse_ies("IESNA91\nTILT=NONE\n1 -1 1 2 2 " + std::to_string(type) +
                                         " 2 0 0 0\n1 1 0\n-90 90\n0 90\n1 1\n1 1\n",
                                     "x");
    EXPECT_NEAR(flux(one), 2 * std::numbers::pi, 1e-10) << type;
    EXPECT_TRUE(one.absolute);
    EXPECT_NEAR(flux(as_type_c(one)), 2 * std::numbers::pi, 1e-3) << type;
    EXPECT_EQ(intensity(one, Vec3(0, 0, -1)), 1);
    EXPECT_EQ(intensity(one, Vec3(0, 0, 1)), 0);
  }
  // Horizontal angle +60 (to the right) is brighter than -60.
  const std::string tail = " 2 0 0 0\n1 1 0\n-90 0 90\n-90 0 90\n0 0 0\n0 5 0\n0 9 0\n";
  for (const int type : {2, 3}) {
    const Photometry lamp = parse_ies("IESNA91\nTILT=NONE\n1 -1 1 3 3 " + std::to_string(type) + tail, "x");
    EXPECT_GT(intensity(lamp, glm::normalize(Vec3(1.7f, 0, -1))), 5) << type;
    EXPECT_LT(intensity(lamp, glm::normalize(Vec3(-1.7f, 0, -1))), 5) << type;
  }
  SCONCE_NEEDS_DATA(folder());
  const Photometry flood = read_photometry(folder() / "ies/ies_rescale/Type B - 03.ies");
  EXPECT_EQ(*flood.stated, 5871);
  EXPECT_NEAR(flux(flood), 5871, 3);
}

TEST(Formats, TiltAndComments) {
  SCONCE_NEEDS_DATA(folder());
  const Photometry lamp = read_photometry(folder() / "ies/ies_rescale/Type C - Annotated.ies");
  EXPECT_EQ(lamp.tilt.geometry, 1);
  EXPECT_EQ(tilt_factor(lamp.tilt, 0), 1);
  EXPECT_NEAR(tilt_factor(lamp.tilt, 22.5), 0.945, 1e-12);
  EXPECT_EQ(lamp.lamps[0].lumens, 50000);
  EXPECT_EQ(lamp.keyword("MAINTCAT"), "4");
}

TEST(Formats, Eulumdat) {
  SCONCE_NEEDS_DATA(folder());
  const auto read = [](const char* name) { return read_photometry(folder() / "ldt/eulumdat-py" / name); };
  const Photometry two = read("sample1.ldt");
  ASSERT_EQ(two.lamps.size(), 2u);
  EXPECT_EQ(two.lamps[0].lumens, 1983) << "intensities are per 1000 lm of the first set";
  EXPECT_EQ(two.lamps[1].lumens, 2643);
  EXPECT_EQ(two.opening.size, Vec3(0.105f, 1.208f, 0.051f)) << "the long axis lies along C90";
  const Photometry mark = read("sample5.ldt");
  EXPECT_EQ(mark.keyword("MANUFAC"), "ERCO GmbH") << "byte order mark";
  EXPECT_TRUE(mark.absolute);
  EXPECT_EQ(mark.opening.shape, Opening::Shape::cylinder);
  EXPECT_EQ(symmetry_of(mark), Symmetry::axial);
  EXPECT_EQ(symmetry_of(read("sample6.ldt")), Symmetry::about_c90);
  EXPECT_EQ(symmetry_of(read("sample2.ldt")), Symmetry::about_c0);
  EXPECT_EQ(symmetry_of(read("sample4.ldt")), Symmetry::quadrants);
  EXPECT_EQ(read("sample7.ldt").azimuths.size(), 361u);
}

/// @param values  IntData elements
std::string tm33(const std::string& values, const std::string& more = "") {
  return "<?xml "
         "version=\"1.0\"?>\n<IESTM33-22><Version>1.1</Version>\n<Header><Manufacturer>Maker</Manufacturer></"
         "Header>\n"
         "<Emitter><Quantity>1</Quantity><RatedLumens>500</"
         "RatedLumens>\n<LuminousData><LuminousIntensity>\n" +
         values + "</LuminousIntensity></LuminousData></Emitter>" + more + "</IESTM33-22>\n";
}

TEST(Formats, Tm33) {
  const Photometry axial =
      parse_tm33(tm33("<IntData h=\"0\" v=\"0\">1</IntData><IntData h=\"0\" v=\"180\">1</IntData>"), "x");
  EXPECT_NEAR(flux(axial), 4 * std::numbers::pi, 1e-12);
  EXPECT_EQ(axial.keyword("MANUFAC"), "Maker");
  // Values in any order; a quadrant is mirrored.
  const Photometry quadrant =
      parse_tm33(tm33("<Multiplier>2</Multiplier><IntData h=\"90\" v=\"90\">4</IntData><IntData h=\"0\" "
                      "v=\"0\">1</IntData>"
                      "<IntData h=\"90\" v=\"0\">1</IntData><IntData h=\"0\" v=\"90\">3</IntData>"),
                 "x");
  EXPECT_EQ(intensity_at(quadrant, 180, 90), 6);
  EXPECT_EQ(intensity_at(quadrant, 270, 90), 8);
  EXPECT_EQ(symmetry_of(quadrant), Symmetry::quadrants);
  const auto error = [](const std::string& text) {
    try {
      parse_tm33(text, "lamp.xml");
    } catch (const Error& e) {
      return std::string(e.what());
    }
    return std::string("no error");
  };
  EXPECT_EQ(error(tm33("<IntData h=\"0\" v=\"x\">1</IntData>")),
            "lamp.xml:6: 'x' stands where IntData should (allowed: a number)");
  EXPECT_NE(
      error(tm33("<IntData h=\"0\" v=\"0\">1</IntData>").substr(0, 150)).find("lamp.xml:4: is no valid XML"),
      std::string::npos)
      << error(tm33("<IntData h=\"0\" v=\"0\">1</IntData>").substr(0, 150));
  EXPECT_NE(error(tm33("<IntData h=\"0\" v=\"0\">1</IntData>", "<Emitter/>")).find("has 2 emitters"),
            std::string::npos);
  EXPECT_NE(error(tm33("")).find("holds no IntData"), std::string::npos);
  EXPECT_THROW(parse_tm33("<svg/>", "x"), NotMyFormat);
  const std::string values = "<IntData h=\"0\" v=\"0\">1</IntData><IntData h=\"0\" v=\"180\">-1</IntData>";
  EXPECT_NE(error(tm33("<PhotometryType>CIE _ B</PhotometryType>" + values))
                .find("lamp.xml:6: is photometry of type B"),
            std::string::npos);
  EXPECT_NE(error(tm33("<Metric>Photon</Metric>" + values)).find("holds the metric 'Photon'"),
            std::string::npos);
  std::string full = tm33(values);
  full.replace(
      full.find("<Emitter>"), 9,
      "<Luminaire><Dimensions><Length>1.2</Length><Width>0.3</Width></Dimensions></Luminaire><Emitter>"
      "<SpectralDistribution/>");
  const Photometry noted = parse_tm33(full, "x");
  ASSERT_EQ(noted.notes.size(), 3u);
  EXPECT_EQ(noted.notes[0],
            "line 4: the housing of 1.2 x 0.3 x 0 is no luminous opening: the lamp is a point");
  EXPECT_EQ(noted.notes[1], "line 5: 1 candela values are negative and count as 0");
  EXPECT_NE(noted.notes[2].find("spectrum is not used"), std::string::npos);
  // The other layout.
  const Photometry other = parse_tm33(
      "<IESTM33-22><Emitter><LuminousData><IntensityData horz=\"0\" vert=\"0\">2</IntensityData>"
      "<IntensityData horz=\"0\" vert=\"180\">2</IntensityData></LuminousData></Emitter></IESTM33-22>",
      "x");
  EXPECT_NEAR(flux(other), 8 * std::numbers::pi, 1e-12);
}

TEST(Formats, BadInputIsOneLineThatNamesThePlace) {
  const std::string good = ies("0 90", 2);
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    try {
      parse_ies(text, "lamp.ies");
    } catch (const Error& e) {
      return std::string(e.what());
    }
    return std::string("no error");
  };
  EXPECT_EQ(with("1 1000 2 2 2 1 2", "1 1000 2 2 2 4 2"),
            "lamp.ies:4: the photometric type is 4 (allowed: a whole number from 1 to 3)");
  EXPECT_EQ(with("1 1000 2 2 2 1 2", "1 1000 2 2 2 1e91 2"),
            "lamp.ies:4: the photometric type is 1e+91 (allowed: a whole number from 1 to 3)");
  EXPECT_EQ(with("0 90\n", "90 0\n"), "lamp.ies:7: horizontal angle 2 of 2 is not above the one before");
  EXPECT_EQ(with("0 90\n", "0 45\n"),
            "lamp.ies:7: horizontal angles reach from 0 to 45 (allowed: from 0 to 0, 90, 180 or 360, or from "
            "90 to 270)");
  EXPECT_EQ(with("0 180\n", "0 200\n"),
            "lamp.ies:6: vertical angles reach from 0 to 200 (allowed: 0 to 180 for type C)");
  EXPECT_EQ(with("101 101", "101 nan"),
            "lamp.ies:9: 'nan' stands where candela value 4 of 4 should (allowed: a number)");
  EXPECT_EQ(with("101 101\n", ""), "lamp.ies:8: ends before candela value 3 of 4");
  EXPECT_EQ(
      with("TILT=NONE", "TILT=lamp.tlt"),
      "lamp.ies:3: TILT file 'lamp.tlt' is not there (allowed: TILT=NONE, TILT=INCLUDE or a file beside "
      "this one)");
  EXPECT_EQ(with("1 1000 2", "1 1000 -2"),
            "lamp.ies:4: the candela multiplier is not positive (allowed: a factor > 0)");
  EXPECT_THROW(parse_ies("solid\n", "x"), NotMyFormat);
  EXPECT_THROW(parse_ldt("solid\n", "x"), NotMyFormat);
  EXPECT_THROW(parse_ies("IESNA:LM-63-2002\n[TEST]", "x"), Error);
}

// The header decides what the second ballast number means and where 1995 leaves a diameter out.
TEST(Formats, EveryHeaderOfLm63) {
  const std::vector<std::pair<const char*, const char*>> headers = {
      {"IESNA86", "LM-63-1986"},          {"IESNA91", "LM-63-1991"},
      {"IESNA95", "LM-63-1995"},          {"IESNA:LM-63-1995", "LM-63-1995"},
      {"IESNA:LM-63-2002", "LM-63-2002"}, {"IES:LM-63-2019", "LM-63-2019"},
      {"a label", "LM-63-1986"}};
  for (const auto& [header, format] : headers) {
    const Photometry lamp = parse_ies(ies("0", 1, header, "1 1 2 0"), "x");
    EXPECT_EQ(lamp.format, format);
    EXPECT_TRUE(lamp.notes.empty()) << header;
    EXPECT_NEAR(flux(lamp), 4 * std::numbers::pi * 200, 1e-9) << header;
    EXPECT_NEAR(lamp.opening.size.x, 2 * 0.3048, 1e-6) << header;
  }
  const Photometry odd = parse_ies(ies("0", 1, "IESNA:LM-63-2050"), "x");
  ASSERT_EQ(odd.notes.size(), 1u);
  EXPECT_NE(odd.notes[0].find("line 1: unknown header 'IESNA:LM-63-2050'"), std::string::npos);
}

TEST(Formats, TiltBesideTheFile) {
  const TemporaryFolder folder;
  folder.write("lamp.tlt", "1\n3\n0 45 90\n1 0.9 0.7\n");
  std::string text = ies("0", 1);
  text.replace(text.find("TILT=NONE"), 9, "TILT=lamp.tlt");
  const Photometry lamp = read_photometry(folder.write("lamp.ies", text));
  EXPECT_NEAR(tilt_factor(lamp.tilt, 67.5), 0.8, 1e-12);
  EXPECT_EQ(parse_ies(write_ies(lamp), "again").tilt.factors, lamp.tilt.factors);
  folder.write("lamp.tlt", "1\n3\n0 45 90\n1 x 0.7\n");
  try {
    read_photometry(folder / "lamp.ies");
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("lamp.tlt:4: 'x' stands where tilt factor 2 of 3"),
              std::string::npos)
        << e.what();
  }
}

/// An EULUMDAT text: planes of the given symmetry, of which `held` are there; plane i has 100 + i cd per 1000
/// lm.
std::string ldt(int symmetry, const std::vector<double>& planes, int held, double lumens = 2000) {
  std::string text = fmt::format(
      "maker\n3\n{}\n{}\n0\n3\n0\nreport\nname\nnumber\nfile\ndate\n600\n300\n80\n500\n200\n0\n0\n0\n0"
      "\n100\n80\n1\n0\n1\n1\nLED\n{}\n3000\n80\n20\n",
      symmetry, planes.size(), lumens);
  for (int i = 0; i < 10; ++i) text += "0.5\n";
  for (const double c : planes) text += fmt::format("{}\n", c);
  text += "0\n90\n180\n";
  for (int i = 0; i < held; ++i) text += fmt::format("{0}\n{0}\n{0}\n", 100 + i);
  return text;
}

TEST(Formats, EulumdatSymmetries) {
  const std::vector<double> planes = {0, 45, 90, 135, 180, 225, 270, 315};
  const auto at = [](const Photometry& p, double c) { return intensity_at(p, c, 40) / 2; };  // per 1000 lm
  const Photometry full = parse_ldt(ldt(0, planes, 8), "x");
  EXPECT_EQ(at(full, 315), 107);
  EXPECT_EQ(at(full, 337.5), 103.5) << "between C315 and C0";
  EXPECT_EQ(at(parse_ldt(ldt(1, {0}, 1), "x"), 200), 100);
  const Photometry c0 = parse_ldt(ldt(2, planes, 5), "x");
  EXPECT_EQ(at(c0, 225), at(c0, 135));
  EXPECT_EQ(at(c0, 180), 104);
  const Photometry c90 = parse_ldt(ldt(3, planes, 5), "x");  // from C270 through C0 to C90
  EXPECT_EQ(at(c90, 270), 100);
  EXPECT_EQ(at(c90, 0), 102);
  EXPECT_EQ(at(c90, 180), 102);
  EXPECT_EQ(at(c90, 90), 104);
  const Photometry quarter = parse_ldt(ldt(4, planes, 3), "x");
  for (const double c : {45.0, 135.0, 225.0, 315.0}) EXPECT_EQ(at(quarter, c), 101) << c;
  EXPECT_NEAR(flux(parse_ldt(ldt(1, {0}, 1), "x")), 4 * std::numbers::pi * 200, 1e-9);
  EXPECT_EQ(full.opening.size, Vec3(0.2f, 0.5f, 0));
  EXPECT_EQ(*full.stated, 1600);
}

TEST(Formats, BadEulumdatIsOneLineThatNamesThePlace) {
  const std::string good = ldt(0, {0, 90, 180, 270}, 4);
  const auto with_line = [&](int line, const std::string& to) {
    std::vector<std::string> lines = lines_of(good);
    lines[static_cast<std::size_t>(line) - 1] = to;
    try {
      parse_ldt(join(lines, "\n"), "lamp.ldt");
    } catch (const Error& e) {
      return std::string(e.what());
    }
    return std::string("no error");
  };
  EXPECT_EQ(with_line(29, "x"),
            "lamp.ldt:29: 'x' stands where the lamps' luminous flux should (allowed: a number)");
  EXPECT_EQ(with_line(29, "0"),
            "lamp.ldt:29: the lamps' luminous flux is not positive (allowed: lumens > 0: intensities are per "
            "1000 of them)");
  EXPECT_EQ(with_line(26, "99"), "lamp.ldt:26: the number of lamp sets is '99' (allowed: 1 to 20)");
  EXPECT_EQ(with_line(4, "0.5"),
            "lamp.ldt:4: the number of C planes, Mc is 0.5 (allowed: a whole number from 1 to 3600)");
  EXPECT_EQ(
      with_line(6, "-3"),
      "lamp.ldt:6: the number of intensities in a plane, Ng is -3 (allowed: a whole number from 1 to 3600)");
  EXPECT_EQ(with_line(45, "10"), "lamp.ldt:45: C angle 3 of 4 is not above the one before");
  EXPECT_EQ(with_line(16, "-5"), "lamp.ldt:21: the luminous area has a negative size (allowed: millimetres)");
  EXPECT_EQ(with_line(49, "200"), "lamp.ldt:49: G angles leave the range (allowed: 0 to 180)");
  std::string cut = good.substr(0, good.size() - 4);
  try {
    parse_ldt(cut, "lamp.ldt");
    FAIL();
  } catch (const Error& e) {
    EXPECT_STREQ(e.what(), "lamp.ldt:60: ends before intensity 12 of 12");
  }
  EXPECT_THROW(parse_ldt("maker\n7\n0\n4\n", "x"), NotMyFormat);
}

// Whatever is cut off or overwritten, the reader answers with an error or a lamp of finite light.
TEST(Formats, DamagedFilesNeverCrash) {
  SCONCE_NEEDS_DATA(folder());
  for (const char* name : {"ies/ies_rescale/Type C - 05.IES", "ies/ies_rescale/Type C - Annotated.ies",
                           "ldt/eulumdat-ugr/input/sample_05.ldt", "ies/mdl-sdk/test.ies"}) {
    const std::string text = read_file(folder() / name);
    uint32_t state = 1;
    for (int trial = 0; trial < 2000; ++trial) {
      std::string damaged = text.substr(0, trial % 2 == 0 ? text.size() : text.size() * (trial % 997) / 997);
      for (int i = 0; i < trial % 4 && !damaged.empty(); ++i) {
        state = state * 1664525u + 1013904223u;
        damaged[state % damaged.size()] = "0919- .ex\n"[(state >> 20) % 10];
      }
      try {
        const Photometry lamp = name[0] == 'l' ? parse_ldt(damaged, "x") : parse_ies(damaged, "x");
        EXPECT_TRUE(std::isfinite(flux(lamp)) && flux(lamp) >= 0);
      } catch (const Error& e) {
        EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
      }
    }
  }
}

}  // namespace
}  // namespace sconce
