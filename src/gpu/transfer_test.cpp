// SPDX-License-Identifier: Apache-2.0
// The operator on the device against the CPU's.
#include "gpu/transfer.h"

#include "core/error.h"
#include "gpu/test_context.h"
#include "transfer/folded_bounces.h"
#include "transfer/test_operator.h"

namespace sconce::gpu {
namespace {

/// Lit in a few runs of slots, as by a spot.
std::vector<Rgbx> lit_cloud(uint32_t slots) {
  MadeUp numbers;
  std::vector<Rgbx> light(slots, Rgbx{});
  for (uint32_t i = 0; i < slots; ++i)
    if (i / 37 % 5 == 0) light[i] = {100 * numbers.unit(), 60, 10 * numbers.unit(), 0};
  return light;
}

class TransferTest : public GlTest {
 protected:
  void expect_cpu(const Operator& op) {
    std::vector<Rgbx> light = lit_cloud(op.slots());
    const Transfer device(context_, op);
    device.exitance().write(std::span(light).size_bytes(), light.data());
    device.apply();
    const std::vector<Rgb> seen = device.read();
    std::vector<Rgb> expected(op.gather.rows);
    FoldedBounces(op).indirect(light, expected);
    ASSERT_EQ(seen.size(), expected.size());
    float largest = 0;
    for (const Rgb& e : expected) largest = std::max({largest, e.r, e.g, e.b});
    ASSERT_GT(largest, 0);
    for (std::size_t i = 0; i < seen.size(); ++i)
      for (const auto channel : {&Rgb::r, &Rgb::g, &Rgb::b})
        ASSERT_NEAR(seen[i].*channel, expected[i].*channel, 1e-4f * largest) << "row " << i;
  }
};

// Squares that need one, two and three runs of the transform, and rows that fill neither blocks nor clusters.
TEST_F(TransferTest, IsTheCpus) {
  for (const uint32_t slots : {256u, 1024u, 4096u, 65536u}) {
    SCOPED_TRACE(slots);
    expect_cpu(
        made_up_operator({.slots = slots, .cluster = 64, .coefficients = 100, .bounce_coefficients = 40}));
  }
  expect_cpu(made_up_operator({.receivers = 16, .slots = 1024, .bounces = false}));
  expect_cpu(made_up_operator({.receivers = 999,
                               .slots = 1024,
                               .plain = true,
                               .cluster = 16,
                               .first_cluster = 16,
                               .node_cluster = 1024}));
  expect_cpu(made_up_operator(
      {.receivers = 17, .slots = 4096, .slots_per_node = 16, .first_cluster = 64, .node_cluster = 128}));
}

TEST_F(TransferTest, SameBitsEveryTime) {
  const Operator op = made_up_operator({.receivers = 500, .slots = 4096});
  const Transfer device(context_, op);
  const std::vector<Rgbx> light = lit_cloud(op.slots());
  device.exitance().write(std::span(light).size_bytes(), light.data());
  device.apply();
  const std::vector<Rgb> once = device.read();
  device.apply();
  EXPECT_EQ(device.read(), once);
}

TEST_F(TransferTest, TooLargeForTheDeviceSaysSo) {
  Capabilities small = context_.capabilities();
  small.max_buffer = 1000;
  context_.pretend(small);
  try {
    const Transfer device(context_, made_up_operator({.receivers = 100, .slots = 1024}));
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("the operator's rows: "), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("up to 1000"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace sconce::gpu
