// SPDX-License-Identifier: Apache-2.0
// The lamps of the virtual bench, as light fields, and the rooms.
#include <gtest/gtest.h>

#include "luminaires.h"
#include "measure/field.h"
#include "measure/virtual_bench.h"
#include "scene/groups.h"
#include "vaults.h"

namespace sconce::demo {
namespace {

std::vector<SourceRay> rays_of(Scene scene, uint64_t count) {
  assign_groups(scene, Grouping::automatic);
  const World world = make_world(scene);
  BenchParams params;
  params.rays = count;
  return trace_luminaire(scene, world, Tracer(scene, world), Lamps(scene, world), params);
}

MeasuredField field_of(Scene scene, double spacing, double angle) {
  const auto rays = rays_of(std::move(scene), 100000);
  FieldParams params;
  params.basis = NearBasis::bell;
  params.spacing = spacing;
  params.angle = angle;
  params.pixels = 32;
  return measure_field([&](const auto& f) { f(rays); }, params, "lamp");
}

TEST(NearScenes, LampsHaveThePapersGrids) {
  struct Case {
    Scene scene;
    double spacing;
    int columns, rows;
    double lumens;  ///< before losses
  };
  for (const Case& c :
       {Case{make_torch(), 0.01, 5, 5, 30}, Case{make_torch(), 0.005, 7, 7, 30},
        Case{make_bicycle_light(), 0.0075, 9, 7, 60}, Case{make_louvre(), 0.02, 11, 11, 1200}}) {
    const MeasuredField m = field_of(c.scene, c.spacing, 55);
    EXPECT_EQ(m.field.columns, c.columns) << c.scene.name;
    EXPECT_EQ(m.field.rows, c.rows) << c.scene.name;
    EXPECT_NEAR(flux(m.field), m.kept, 1e-5 * m.kept);
    EXPECT_GT(m.kept, 0.3 * c.lumens) << c.scene.name;
    EXPECT_LT(m.kept + m.lost, c.lumens) << c.scene.name;
  }
}

TEST(NearScenes, RoomsHaveThePapersSizes) {
  EXPECT_NEAR(static_cast<double>(make_world(make_crypt()).size()), 500, 10);
  EXPECT_NEAR(static_cast<double>(make_world(make_cloister()).size()), 8000, 400);
}

}  // namespace
}  // namespace sconce::demo
