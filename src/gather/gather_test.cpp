// SPDX-License-Identifier: Apache-2.0
// Cells, owners and rows, against closed forms; numbers refer to the analytic tests in docs/methods.md.
#include <gtest/gtest.h>

#include "core/parallel.h"
#include "core/sobol.h"
#include "gather/lit_scene.h"
#include "gather/rows.h"
#include "scene/shapes.h"
#include "transfer/haar.h"

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

/// Lit by two bulbs, a group each.
struct ColouredRoom : Rig {
  std::vector<float> direct;  ///< samples x 3 groups, lux
  static constexpr std::size_t kGroups = 2;

  ColouredRoom() : Rig(coloured_room(), 900) {
    const Vec3 bulbs[kGroups] = {Vec3(-0.5f, 1.6f, 0.2f), Vec3(0.7f, 0.4f, 0.6f)};
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const SurfacePoint p = cloud.footprint(i).sample(Vec2(0.5f));
      for (std::size_t g = 0; g < kGroups; ++g) {
        const Vec3 to = bulbs[g] - p.position;
        const float d = glm::length(to), cosine = glm::dot(to, p.geometric_normal) / d;
        const bool dark =
            !(cosine > 0) || tracer.occluded({offset_origin(p.position, p.geometric_normal, to), to / d, d});
        const float lux = dark ? 0 : 100 * cosine / (d * d);
        direct.insert(direct.end(), {lux, g == 0 ? lux : 0.5f * lux, 0.8f * lux});
      }
    }
  }
  /// What the solver `radiosity` does with it: light on cells, one reflection by the rows' rays, sweeps.
  struct Solved {
    SparseRows rows;
    std::vector<float> once, all;  ///< as `direct`
  };
  Solved solve(int bounces) const {
    std::vector<float> cells(3 * kGroups * cloud.cells());
    for (uint32_t c = 0; c < cloud.cells(); ++c)
      std::copy_n(&direct[3 * kGroups * cloud.owner(c).sample], 3 * kGroups, &cells[3 * kGroups * c]);
    DirectLight light;
    light.groups = kGroups, light.on_cells = cells;
    light.make_at_point = [this]() -> DirectAtPoint {
      return [this](const SurfacePoint& at, uint32_t, std::span<double> sums) {
        const auto sample = ownership(at);
        for (std::size_t k = 0; sample && k < sums.size(); ++k)
          sums[k] += static_cast<double>(direct[sums.size() * *sample + k]);
      };
    };
    Solved out;
    Gathered gathered = gather(world, tracer, cloud, 64, 1, light);
    out.once = std::move(gathered.once), out.rows = std::move(gathered.rows);
    out.all = bounce(out.rows, cloud, out.once, bounces);
    return out;
  }
  /// Sample that speaks for a point of a surface.
  std::optional<uint32_t> ownership(const SurfacePoint& at) const {
    const Hit hit = tracer.closest({at.position + 1e-3f * at.geometric_normal, -at.geometric_normal});
    return hit ? cloud.speaker(at, cloud.cell(hit)) : std::nullopt;
  }
};

// 5 and 22: a group by the operator, v_i = F wt(..), all coefficients of all rows kept in full, is the
// group's radiosity by the same cloud and rays; and both groups together are their sum.
TEST(Bounces, OnAllWaveletCoefficientsAreTheRadiosity) {
  constexpr uint32_t kSlots = 1024;
  constexpr int kBounces = 7;
  const ColouredRoom room;
  const std::size_t n = room.cloud.size();
  ASSERT_LE(n, kSlots);
  const ColouredRoom::Solved solved = room.solve(kBounces);
  std::vector<std::vector<SparseEntry>> rows(n);
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<SparseEntry> row;
    for (uint64_t k = solved.rows.first[i]; k < solved.rows.first[i + 1]; ++k)
      row.push_back({solved.rows.columns[k], static_cast<float>(solved.rows.counts[k]) * solved.rows.unit});
    haar_forward(row, kSlots, rows[i]);
  }
  const auto relight = [&](float left, float right) {
    std::vector<Rgb> e(n);
    std::vector<Rgbx> first(kSlots, Rgbx{});
    const std::size_t width = 3 * ColouredRoom::kGroups;
    for (std::size_t i = 0; i < n; ++i) {
      const float *a = &room.direct[width * i], *b = a + 3;
      const Rgb lux(left * a[0] + right * b[0], left * a[1] + right * b[1], left * a[2] + right * b[2]);
      const Rgb out = room.cloud.albedo(i) * lux;
      first[i] = {out.r, out.g, out.b, 0};
    }
    std::vector<Rgbx> light = first;
    for (int bounces = 0; bounces < kBounces; ++bounces) {
      haar_forward(light);
      for (std::size_t i = 0; i < n; ++i) {
        std::array<double, 3> sum{};  // light and dark coefficients cancel
        for (const SparseEntry& c : rows[i])
          for (std::size_t k = 0; k < 3; ++k)
            sum[k] += static_cast<double>(c.value) * static_cast<double>(light[c.index][k]);
        e[i] = Rgb(static_cast<float>(sum[0]), static_cast<float>(sum[1]), static_cast<float>(sum[2]));
      }
      light = first;
      for (std::size_t i = 0; i < n; ++i) {
        const Rgb out = room.cloud.albedo(i) * e[i];
        light[i][0] += out.r, light[i][1] += out.g, light[i][2] += out.b;
      }
    }
    return e;
  };
  const std::vector<Rgb> left = relight(1, 0), right = relight(0, 1), both = relight(2, 3);
  for (std::size_t i = 0; i < n; ++i) {
    const float* want = &solved.all[3 * ColouredRoom::kGroups * i];
    const Rgb a(want[0], want[1], want[2]), b(want[3], want[4], want[5]);
    for (const auto channel : {&Rgb::r, &Rgb::g, &Rgb::b}) {
      EXPECT_NEAR(left[i].*channel, a.*channel, 1e-5f * a.max()) << i;
      EXPECT_NEAR(right[i].*channel, b.*channel, 1e-5f * b.max()) << i;
      EXPECT_NEAR(both[i].*channel, 2 * left[i].*channel + 3 * right[i].*channel, 1e-5f * both[i].max()) << i;
    }
  }
}

// 7. What a sweep changes is no more than the largest albedo of what the last one did.
TEST(Bounces, SweepsContractByTheAlbedo) {
  const ColouredRoom room;
  const ColouredRoom::Solved solved = room.solve(0);
  std::vector<float> before = bounce(solved.rows, room.cloud, solved.once, 1);
  double last = 1e30;
  for (int bounces = 2; bounces < 12; ++bounces) {
    const std::vector<float> now = bounce(solved.rows, room.cloud, solved.once, bounces);
    double change = 0;
    for (std::size_t k = 0; k < now.size(); ++k)
      change = std::max(change, std::abs(static_cast<double>(now[k] - before[k])));
    EXPECT_LE(change, 0.7 * last * (1 + 1e-4)) << bounces;
    EXPECT_GT(change, 0);
    last = change, before = now;
  }
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
