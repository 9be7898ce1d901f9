// SPDX-License-Identifier: Apache-2.0
// A small version of the bar: our bake against path-traced references by another renderer. The full one is
// `reference_table` on bakes at --density 40.
#include <gtest/gtest.h>

#include "bake_job.h"
#include "core/test_data.h"
#include "process.h"
#include "reference.h"

namespace sconce {
namespace {

void check(const std::string& scene, float density, int samples, double most_rmse) {
  const auto glb = test_data() / "glb" / (scene + ".glb"), references = test_data() / "reference";
  SCONCE_NEEDS_DATA(glb);
  SCONCE_NEEDS_DATA(references);
  const TemporaryFolder folder;
  app::BakeJob job;
  job.scene = glb;
  job.atlas.density = density;
  job.params.samples = samples;
  const app::PreparedBake bake(job, {});
  BakeState state = BakeState::create(folder / "state", bake.header());
  app::run_bake(bake, {}, state, {});
  app::write_result(bake, std::span(&state, 1), folder / "p.sconce", {}, {});
  const Package package = Package::open(folder / "p.sconce");
  const auto rows = test::compare_to_references(package, scene, references, 32);
  EXPECT_EQ(rows.size(), bake.scene.groups.size());
  for (const auto& row : rows) {
    EXPECT_NEAR(row.mean_ratio, 1, 0.015) << row.group;
    EXPECT_LT(row.rmse, most_rmse) << row.group;
  }
}

TEST(Reference, CornellBox) {
  check("cornell-box", 40, 256, 0.05);
}
TEST(Reference, CornellTwoLights) {
  check("cornell-two-lights", 40, 256, 0.05);
}

}  // namespace
}  // namespace sconce
