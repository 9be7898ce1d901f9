// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <atomic>

#include "gather/lit_scene.h"
#include "scene/shapes.h"
#include "solve/timing.h"

namespace sconce {
namespace {

/// Takes 50 us for each sample, by its own clock.
class PatientSolver final : public Solver {
 public:
  void solve(const Footprint&, std::span<GroupValue>) const override { ticks_ += samples_; }
  bool set_samples(int samples) override {
    samples_ = samples;
    return true;
  }
  double now() const { return 50e-6 * static_cast<double>(ticks_.load()); }

 private:
  int samples_ = 0;
  mutable std::atomic<int64_t> ticks_ = 0;
};

TEST(SamplesWithin, FitsTheTime) {
  Scene scene;
  add_box(scene, "room", add_material(scene, "white", Rgb(0.7f), Rgb(1)), Vec3(0), Vec3(1), true);
  const LitAtlas lit(std::move(scene), Grouping::one, 32);
  PatientSolver solver;
  const auto samples = [&](double seconds) {
    return samples_within(seconds, solver, lit.receivers, 1, [&] { return solver.now(); });
  };
  for (const double seconds : {30.0, 300.0}) {
    const double all = seconds / (50e-6 * static_cast<double>(lit.receivers.size()));
    EXPECT_LE(samples(seconds), all);
    EXPECT_NEAR(samples(seconds), 0.93 * all, 0.03 * all + kBatches);
    EXPECT_EQ(samples(seconds) % kBatches, 0);
  }
  EXPECT_EQ(samples(1e-9), kBatches) << "there is no less";
  EXPECT_EQ(samples(0), kBatches) << "what came before took all the time";
}

TEST(SecondsFor, AllReceivers) {
  Scene scene;
  add_box(scene, "room", add_material(scene, "white", Rgb(0.7f), Rgb(1)), Vec3(0), Vec3(1), true);
  const LitAtlas lit(std::move(scene), Grouping::one, 32);
  PatientSolver solver;
  solver.set_samples(100);
  EXPECT_NEAR(seconds_for(solver, lit.receivers, 1, [&] { return solver.now(); }),
              100 * 50e-6 * static_cast<double>(lit.receivers.size()), 1e-6);
}

}  // namespace
}  // namespace sconce
