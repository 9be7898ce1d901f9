// SPDX-License-Identifier: Apache-2.0
// The operator without compression against radiosity by the same cloud and rays; numbers refer to the
// analytic tests in docs/methods.md.
#include <gtest/gtest.h>

#include "core/test_folder.h"
#include "gather/lit_scene.h"
#include "gather/rows.h"
#include "relight/exact_operator.h"
#include "relight/operator_start.h"
#include "relight/row_maker.h"
#include "relight/texel_light.h"
#include "transfer/folded_bounces.h"

namespace sconce {
namespace {

/// By a bulb and a spot, a group each.
Scene lit_room() {
  Scene scene = coloured_room();
  Light bulb;
  bulb.name = bulb.group_name = "bulb";
  bulb.intensity = Rgb(100, 80, 60);
  bulb.frame[3] = glm::vec4(-0.5f, 1.6f, 0.2f, 1);
  Light spot;
  spot.name = spot.group_name = "spot";
  spot.intensity = Rgb(200, 220, 300);
  spot.shape = SpotLight{.inner = 0.3f, .outer = 0.6f};
  spot.frame = look_at(Vec3(0.7f, 1.7f, 0.6f), Vec3(0.3f, 0, 0)).frame;
  scene.lights = {bulb, spot};
  return scene;
}

/// A room with its exact operator, as 'transfer' writes and 'relight' reads it.
struct Room : LitAtlas {
  TransferParams params;
  RelightReceivers receivers;
  Operator op;

  Room() : LitAtlas(lit_room(), Grouping::automatic, 32) {
    params.method = TransferMethod::exact;
    params.gather = 1024, params.rays = 128;
    receivers = texel_receivers(traced(), atlas);
    TemporaryFolder folder;
    write_operator(folder / "op.bin", make_operator(traced(), receivers, params, "scene"));
    op = open_operator(folder / "op.bin");
  }
  TracedScene traced() const { return {scene, world, tracer}; }
  /// b_d of a group.
  std::vector<Rgbx> direct(std::size_t group) const {
    const MovedGroup all{Id<LightGroup>(group), Rgb(1)};
    return light_cloud(op, MovedLamps(scene, world, tracer, {}, {&all, 1}));
  }
  std::vector<Rgb> relit(std::vector<Rgbx> light) const {
    std::vector<Rgb> out(op.gather.rows);
    FoldedBounces(op).indirect(light, out);
    return out;
  }
};

/// What the solver `radiosity` makes of light on the cloud: its own rows and sweeps, then one ray after the
/// other from the receivers.
std::vector<Rgb> radiosity(const Room& room, std::span<const Rgbx> light) {
  const OperatorStart start(room.traced(), room.receivers, room.params, ClusterRows::kLanes, {});
  const GatherCloud& cloud = *start.cloud;
  const std::size_t n = cloud.size();
  std::vector<float> direct(3 * n), once(3 * n);
  for (std::size_t slot = 0; slot < light.size(); ++slot)
    for (std::size_t c = 0; c < 3; ++c) {
      const uint32_t sample = start.square.samples[slot];
      direct[3 * sample + c] += light[slot][c] / static_cast<float>(start.square.of(sample).size());
    }
  const SparseRows rows = gather(room.world, room.tracer, cloud, room.params.rays, room.params.seed, {}).rows;
  for (std::size_t i = 0; i < n; ++i) rows.apply(i, direct, std::span(once).subspan(3 * i, 3));
  const std::vector<float> all = bounce(rows, cloud, once, static_cast<int>(room.op.sweeps));
  std::vector<Rgb> out;
  for (const uint32_t receiver : start.order) {
    const ReceiverRays from(room.receivers, receiver, room.params.seed);
    double sum[3] = {0, 0, 0};
    for (uint32_t r = 0; r < static_cast<uint32_t>(room.params.rays); ++r) {
      const auto end = follow_row_ray(room.world, room.tracer, cloud, from(r), r, from.stream,
                                      [](const SurfacePoint&, uint32_t, uint32_t, const Rgb&) {});
      if (!end) continue;
      const Rgb& albedo = cloud.albedo(end->sample);
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t k = 3 * end->sample + c;
        sum[c] += static_cast<double>(direct[k] + (&albedo.r)[c] * all[k]) / room.params.rays;
      }
    }
    out.emplace_back(static_cast<float>(sum[0]), static_cast<float>(sum[1]), static_cast<float>(sum[2]));
  }
  return out;
}

// 5, 22 and 34: with all coefficients kept, same cloud and rays, a group relit is the group's radiosity, and
// two groups are their sum, to float rounding.
TEST(ExactOperator, AGroupRelitIsItsRadiosity) {
  const Room room;
  ASSERT_EQ(room.scene.groups.size(), 2u);
  std::vector<std::vector<Rgb>> relit;
  for (std::size_t g = 0; g < 2; ++g) {
    const std::vector<Rgbx> light = room.direct(g);
    relit.push_back(room.relit(light));
    const std::vector<Rgb> want = radiosity(room, light);
    for (std::size_t i = 0; i < want.size(); ++i)
      for (const auto channel : {&Rgb::r, &Rgb::g, &Rgb::b})
        ASSERT_NEAR(relit[g][i].*channel, want[i].*channel, 1e-5f * want[i].*channel) << g << " " << i;
  }
  std::vector<Rgbx> both = room.direct(0);
  const std::vector<Rgbx> other = room.direct(1);
  for (std::size_t slot = 0; slot < both.size(); ++slot)
    for (std::size_t c = 0; c < 3; ++c) both[slot][c] += other[slot][c];
  const std::vector<Rgb> sum = room.relit(both);
  for (std::size_t i = 0; i < sum.size(); ++i)
    for (const auto channel : {&Rgb::r, &Rgb::g, &Rgb::b})
      ASSERT_NEAR(sum[i].*channel, relit[0][i].*channel + relit[1][i].*channel, 1e-5f * sum[i].*channel) << i;
}

// Sixteen of all its coefficients are a way from it.
TEST(ExactOperator, FewerCoefficientsAreOther) {
  const Room room;
  std::vector<Rgbx> light = room.direct(0);
  const std::vector<Rgb> all = room.relit(light);
  Operator fewer = room.op;
  std::vector<float> values(room.op.gather.basis.values.begin(), room.op.gather.basis.values.end());
  for (std::size_t block = 0; block < fewer.gather.basis.blocks(); ++block)
    for (std::size_t k = fewer.gather.basis.first[block] + 16; k < fewer.gather.basis.first[block + 1]; ++k)
      std::fill_n(values.begin() + static_cast<std::ptrdiff_t>(16 * k), 16, 0.0f);
  fewer.gather.basis.values = values;
  std::vector<Rgb> out(all.size());
  FoldedBounces(fewer).indirect(light, out);
  double error = 0, mean = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    error += std::abs(static_cast<double>(out[i].g - all[i].g));
    mean += static_cast<double>(all[i].g);
  }
  EXPECT_GT(error, 0.02 * mean);
}

}  // namespace
}  // namespace sconce
