// SPDX-License-Identifier: Apache-2.0
// Operators by both methods against closed forms; numbers refer to the analytic tests in docs/methods.md.
#include <gtest/gtest.h>

#include <numeric>

#include "core/error.h"
#include "core/sobol.h"
#include "core/test_folder.h"
#include "gather/lit_scene.h"
#include "gather/rows.h"
#include "relight/chapter_operator.h"
#include "relight/cloud_photons.h"
#include "scene/shapes.h"
#include "transfer/folded_bounces.h"

namespace sconce {
namespace {

/// A scene with its cloud in a square.
struct CloudRig : LitScene {
  std::unique_ptr<GatherCloud> cloud;
  CloudSquare square;

  CloudRig(Scene s, std::size_t slots) : LitScene(std::move(s), Grouping::one) {
    cloud = make_cloud_of(scene, world, tracer, {}, slots, 1);
    square =
        make_cloud_square(*cloud, slots, std::vector<uint8_t>(cloud->size(), 1), world.bounds.diagonal());
  }
  TracedScene traced() const { return {scene, world, tracer}; }
  SurfacePoint at(uint32_t slot) const {
    const uint32_t sample = square.samples[slot];
    return cloud->point(sample, cloud->footprint(sample), Vec2(0.5f));
  }
};

Scene sphere(const Rgb& albedo) {
  Scene scene;
  add_sphere(scene, "shell", add_material(scene, "paint", albedo), Vec3(0), 1, 96, true);
  return scene;
}

Scene box(const Rgb& albedo) {
  Scene scene;
  add_box(scene, "room", add_material(scene, "paint", albedo), Vec3(0), Vec3(1), true);
  return scene;
}

double sum(std::span<const SparseEntry> row) {
  return std::accumulate(row.begin(), row.end(), 0.0,
                         [](double s, const SparseEntry& e) { return s + static_cast<double>(e.value); });
}

// 6. Inside a sphere M's rows sum to rho / (1 - rho), with few photons too: the furthest is left out. The
// light of a cap comes with a deviation of 1 / sqrt(photons that are its).
TEST(CloudPhotons, RowsOfASphere) {
  const float rho = 0.7f;
  const CloudRig rig(sphere(Rgb(rho)), 1024);
  const CloudPhotons photons(rig.traced(), *rig.cloud, rig.square, 250000, 1);
  EXPECT_NEAR(static_cast<double>(photons.landings()), 250000 / 0.3, 0.01 * 250000 / 0.3);
  for (const std::size_t k : {20u, 200u}) {
    double mean = 0, cap = 0, squares = 0;
    for (uint32_t slot = 0; slot < 1024; ++slot) {
      std::vector<SparseEntry> row;
      const Rgb colour = photons.row(rig.at(slot), k, row);
      EXPECT_NEAR(colour.r, 1, 1e-5f);
      mean += static_cast<double>(rho) * sum(row) / 1024;
      std::erase_if(row, [&](const SparseEntry& e) { return rig.at(e.index).position.y < 0.5f; });
      const double part = sum(row);
      cap += part / 1024, squares += part * part / 1024;
    }
    const double all = static_cast<double>(rho) / 0.3;
    EXPECT_NEAR(mean, all, 0.015 * all) << k;
    EXPECT_NEAR(cap, 0.25 / 0.3, 0.05 * 0.25 / 0.3) << "a quarter of the sphere lies above one half";
    const double deviation = std::sqrt(squares - cap * cap) / cap;
    // Of the k photons a quarter is the cap's: 1 / sqrt(k / 4), the disk's own size included.
    EXPECT_NEAR(deviation, 1 / std::sqrt(0.25 * static_cast<double>(k)), 0.25 * deviation) << k;
  }
}

// Coloured walls: even light comes back in the colours that all bounces by rays have, too.
TEST(CloudPhotons, ColoursOfARedAndGreenBox) {
  Scene scene;
  const auto red = add_material(scene, "red", Rgb(0.8f, 0.1f, 0.1f)),
             green = add_material(scene, "green", Rgb(0.1f, 0.7f, 0.1f));
  add_box(scene, "left", red, Vec3(0), Vec3(1), true);
  add_quad(scene, "curtain", green, Vec3(0.01f, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1));
  const CloudRig rig(std::move(scene), 1024);
  const CloudPhotons photons(rig.traced(), *rig.cloud, rig.square, 400000, 1);
  const SparseRows rows = gather(rig.world, rig.tracer, *rig.cloud, 256, 1, {}).rows;
  std::vector<float> once(3 * rig.cloud->size());
  for (std::size_t i = 0; i < rig.cloud->size(); ++i) {
    float value = 0;
    const std::vector<float> ones(rig.cloud->size(), 1.0f);
    rows.apply(i, ones, std::span(&value, 1));
    for (std::size_t c = 0; c < 3; ++c) once[3 * i + c] = value;
  }
  const std::vector<float> all = bounce(rows, *rig.cloud, once, 40);
  std::array<double, 3> have{}, want{};
  for (uint32_t slot = 0; slot < 1024; ++slot) {
    std::vector<SparseEntry> row;
    const Rgb colour = photons.row(rig.at(slot), 100, row), e = colour * static_cast<float>(sum(row));
    have[0] += static_cast<double>(e.r), have[1] += static_cast<double>(e.g);
    have[2] += static_cast<double>(e.b);
    for (std::size_t c = 0; c < 3; ++c) want[c] += static_cast<double>(all[3 * rig.square.samples[slot] + c]);
  }
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(have[c] / want[c], 1, 0.03) << c;
  EXPECT_GT(want[0], 1.5 * want[2]);
}

// 4. What the middle of a floor sees of a ceiling: Lambert's four corners (methods.md 10). Patches are points
// spread evenly over the walls of a box.
TEST(PointFactors, OfACeiling) {
  constexpr uint32_t kOnAWall = 1024;
  const LitScene lit(box(Rgb(0.5f)), Grouping::one);
  std::vector<OperatorPoint> points;
  for (int wall = 0; wall < 6; ++wall)
    for (uint32_t i = 0; i < kOnAWall; ++i) {
      const Vec2 u = sobol_pair(i, 0, static_cast<uint32_t>(wall));
      Vec3 p, n(0);
      p[wall / 2] = wall % 2 == 0 ? 0.0f : 1.0f;
      n[wall / 2] = wall % 2 == 0 ? 1.0f : -1.0f;
      p[(wall / 2 + 1) % 3] = u.x, p[(wall / 2 + 2) % 3] = u.y;
      points.push_back({{p.x, p.y, p.z}, pack_normal(n), pack_normal(n), {}});
    }
  Operator op;
  op.points_per_slot = 1, op.lit = points;
  const PointFactors factors(lit.tracer, op, std::vector<float>(points.size(), 1.0f / kOnAWall));
  const auto seen = [&](const Vec3& from, double& ceiling) {
    std::vector<SparseEntry> row;
    factors.row({from, Vec3(0, 1, 0), Vec3(0, 1, 0)}, row);
    ceiling = 0;
    for (const SparseEntry& e : row)
      if (e.index / kOnAWall == 3) ceiling += static_cast<double>(e.value);
    return sum(row);
  };
  double ceiling = 0;
  EXPECT_NEAR(seen(Vec3(0.5f, 0, 0.5f), ceiling), 1, 0.01) << "a closed box";
  const double a = 0.5 / std::sqrt(1.25), expected = 4 / static_cast<double>(kPi) * a * std::atan(a);
  EXPECT_NEAR(ceiling, expected, 1e-3 * expected);
  const double corner = seen(Vec3(0.002f, 0, 0.002f), ceiling);
  EXPECT_LT(corner, 0.9) << "the clamp costs light where patches are near";
  EXPECT_GT(corner, 0.3);
}

/// Even light of 1 lm/m2 from all slots, through an operator and back from its file.
std::vector<Rgb> furnace(const LitAtlas& lit, const TransferParams& params) {
  const TracedScene traced{lit.scene, lit.world, lit.tracer};
  const Operator made = make_operator(traced, texel_receivers(traced, lit.atlas), params, "scene");
  TemporaryFolder folder;
  write_operator(folder / "op.bin", made);
  const Operator op = open_operator(folder / "op.bin");
  std::vector<Rgbx> light(op.slots(), Rgbx{1, 1, 1, 0}), swept = light;
  std::vector<Rgb> out(op.gather.rows);
  FoldedBounces(op).indirect(light, out);
  const std::vector<Rgb> by_sweeps = indirect_light(op, swept);
  for (std::size_t i = 0; i < out.size(); ++i)
    EXPECT_NEAR(out[i].r, by_sweeps[i].r, 2e-3f * out[i].r) << "all bounces at once or one by one";
  return out;
}

// 1. F (M + I) 1 = 1 / (1 - rho).
TEST(TransferOperator, Furnace) {
  const LitAtlas lit(box(Rgb(0.75f, 0.5f, 0.2f)), Grouping::one, 32);
  for (const TransferMethod method : {TransferMethod::fitted, TransferMethod::chapter}) {
    TransferParams params;
    params.method = method;
    params.gather = 1024, params.cluster = 64, params.photons = 200000;
    if (method == TransferMethod::chapter) params.coefficients = 100, params.bounce_coefficients = 40;
    const std::vector<Rgb> out = furnace(lit, params);
    double red = 0, green = 0, blue = 0;
    for (const Rgb& e : out) {
      red += static_cast<double>(e.r), green += static_cast<double>(e.g), blue += static_cast<double>(e.b);
    }
    const auto n = static_cast<double>(out.size());
    // Photons see less than half a disk in corners, and form factors are clamped there.
    const double tolerance = method == TransferMethod::fitted ? 0.03 : 0.12;
    EXPECT_NEAR(red / n, 4, 4 * tolerance);
    EXPECT_NEAR(green / n, 2, 2 * tolerance);
    EXPECT_NEAR(blue / n, 1.25, 1.25 * tolerance);
  }
}

TEST(TransferOperator, WrongNumbersAreNamed) {
  const auto said = [](const auto& change) {
    TransferParams params;
    change(params);
    try {
      check(params);
    } catch (const UsageError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_NE(said([](auto& p) { p.gather = 1000; }).find("--gather': 1000 samples"), std::string::npos);
  EXPECT_NE(said([](auto& p) { p.gather = 512; }).find("a power of four: 256"), std::string::npos);
  EXPECT_NE(said([](auto& p) { p.photons = 0; }).find("--photons"), std::string::npos);
  EXPECT_NE(said([](auto& p) { p.nearest = 0; }).find("--nearest"), std::string::npos);
  EXPECT_EQ(said([](auto&) {}), "");
}

}  // namespace
}  // namespace sconce
