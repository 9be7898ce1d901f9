// SPDX-License-Identifier: Apache-2.0
// `sconce luminaire` on several files, on rays in watts, and with a scene before the wall.
#include <gtest/gtest.h>

#include "core/test_data.h"
#include "core/test_folder.h"
#include "image/io.h"
#include "process.h"

namespace sconce {
namespace {

using test::run_sconce;

// A plate halfway throws a shadow of twice its size; beside it nothing changes. C0 is +x, C90 is up in the
// picture and -z in the scene.
TEST(LuminaireLamps, RenderBehindAScene) {
  const TemporaryFolder folder;
  const std::string ies =
      folder
          .write("point.ies", "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 9\n0 180\n0\n100 100\n")
          .string();
  const std::string plate =
      folder.write("plate.obj", "v 0 -0.5 0\nv 0.2 -0.5 0\nv 0.2 -0.5 -0.1\nv 0 -0.5 -0.1\nf 1 2 3 4\n")
          .string();
  const auto picture = [&](std::vector<std::string> more) {
    const std::string out = (folder / "wall.exr").string();
    std::vector<std::string> words = {"luminaire", "render", ies, "--width", "1", "--size", "20", "-o", out};
    words.insert(words.end(), more.begin(), more.end());
    EXPECT_EQ(run_sconce(words).code, 0);
    return read_exr(out);
  };
  const Image open = picture({}), shaded = picture({"--scene", plate, "--shadow-rays", "4"});
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 20; ++x) {
      const bool dark = x >= 10 && x < 18 && y < 10 && y >= 6;  // 0 to 0.4 m, 0 to 0.2 m
      const double want = dark ? 0 : static_cast<double>(open.rgb_at(x, y).g);
      EXPECT_NEAR(static_cast<double>(shaded.rgb_at(x, y).g), want, 1e-4 * (1 + want)) << x << " " << y;
    }
}

TEST(LuminaireLamps, BrokenOnesAndWatts) {
  const auto data = test_data() / "photometry";
  SCONCE_NEEDS_DATA(data);
  // A broken file among others is told; the others are checked.
  const auto among =
      run_sconce({"luminaire", "check", (data / "ies/ies_rescale/Truncated Profile - 01.IES").string(),
                  (data / "ldt/eulumdat-py/sample4.ldt").string()});
  EXPECT_EQ(among.code, 1);
  EXPECT_NE(among.err.find("Truncated Profile - 01.IES:25: ends before"), std::string::npos) << among.err;
  EXPECT_NE(among.out.find("sample4.ldt: 5543.9 lm, rendered 5543.9 lm"), std::string::npos) << among.out;
  const auto watts =
      run_sconce({"luminaire", "field", (data / "tm25/CreatePointSourceRayFile/farfield.TM25ray").string(),
                  "-o", "x.exr"});
  EXPECT_EQ(watts.code, 2);
  EXPECT_NE(watts.err.find("--lumens: is needed"), std::string::npos) << watts.err;
}

}  // namespace
}  // namespace sconce
