// SPDX-License-Identifier: Apache-2.0
#include "receive/atlas.h"

#include <gtest/gtest.h>

#include <map>

#include "core/error.h"
#include "core/parallel.h"
#include "receive/raster.h"
#include "receive/test_scene.h"

namespace sconce {
namespace {

/// A room of 4 x 3 x 4 m with a lamp below the ceiling, a ball and a camera inside.
TestScene room(bool double_sided) {
  TestScene s;
  const Id<Material> wall = add_material(s.scene, "wall", Rgb(0.5f), {}, double_sided);
  const Id<Material> lamp = add_material(s.scene, "lamp", Rgb(0.5f), Rgb(10.0f));
  add_box(s.scene, "room", wall, Vec3(0), Vec3(4, 3, 4), true);
  add_sphere(s.scene, "ball", wall, Vec3(1.5f, 1, 2), 0.4f, 16, false);
  add_quad(s.scene, "lamp", lamp, Vec3(1.5f, 2.9f, 1.5f), Vec3(1, 0, 0), Vec3(0, 0, 1));
  s.look(Vec3(3.8f, 1.5f, 3.8f), Vec3(1, 1, 1), 1.5f);
  s.finish();
  return s;
}

/// Chart of every texel (0 = none) by the same rule as the receivers; counts texels that two charts share.
std::vector<uint32_t> owners(const Atlas& atlas, int page, std::size_t& shared) {
  std::vector<uint32_t> owner(static_cast<std::size_t>(atlas.width) * static_cast<std::size_t>(atlas.height),
                              0);
  for (const auto* sides : {&atlas.front, &atlas.back})
    for (const TexelTriangle& t : *sides)
      if (t.page == page)
        cover_texels(t.uv, atlas.width, atlas.height, [&](int x, int y) {
          uint32_t& o = owner[static_cast<std::size_t>(y) * static_cast<std::size_t>(atlas.width) +
                              static_cast<std::size_t>(x)];
          if (o != 0 && o != t.chart + 1) ++shared;
          o = t.chart + 1;
        });
  return owner;
}

void expect_gutters(const Atlas& atlas, int gutter) {
  for (int page = 0; page < atlas.pages; ++page) {
    std::size_t shared = 0, close = 0, border = 0;
    const auto owner = owners(atlas, page, shared);
    const auto at = [&](int x, int y) {
      return owner[static_cast<std::size_t>(y) * static_cast<std::size_t>(atlas.width) +
                   static_cast<std::size_t>(x)];
    };
    for (int y = 0; y < atlas.height; ++y)
      for (int x = 0; x < atlas.width; ++x) {
        if (at(x, y) == 0) continue;
        if (x == 0 || y == 0 || x == atlas.width - 1 || y == atlas.height - 1) ++border;
        for (int v = y; v <= std::min(y + gutter, atlas.height - 1); ++v)
          for (int u = std::max(0, x - gutter); u <= std::min(x + gutter, atlas.width - 1); ++u)
            if (at(u, v) != 0 && at(u, v) != at(x, y)) ++close;
      }
    EXPECT_EQ(shared, 0u);
    EXPECT_EQ(close, 0u);
    EXPECT_EQ(border, 0u);
  }
}

TEST(Atlas, DensityAreaWindingAndGutters) {
  TestScene s = room(true);
  s.unwrap(40);
  double area = 0;
  for (std::size_t t = 0; t < s.world.size(); ++t) {
    area += static_cast<double>(s.world.area(t));
    ASSERT_GE(s.atlas.front[t].page, 0);
    EXPECT_GT(signed_area(s.atlas.front[t].uv), 0.0f);
    EXPECT_EQ(s.atlas.back[t].page, -1);  // nobody sees the walls from outside, nor the ball from within
  }
  EXPECT_NEAR(flat_area(s.atlas.front) / (area * 1600), 1.0, 5e-3);
  EXPECT_GT(s.atlas.report.charts, 6u);
  EXPECT_LT(s.atlas.report.stretch_mean, 1.05);
  expect_gutters(s.atlas, 2);
  AtlasParams params;
  params.density = 25;
  params.gutter = 4;
  s.unwrap(params);
  expect_gutters(s.atlas, 4);
}

TEST(Atlas, OnePageIsFilled) {
  TestScene s = room(false);
  AtlasParams params;
  params.page_size = 256;
  s.unwrap(params);
  EXPECT_EQ(s.atlas.pages, 1);
  EXPECT_EQ(s.atlas.width, 256);
  const TexelReceivers receivers(s.world, *s.tracer, s.atlas);
  EXPECT_GT(s.atlas.report.utilisation, 0.6);
  expect_gutters(s.atlas, 2);
}

TEST(Atlas, SmallPagesMakeMany) {
  TestScene s = room(false);
  AtlasParams params;
  params.density = 40;
  params.page_size = 256;
  s.unwrap(params);
  EXPECT_GT(s.atlas.pages, 1);
  EXPECT_EQ(s.atlas.width, 256);
  EXPECT_NEAR(flat_area(s.atlas.front), 1600 * (2 * (16 + 12 + 12) + 4 * 3.14159 * 0.16 + 1), 2000);
  expect_gutters(s.atlas, 2);
}

TEST(Atlas, TooSmallAPageIsRefused) {
  TestScene s = room(false);
  AtlasParams params;
  params.page_size = 16;
  for (int i = 0; i < 100; ++i)
    add_quad(s.scene, "leaf", Id<Material>(0), Vec3(1, 1, 0.02f * static_cast<float>(i)), Vec3(0.3f, 0, 0),
             Vec3(0, 0.3f, 0));
  s.finish();
  EXPECT_THROW(s.unwrap(params), Error);
  EXPECT_THROW(s.unwrap(0.0f), UsageError);
  EXPECT_THROW(s.unwrap(-1.0f), UsageError);
}

TEST(Atlas, FreeStandingSheetGetsATwinWhereItIsDoubleSided) {
  for (const bool double_sided : {true, false}) {
    TestScene s = room(double_sided);
    add_quad(s.scene, "sheet", Id<Material>(0), Vec3(2.5f, 0.5f, 1), Vec3(1, 0, 0), Vec3(0, 1, 0));
    s.finish();
    s.unwrap(40);
    const std::size_t n = s.world.size();
    EXPECT_EQ(s.atlas.report.twins, double_sided ? 2u : 0u);
    for (const std::size_t t : {n - 2, n - 1}) {
      EXPECT_EQ(s.atlas.back[t].page >= 0, double_sided);
      EXPECT_EQ(s.atlas.reached_back[t], 1);
      if (!double_sided) continue;
      EXPECT_LT(signed_area(s.atlas.back[t].uv), 0.0f);  // in front order: unmirrored from behind
      EXPECT_NE(s.atlas.back[t].chart, s.atlas.front[t].chart);
    }
  }
}

TEST(Atlas, WhatNobodySeesIsCoarse) {
  TestScene s = room(true);
  add_quad(s.scene, "ground", Id<Material>(0), Vec3(-30, -1, 30), Vec3(60, 0, 0), Vec3(0, 0, -60));
  s.finish();
  s.unwrap(40);
  const std::size_t n = s.world.size();
  const float scale = std::sqrt(signed_area(s.atlas.front[n - 1].uv) / s.world.area(n - 1)) / 40;
  EXPECT_NEAR(scale, 1.0f / 16, 0.01f);
  const float wall = std::sqrt(signed_area(s.atlas.front[0].uv) / s.world.area(0)) / 40;
  EXPECT_NEAR(wall, 1.0f, 0.01f);
}

TEST(Atlas, LightmapScaleOfAnInstanceCounts) {
  TestScene s = room(true);
  s.scene.instances[1].lightmap_scale = 2;
  s.finish();
  s.unwrap(40);
  double flat = 0, area = 0;
  for (std::size_t t = 0; t < s.world.size(); ++t) {
    if (s.world.instances[t].value != 1) continue;
    flat += static_cast<double>(signed_area(s.atlas.front[t].uv));
    area += static_cast<double>(s.world.area(t));
  }
  EXPECT_NEAR(std::sqrt(flat / area), 80, 2);
}

TEST(Atlas, SameForAnyNumberOfThreads) {
  TestScene s = room(true);
  const auto take = [&](int threads) {
    const ThreadLimit limit(threads);
    s.unwrap(30);
    const TexelReceivers receivers(s.world, *s.tracer, s.atlas);
    std::vector<float> all;
    for (const TexelTriangle& t : s.atlas.front)
      for (const Vec2& p : t.uv) all.insert(all.end(), {p.x, p.y, static_cast<float>(t.chart)});
    for (std::size_t i = 0; i < receivers.size(); ++i) all.push_back(static_cast<float>(receivers.texel(i)));
    return all;
  };
  EXPECT_EQ(take(1), take(2));
}

TEST(Atlas, TwistedAndDegenerateInputEndsSomehow) {
  TestScene s;
  const Id<Material> grey = add_material(s.scene, "grey", Rgb(0.5f), {}, true);
  Mesh mesh;
  mesh.material = grey;
  mesh.positions = {{0, 0, 0},       {1, 0, 0},     {0, 1, 0},    {1, 1, 0},
                    {0.5f, 0.5f, 1}, {1e-9f, 0, 0}, {1, 1e-7f, 0}};
  mesh.normals.assign(7, Vec3(0, 0, 1));
  // Twice the same, turned over, three at one edge, zero area, thin as a hair.
  mesh.triangles = {{{0, 1, 2}}, {{0, 1, 2}}, {{0, 2, 1}}, {{1, 2, 3}}, {{1, 2, 4}},
                    {{2, 1, 4}}, {{0, 0, 1}}, {{0, 1, 5}}, {{0, 1, 6}}};
  s.scene.meshes.push_back(mesh);
  s.scene.instances.emplace_back();
  s.scene.instances.back().mesh = Id<Mesh>(0);
  s.look(Vec3(0, 0, 3), Vec3(0));
  s.finish();
  s.unwrap(20);
  const TexelReceivers receivers(s.world, *s.tracer, s.atlas);
  EXPECT_GT(receivers.size(), 0u);
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    const Footprint f = receivers.footprint(i);
    ASSERT_FALSE(f.pieces.empty());
    EXPECT_GT(f.area, 0.0f);
  }
}

}  // namespace
}  // namespace sconce
