// SPDX-License-Identifier: Apache-2.0
// Lamps of a package that become others.
#include "relight_run.h"

namespace sconce {
namespace {

// A lamp that becomes another one is that lamp, new, where the old one was, in the fader's strength; what it
// was leaves the layer.
TEST_F(Relight, ALampBecomesAnother) {
  make_room(test::two_lamp_court());
  folder.write("lamp.ies", test::kPhotometricLamp);
  Image slide = Image::rgb(2, 2);
  slide.set_rgb(1, 0, {1, 0.5f, 0.2f});
  write_exr(folder.path() / "slide.exr", slide, PixelType::full);
  const std::string left = "lamp left", place = "0,1.4,0.2";
  const struct {
    std::string kind, own;
  } kKinds[] = {{"point,lumens=90,color=1,1,1", ""},
                {"spot,outer=40,intensity=60,kelvin=3000", ",direction=0,-1,0"},
                {"sun,direction=0.1,-1,0,intensity=90,kelvin=5500", ""},
                {"area,size=0.4,0.2,lumens=50,kelvin=3000", ",direction=0,-1,0"},
                {"projector,file=" + file("slide.exr") + ",lumens=50,color=1,1,1", ",direction=0,-1,0"},
                {"luminaire,file=" + file("lamp.ies") + ",kelvin=3000", ",direction=0,-1,0"}};
  for (const auto& [kind, own] : kKinds) {
    expect_done(run(picture("relight", "became.exr",
                            {"right=off", "left=50%", "--move", left + "=" + place, "--kind",
                             left + "=" + kind, "--device", "cpu"})));
    expect_done(
        run(picture("relight", "new.exr",
                    {"--others", "off", "--light", kind + own + ",position=0,1.39,0.2", "--device", "cpu"})));
    EXPECT_GT(mean("new.exr"), 0) << kind;
    EXPECT_NEAR(mean("became.exr") / mean("new.exr"), 0.5, 1e-4) << kind;
  }
  // Of its own flux and colour, where it stands.
  expect_done(run(picture("relight", "own.exr", {"--others", "off", "left=on", "--kind", "left=point"})));
  expect_done(run(
      picture("relight", "light.exr",
              {"--others", "off", "--light", "point,position=-0.6,1.97,0,lumens=12.8467,color=30,25,18"})));
  EXPECT_NEAR(mean("own.exr") / mean("light.exr"), 1, 0.01);
  for (const std::string wrong :
       {"lamp left=", "lamp left", "lamp left=lantern", "lift=point", "left=luminaire,file=none.ies"})
    EXPECT_EQ(run(picture("relight", "x.exr", {"--kind", wrong})).code, 2) << wrong;
}

}  // namespace
}  // namespace sconce
