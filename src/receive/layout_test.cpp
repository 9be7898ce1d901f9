// SPDX-License-Identifier: Apache-2.0
#include "receive/layout.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "receive/test_scene.h"

namespace sconce {
namespace {

Atlas double_sided_box(TestScene& s) {
  add_box(s.scene, "box", add_material(s.scene, "wall", Rgb(0.5f), {}, true), Vec3(0), Vec3(2, 1, 1), true);
  s.look(Vec3(1.9f, 0.5f, 0.9f), Vec3(0), 1.5f);
  s.finish();
  AtlasParams params;
  params.page_size = 64;
  return make_atlas(s.scene, s.world, *s.tracer, params);
}

TEST(Layout, ComesBackWhole) {
  TestScene s;
  const Atlas atlas = double_sided_box(s);
  const std::string bytes = pack_layout(atlas);
  const Atlas again = unpack_layout(bytes, s.world.size(), "here");
  ASSERT_EQ(again.front.size(), atlas.front.size());
  for (std::size_t t = 0; t < atlas.front.size(); ++t)
    for (const auto& [a, b] : {std::pair(atlas.front[t], again.front[t]), {atlas.back[t], again.back[t]}}) {
      EXPECT_EQ(a.page, b.page);
      if (a.page < 0) continue;
      EXPECT_EQ(a.uv, b.uv);
      EXPECT_EQ(a.chart, b.chart);
      EXPECT_EQ(a.importance, b.importance);
    }
  EXPECT_EQ(again.reached_back, atlas.reached_back);
  EXPECT_EQ(again.seen_charts, atlas.seen_charts);
  EXPECT_EQ(again.density, atlas.density);
  EXPECT_EQ(again.report.charts, atlas.report.charts);
  EXPECT_EQ(pack_layout(again), bytes);
}

TEST(Layout, RefusesWhatIsNotWhole) {
  TestScene s;
  const std::string bytes = pack_layout(double_sided_box(s));
  EXPECT_THROW(unpack_layout(bytes, s.world.size() + 1, "here"), Error);
  for (const std::size_t size : {std::size_t{0}, std::size_t{20}, bytes.size() / 2, bytes.size() - 1})
    EXPECT_THROW(unpack_layout(bytes.substr(0, size), s.world.size(), "here"), Error) << size;
  EXPECT_THROW(unpack_layout(bytes + "x", s.world.size(), "here"), Error);
  try {
    unpack_layout("sconcel1" + bytes.substr(8), s.world.size(), "here");
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("earlier version"), std::string::npos);
  }
}

}  // namespace
}  // namespace sconce
