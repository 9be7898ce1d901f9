// SPDX-License-Identifier: Apache-2.0
// Cells, owners and rows, against closed forms; numbers refer to the analytic tests in docs/methods.md.
#include <gtest/gtest.h>

#include "core/parallel.h"
#include "core/sobol.h"
#include "gather/lit_scene.h"
#include "gather/rows.h"
#include "scene/shapes.h"

namespace sconce {
namespace {

/// A scene with its cloud.
struct Rig : LitScene {
  GatherCloud cloud;

  Rig(Scene s, std::size_t samples)
      : LitScene(std::move(s), Grouping::one), cloud(scene, world, tracer, lamps, {}, {samples, 1}) {}

  SparseRows rows(int rays) const { return gather(world, tracer, cloud, rays, 1, {}).rows; }
  double area() const {
    double sum = 0;
    for (std::size_t i = 0; i < cloud.size(); ++i) sum += static_cast<double>(cloud.area(i));
    return sum;
  }
};

Scene box(const Rgb& albedo = Rgb(0.5f)) {
  Scene scene;
  add_box(scene, "room", add_material(scene, "grey", albedo), Vec3(0), Vec3(1, 1, 1), true);
  return scene;
}

TEST(SurfaceCells, CoverEverySideOnceAndFindTheirOwnPoints) {
  Scene scene = box();
  add_quad(scene, "sheet", add_material(scene, "paper", Rgb(0.8f), {}, true), Vec3(0.2f, 0.5f, 0.2f),
           Vec3(0.5f, 0, 0), Vec3(0, 0.1f, 0.4f));
  const World world = make_world(scene);
  std::vector<double> mass(2 * world.size());
  for (uint32_t s = 0; s < mass.size(); ++s) mass[s] = 1 + s % 5;
  const SurfaceParts parts = make_parts(scene, world, mass, 100);
  EXPECT_GT(parts.size(), world.size() + 50);
  mass.assign(parts.size(), 1.0);
  mass[3] = 200;
  const SurfaceCells cells = make_cells(world, parts, mass, 1000);
  double area = 0, expected = 6 + 2 * 0.5 * std::hypot(0.1, 0.4);
  for (uint32_t c = 0; c < cells.size(); ++c) {
    area += static_cast<double>(cells.area(world, c));
    const auto [a, b, d] = cells.corners(c);
    ASSERT_EQ(cells.at(cells.side(c), 0.4f * a + 0.35f * b + 0.25f * d), c);
    const FootprintPiece piece = cells.piece(world, c);
    ASSERT_NEAR(glm::length(glm::cross(piece.p1 - piece.p0, piece.p2 - piece.p0)) / 2, cells.area(world, c),
                1e-4f * cells.area(world, c));
  }
  EXPECT_NEAR(area, expected, 1e-4 * expected);
  EXPECT_FALSE(cells.reflects(side_index(0, true))) << "the wall's back";
}

TEST(GatherCloud, SamplesShareOutTheSurface) {
  const Rig rig(box(Rgb(0.2f, 0.4f, 0.6f)), 600);
  EXPECT_NEAR(rig.area(), 6, 1e-4);
  EXPECT_NEAR(static_cast<double>(rig.cloud.size()), 600, 120);
  EXPECT_GT(rig.cloud.share(Trust::whole), 0.99);
  EXPECT_EQ(rig.cloud.share(Trust::guess), 0);
  for (std::size_t i = 0; i < rig.cloud.size(); ++i) {
    EXPECT_NEAR(rig.cloud.albedo(i).g, 0.4f, 1e-6f);
    const Footprint footprint = rig.cloud.footprint(i);
    EXPECT_NEAR(footprint.area, rig.cloud.area(i), 1e-5f);
    for (const FootprintPiece& piece : footprint.pieces)
      EXPECT_EQ(piece.geometric_normal, footprint.pieces[0].geometric_normal) << "round a corner";
  }
}

// A slab of one centimetre between two rooms, and a crate on the floor whose inside nothing sees.
TEST(GatherCloud, NoSampleSpeaksThroughAThinWall) {
  Scene scene;
  const auto white = add_material(scene, "white", Rgb(0.8f));
  add_box(scene, "left", white, Vec3(-2, 0, 0), Vec3(-0.005f, 2, 2), true);
  add_box(scene, "right", white, Vec3(0.005f, 0, 0), Vec3(2, 2, 2), true);
  add_quad(scene, "floor", white, Vec3(-2, 0.001f, 0), Vec3(0, 0, 2), Vec3(4, 0, 0));
  add_box(scene, "crate", add_material(scene, "wood", Rgb(0.6f), {}, true), Vec3(0.7f, -0.1f, 0.7f),
          Vec3(1.3f, 0.5f, 1.3f), false);
  const Rig rig(std::move(scene), 500);
  const auto room = [](const Vec3& p) {
    const Vec3 from_crate = glm::abs(p - Vec3(1, 0.2f, 1)) - Vec3(0.3f);
    return from_crate.x < 1e-4f && from_crate.y < 1e-4f && from_crate.z < 1e-4f ? 2 : p.x < 0 ? 0 : 1;
  };
  int seen = 0;
  for (uint32_t i = 0; i < 20000; ++i) {
    Sampler sampler(3, 0, i);
    const Vec2 u = sampler.next(), v = sampler.next();
    const Vec3 from = i % 2 == 0 ? Vec3(-0.1f - 1.8f * u.x, 0.6f + u.y, 1)
                                 : Vec3(0.72f + 0.56f * u.x, 0.45f * u.y + 0.01f, 1);
    const Vec3 direction = glm::normalize(Vec3(v.x - 0.5f, v.y - 0.5f, u.x * v.y - 0.3f));
    const Hit hit = rig.tracer.closest({from, direction});
    if (!hit || !rig.cloud.reflects(hit)) continue;
    const auto speaker = rig.cloud.speaker(surface_point(rig.world, hit), rig.cloud.cell(hit));
    if (!speaker) continue;
    ++seen;
    const Vec3 at = rig.world.position(hit.triangle, hit.barycentric) - 0.001f * direction;
    const Footprint footprint = rig.cloud.footprint(*speaker);
    for (const FootprintPiece& piece : footprint.pieces) {
      const Vec3 p = (piece.p0 + piece.p1 + piece.p2) / 3.0f + 0.0005f * piece.geometric_normal;
      ASSERT_EQ(room(p), room(at)) << p.x << " " << p.y << " " << p.z << " for " << at.x << " " << at.y << " "
                                   << at.z;
    }
  }
  EXPECT_GT(seen, 15000);
}

// 4. Opposite and adjacent faces of a cube: F = 0.19982 and 0.20004.
TEST(GatherRows, FormFactorsOfACube) {
  const Rig rig(box(), 600);
  const SparseRows rows = rig.rows(512);
  const auto face = [&](std::size_t i) {
    const Vec3 n = rig.cloud.footprint(i).pieces[0].geometric_normal;
    for (int axis = 0; axis < 3; ++axis)
      if (std::abs(n[axis]) > 0.5f) return 2 * axis + (n[axis] > 0 ? 1 : 0);
    return -1;
  };
  double factors[6][6] = {};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    uint32_t sum = 0;
    for (uint64_t k = rows.first[i]; k < rows.first[i + 1]; ++k) {
      sum += rows.counts[k];
      factors[face(i)][face(rows.columns[k])] +=
          static_cast<double>(rig.cloud.area(i)) * static_cast<double>(rows.counts[k] * rows.unit);
    }
    EXPECT_EQ(sum, 512u) << "a closed box: all rays end on samples";
  }
  for (int a = 0; a < 6; ++a)
    for (int b = 0; b < 6; ++b)
      EXPECT_NEAR(factors[a][b], a == b ? 0 : a / 2 == b / 2 ? 0.19982 : 0.20004, 0.002) << a << " " << b;
}

// Inside a sphere a point sends as much to all equal areas: K_ij = A_j / A.
TEST(GatherRows, SphereIsUniform) {
  Scene scene;
  add_sphere(scene, "shell", add_material(scene, "white", Rgb(0.6f)), Vec3(0), 1, 48, true);
  const Rig rig(std::move(scene), 400);
  const SparseRows rows = rig.rows(8192);
  std::vector<double> columns(rig.cloud.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (uint64_t k = rows.first[i]; k < rows.first[i + 1]; ++k)
      columns[rows.columns[k]] +=
          static_cast<double>(rows.counts[k] * rows.unit) / static_cast<double>(rows.size());
  double worst = 0, area = rig.area();
  for (std::size_t j = 0; j < columns.size(); ++j)
    worst = std::max(worst, std::abs(columns[j] * area / static_cast<double>(rig.cloud.area(j)) - 1));
  EXPECT_LT(worst, 0.05);
}

// 1. Furnace: all bounces of uniform light E are E r / (1 - r), and enough of them stop in time.
TEST(Bounces, Furnace) {
  const Rgb albedo(0.9f, 0.5f, 0.1f);
  const Rig rig(box(albedo), 300);
  const SparseRows rows = rig.rows(64);
  std::vector<float> once(3 * rig.cloud.size());
  for (std::size_t i = 0; i < rig.cloud.size(); ++i)
    once[3 * i] = albedo.r, once[3 * i + 1] = albedo.g, once[3 * i + 2] = albedo.b;
  const int enough = enough_bounces(rows, rig.cloud);
  EXPECT_NEAR(enough, std::log(1e-3 * (1 - 0.9)) / std::log(0.9), 2);
  const std::vector<float> all = bounce(rows, rig.cloud, once, enough);
  for (std::size_t i = 0; i < rig.cloud.size(); ++i) {
    EXPECT_NEAR(all[3 * i], 0.9 / 0.1, 0.012);
    EXPECT_NEAR(all[3 * i + 1], 1, 1e-4);
    EXPECT_NEAR(all[3 * i + 2], 0.1 / 0.9, 1e-5);
  }
  EXPECT_EQ(bounce(rows, rig.cloud, once, 0), std::vector<float>(once.size()));
  EXPECT_EQ(bounce(rows, rig.cloud, once, 1), once);
}

TEST(GatherRows, SameBitsAtAnyNumberOfThreads) {
  SparseRows rows[2];
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    const Rig rig(box(), 300);
    rows[threads - 1] = rig.rows(64);
  }
  EXPECT_EQ(rows[0].first, rows[1].first);
  EXPECT_EQ(rows[0].columns, rows[1].columns);
  EXPECT_EQ(rows[0].counts, rows[1].counts);
}

}  // namespace
}  // namespace sconce
