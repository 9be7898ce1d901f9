// SPDX-License-Identifier: Apache-2.0
// Photometric files: other people's, and small ones with known answers.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/files.h"
#include "core/test_data.h"
#include "photometry/formats.h"

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
            "lamp.ies:4: the photometric type is 4.000000 (allowed: a whole number from 1 to 3)");
  EXPECT_EQ(with("0 90\n", "90 0\n"), "lamp.ies:7: horizontal angle 2 of 2 is not above the one before");
  EXPECT_EQ(with("0 90\n", "0 45\n"),
            "lamp.ies:7: horizontal angles reach from 0 to 45 (allowed: from 0 to 0, 90, 180 or 360, or from "
            "90 to 270)");
  EXPECT_EQ(with("0 180\n", "0 200\n"),
            "lamp.ies:6: vertical angles reach from 0 to 200 (allowed: 0 to 180 for type C)");
  EXPECT_EQ(with("101 101", "101 nan"),
            "lamp.ies:9: 'nan' stands where candela value 4 of 4 should (allowed: a number)");
  EXPECT_EQ(with("101 101\n", ""), "lamp.ies:8: ends before candela value 3 of 4");
  EXPECT_EQ(with("TILT=NONE", "TILT=lamp.tlt"),
            "lamp.ies: TILT file 'lamp.tlt' is not there (allowed: TILT=NONE, TILT=INCLUDE or a file beside "
            "this one)");
  EXPECT_EQ(with("1 1000 2", "1 1000 -2"),
            "lamp.ies:4: the candela multiplier is not positive (allowed: a factor > 0)");
  EXPECT_THROW(parse_ies("solid\n", "x"), NotMyFormat);
  EXPECT_THROW(parse_ldt("solid\n", "x"), NotMyFormat);
  EXPECT_THROW(parse_ies("IESNA:LM-63-2002\n[TEST]", "x"), Error);
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
