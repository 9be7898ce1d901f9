// SPDX-License-Identifier: Apache-2.0
#include "import/mtl.h"

#include <gtest/gtest.h>

namespace sconce {
namespace {

PlainMaterial of(const std::string& property) {
  return parse_mtl("newmtl a b\n" + property).at(0);
}

TEST(Mtl, ColoursAndOpacity) {
  EXPECT_EQ(of("").name, "a b");
  EXPECT_EQ(of("").diffuse, Rgb(0.6f));
  EXPECT_EQ(of("KD 0.1 .2 3e-1 # red").diffuse, (Rgb{0.1f, 0.2f, 0.3f}));
  EXPECT_EQ(of("Kd 0.5").diffuse, Rgb(0.5f)) << "red alone speaks for all";
  EXPECT_EQ(of("Ke 17 12 4").emissive, (Rgb{17, 12, 4}));
  EXPECT_EQ(of("d 0.25").opacity, 0.25f);
  EXPECT_EQ(of("Tr 0.25").opacity, 0.75f);
}

TEST(Mtl, DamagedPropertiesAreLeftOut) {
  for (const char* bad :
       {"Kd", "Kd 1 2", "Kd 1 0 x", "Kd 0,5 0 0", "Kd spectral a.rfl 1", "Kd nan 0 0", "Kd 1e99 0 0"})
    EXPECT_EQ(of(bad).diffuse, Rgb(0.6f)) << bad;
  EXPECT_EQ(of("d -halo 0.5").opacity, 1);
  EXPECT_TRUE(parse_mtl("Kd 1 0 0\nmap_Kd x.png\nnewmtl\nd 0\n").empty()) << "before the first name";
}

TEST(Mtl, MapsAndTheirOptions) {
  const auto map = [](const char* rest) { return of(std::string("map_Kd ") + rest).diffuse_map; };
  EXPECT_EQ(map("a picture.png").file, "a picture.png");
  EXPECT_EQ(map("-clamp on -s 2 2 -o 0.5 -mm 0 1 -bm 3 tiles/x y.png").file, "tiles/x y.png");
  EXPECT_TRUE(map("-clamp on x.png").clamped);
  EXPECT_FALSE(map("-clamp off x.png").clamped);
  EXPECT_EQ(map("-blendu on -t 1 1 1 4.png").file, "4.png");
  EXPECT_EQ(map("-odd.png").file, "-odd.png");
  EXPECT_EQ(map("").file, "");
  EXPECT_EQ(of("map_Ke e.png").emissive_map.file, "e.png");
  EXPECT_EQ(of("map_d d.png").opacity_map.file, "d.png");
}

TEST(Mtl, TheSameNameIsTheSameMaterial) {
  const auto all = parse_mtl("newmtl a\nKd 1 0 0\nnewmtl b\nnewmtl a\nKe 1 1 1\n");
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].diffuse, (Rgb{1, 0, 0}));
  EXPECT_EQ(all[0].emissive, Rgb(1));
}

}  // namespace
}  // namespace sconce
