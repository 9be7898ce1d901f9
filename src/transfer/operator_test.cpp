// SPDX-License-Identifier: Apache-2.0
// Fitted rows, and operators made by hand whose answers are known.
#include "transfer/operator.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "core/error.h"
#include "core/files.h"
#include "core/parallel.h"
#include "core/sobol.h"
#include "core/test_data.h"
#include "core/test_folder.h"
#include "transfer/folded_bounces.h"
#include "transfer/test_operator.h"

namespace sconce {
namespace {

constexpr uint32_t kSlots = 256;

/// Boxes of light along the square, as lamps make.
std::vector<float> lamp(uint32_t seed) {
  std::vector<float> light(kSlots, 0.0f);
  const Vec2 u = sobol_pair(seed, 0, 5);
  const auto from = static_cast<uint32_t>(u.x * 200), size = 8 + static_cast<uint32_t>(u.y * 100);
  for (uint32_t k = from; k < std::min(kSlots, from + size); ++k) light[k] = 1;
  return light;
}

TrainingLight training() {
  std::vector<std::vector<float>> lights;
  for (uint32_t t = 0; t < 64; ++t) {
    lights.push_back(lamp(t));
    haar_forward(lights.back());
  }
  return TrainingLight(std::move(lights));
}

/// Rows of sum 1: a bump that moves with the row.
std::vector<SparseEntry> bump(uint32_t row, uint32_t rows) {
  std::vector<SparseEntry> entries;
  float sum = 0;
  for (uint32_t c = 0; c < kSlots; ++c) {
    const float d =
        (static_cast<float>(c) - 256.0f * static_cast<float>(row) / static_cast<float>(rows)) / 90;
    entries.push_back({c, std::exp(-d * d)});
    sum += entries.back().value;
  }
  for (SparseEntry& e : entries) e.value /= sum;
  return entries;
}

ClusterRowsBuilder::Result make_rows(uint32_t rows, uint32_t columns, const TrainingLight& light,
                                     std::size_t coefficients) {
  ClusterRowsBuilder builder(rows, light, {32, coefficients});
  for (std::size_t c = 0; c < builder.clusters(); ++c) {
    std::vector<std::vector<SparseEntry>> made;
    for (uint32_t r = static_cast<uint32_t>(32 * c);
         r < std::min<uint32_t>(rows, static_cast<uint32_t>(32 * c) + 32); ++r) {
      made.push_back(bump(r, rows));
      if (columns < kSlots)
        std::erase_if(made.back(), [&](const SparseEntry& e) { return e.index >= columns; });
    }
    builder.set_cluster(c, made);
  }
  return builder.finish();
}

std::vector<Rgb> product(const ClusterRows& rows, const std::vector<float>& light) {
  std::vector<Rgbx> square;
  for (const float v : light) square.push_back({v, 0.5f * v, 0, 0});
  haar_forward(square);
  std::vector<Rgb> out(rows.rows);
  multiply(rows, square, out);
  return out;
}

double exact(uint32_t row, uint32_t rows, const std::vector<float>& light) {
  double sum = 0;
  for (const SparseEntry& e : bump(row, rows)) sum += static_cast<double>(e.value * light[e.index]);
  return sum;
}

// 22. Few coefficients answer lamps that no row was fitted to; all of them but for quantisation.
TEST(ClusterRows, AnswerLampsTheyDoNotKnow) {
  const TrainingLight light = training();
  double before = 1e30;
  for (const std::size_t coefficients : {16u, 64u, 256u}) {
    const auto made = make_rows(80, kSlots, light, coefficients);
    double squares = 0, expected = 0, sum = 0;
    for (uint32_t seed = 1000; seed < 1020; ++seed) {
      const std::vector<Rgb> out = product(made.rows, lamp(seed));
      for (uint32_t r = 0; r < 80; ++r) {
        const double want = exact(r, 80, lamp(seed));
        squares += std::pow(static_cast<double>(out[r].r) - want, 2), expected += want * want;
        sum += static_cast<double>(out[r].r) - want;
        EXPECT_FLOAT_EQ(out[r].g, 0.5f * out[r].r);
      }
    }
    const double error = std::sqrt(squares / expected);
    EXPECT_LT(error, before) << coefficients;
    EXPECT_LT(std::abs(sum) / std::sqrt(expected * 1600), 0.02);
    before = error;
  }
  EXPECT_LT(before, 0.02);
}

// 24. What sixteen basis rows leave of the training lights' answers is what the singular values beyond the
// sixteenth say (Eckart and Young 1936), but for quantisation, where all rows count as they are.
TEST(ClusterRows, LeaveWhatTheSingularValuesSay) {
  constexpr uint32_t kRows = 32;
  const TrainingLight light = training();
  std::vector<std::vector<SparseEntry>> rows(kRows);
  for (uint32_t r = 0; r < kRows; ++r)
    for (uint32_t c = 0; c < kSlots; ++c)
      rows[r].push_back({c, (sobol_pair(c, 0, 100 + r).x - 0.5f) / kSlots});
  ClusterRowsBuilder builder(kRows, light, {.cluster = kRows, .coefficients = kSlots, .evenness = 0});
  builder.set_cluster(0, rows);
  const auto made = builder.finish();
  Eigen::MatrixXd exact(kRows, light.count()), seen(kRows, light.count());
  for (std::size_t t = 0; t < light.count(); ++t) {
    std::vector<float> square;
    for (uint32_t c = 0; c < kSlots; ++c) square.push_back(light.at_column(c)[t]);
    const std::vector<Rgb> out = product(made.rows, square);
    for (uint32_t r = 0; r < kRows; ++r) {
      double sum = 0;
      for (const SparseEntry& e : rows[r]) sum += static_cast<double>(e.value * square[e.index]);
      const auto row = static_cast<Eigen::Index>(r), lamp = static_cast<Eigen::Index>(t);
      exact(row, lamp) = sum, seen(row, lamp) = static_cast<double>(out[r].r);
    }
  }
  const Eigen::VectorXd values = Eigen::JacobiSVD<Eigen::MatrixXd>(exact).singularValues();
  const double left = values.tail(kRows - static_cast<Eigen::Index>(ClusterRows::kRank)).squaredNorm();
  EXPECT_GT(left, 1e-4 * values.squaredNorm()) << "else quantisation hides it";
  EXPECT_NEAR((exact - seen).squaredNorm() / left, 1, 0.05);
}

// Rows that see little light among brighter ones, more than a basis can hold, are not given up: a lamp that
// none was fitted to finds most of its light there.
TEST(ClusterRows, DimRowsKeepTheirLight) {
  constexpr uint32_t kRows = 64;
  const TrainingLight light = training();
  const auto is_dim = [](uint32_t r) { return r % 4 == 0; };
  std::vector<std::vector<SparseEntry>> rows(kRows);
  for (uint32_t r = 0; r < kRows; ++r) {
    rows[r] = bump(r, kRows);
    for (uint32_t c = 0; c < kSlots; ++c)
      if (!is_dim(r)) rows[r][c].value += 20 * sobol_pair(c, 0, 100 + r).x / kSlots;
  }
  const auto error_of_dim = [&](float evenness) {
    ClusterRowsBuilder builder(kRows, light,
                               {.cluster = kRows, .coefficients = kSlots, .evenness = evenness});
    builder.set_cluster(0, rows);
    const auto made = builder.finish();
    double squares = 0, expected = 0;
    for (uint32_t seed = 1000; seed < 1020; ++seed) {
      const std::vector<Rgb> out = product(made.rows, lamp(seed));
      for (uint32_t r = 0; r < kRows; ++r) {
        if (!is_dim(r)) continue;
        const double want = exact(r, kRows, lamp(seed));
        squares += std::pow(static_cast<double>(out[r].r) - want, 2), expected += want * want;
      }
    }
    return std::sqrt(squares / expected);
  };
  EXPECT_LT(error_of_dim(0.7f), 0.3 * error_of_dim(0));
}

TEST(ClusterRows, SameBitsAtAnyNumberOfThreads) {
  const TrainingLight light = training();
  std::vector<Rgb> results[2];
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    results[threads - 1] = product(make_rows(80, kSlots, light, 64).rows, lamp(7));
  }
  EXPECT_EQ(results[0], results[1]);
}

/// Two rows per slot's node; albedo one half in red, none in blue.
class OperatorTest : public testing::Test {
 protected:
  OperatorTest() : light_(training()), coarse_(coarse_light()) {
    gather_ = make_rows(40, kSlots, light_, kSlots);
    first_ = make_rows(16, kSlots, light_, kSlots);
    bounce_ = make_rows(16, 16, coarse_, 16);
    op.gather = gather_.rows, op.first = first_.rows, op.bounce = bounce_.rows;
    albedo_.assign(16, Rgbx{0.5f, 0.25f, 0, 0});
    op.albedo = albedo_;
    op.width = 8, op.height = 5, op.pages = 1;
    op.scene = "scene", op.options = "by hand";
    op.points_per_slot = 1;
    lit_.assign(kSlots, OperatorPoint{{1, 2, 3}, pack_normal({0, 1, 0}), pack_normal({0, 1, 0}), {}});
    receivers_.assign(40, lit_[0]);
    for (uint32_t i = 0; i < 40; ++i) places_.push_back(i);
    op.lit = lit_, op.receivers = receivers_, op.places = places_;
    op.sweeps = 4;
  }
  static TrainingLight coarse_light() {
    std::vector<std::vector<float>> lights(8, std::vector<float>(16, 0.0f));
    for (std::size_t t = 0; t < 8; ++t) lights[t][0] = 1, lights[t][1 + t] = 0.3f;
    return TrainingLight(std::move(lights));
  }
  std::vector<Rgb> answer(const std::vector<float>& light) const {
    std::vector<Rgbx> exitance;
    for (const float v : light) exitance.push_back({v, v, v, 0});
    return indirect_light(op, exitance);
  }
  std::filesystem::path file() const { return folder_ / "op.bin"; }
  std::string error_of(const std::string& bytes) const {
    write_file(file(), bytes);
    try {
      open_operator(file());
    } catch (const Error& e) {
      return e.what();
    }
    return "";
  }

  TemporaryFolder folder_;
  TrainingLight light_, coarse_;
  ClusterRowsBuilder::Result gather_, first_, bounce_;
  std::vector<Rgbx> albedo_;
  std::vector<OperatorPoint> lit_, receivers_;
  std::vector<uint32_t> places_;
  Operator op;
};

// 5. and the albedo's colour: what blue surfaces lack never comes back, whatever the first light was.
TEST_F(OperatorTest, IsLinearAndColoured) {
  const std::vector<Rgb> a = answer(lamp(1)), b = answer(lamp(2));
  std::vector<float> both = lamp(1);
  for (uint32_t k = 0; k < kSlots; ++k) both[k] = 2 * both[k] + 3 * lamp(2)[k];
  const std::vector<Rgb> sum = answer(both);
  op.sweeps = 0;
  const std::vector<Rgb> once = answer(lamp(1));
  for (std::size_t i = 0; i < sum.size(); ++i) {
    const Rgb expected = 2.0f * a[i] + 3.0f * b[i];
    EXPECT_NEAR(sum[i].r, expected.r, 1e-5f * std::abs(expected.r) + 1e-6f);
    EXPECT_NEAR(sum[i].g, expected.g, 1e-5f * std::abs(expected.g) + 1e-6f);
    EXPECT_GT(a[i].r, a[i].g);
    EXPECT_NEAR(a[i].b, once[i].b, 1e-6f) << "black in blue: no second bounce";
  }
}

// One small inverse is the sum of all sweeps.
TEST_F(OperatorTest, FoldedBouncesAreManySweeps) {
  op.sweeps = 100;
  const FoldedBounces bounces(op);
  std::vector<Rgbx> swept(kSlots), folded;
  for (uint32_t k = 0; k < kSlots; ++k) swept[k] = {lamp(3)[k], 2 * lamp(4)[k], 1, 0};
  folded = swept;
  bounce_light(op, swept);
  bounces.apply(folded);
  for (uint32_t k = 0; k < kSlots; ++k)
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(folded[k][c], swept[k][c], 1e-5f) << k;
}

// What another builder takes over as bytes are the same rows.
// ADR 46: given as it is, light of slots is multiplied by their weights, in sweeps and all at once.
TEST(WeighedSlots, AreLightTimesWeight) {
  const Operator op = made_up_operator({.receivers = 40, .slots = 256, .cluster = 64, .node_cluster = 64});
  Operator without = op;
  std::vector<Rgbx> albedo(op.albedo.begin(), op.albedo.end());
  for (Rgbx& a : albedo) a[3] = 0;
  without.albedo = albedo;
  std::vector<Rgbx> light(op.slots()), by_hand(op.slots());
  for (uint32_t i = 0; i < op.slots(); ++i) {
    light[i] = {static_cast<float>(i % 7), 1, 2, 0};
    ASSERT_GT(op.albedo[i][3], 0);
    for (std::size_t c = 0; c < 3; ++c) by_hand[i][c] = op.albedo[i][3] * light[i][c];
  }
  std::vector<Rgbx> folded = light, swept = light, expected = by_hand;
  FoldedBounces(op).apply(folded);
  FoldedBounces(without).apply(expected);
  EXPECT_EQ(folded, expected);
  bounce_light(op, swept);
  bounce_light(without, by_hand);
  EXPECT_EQ(swept, by_hand);
}

TEST(ClusterRows, PackedClustersAreTheSameRows) {
  const TrainingLight light = training();
  ClusterRowsBuilder one(80, light, {32, 64}), other(80, light, {32, 64});
  std::string bytes;
  for (std::size_t c = 0; c < one.clusters(); ++c) {
    std::vector<std::vector<SparseEntry>> rows;
    for (uint32_t r = static_cast<uint32_t>(32 * c);
         r < std::min<uint32_t>(80, static_cast<uint32_t>(32 * c) + 32); ++r)
      rows.push_back(bump(r, 80));
    one.set_cluster(c, rows);
    one.pack(c, bytes);
  }
  std::string_view left = bytes;
  for (std::size_t c = 0; c < other.clusters(); ++c) other.unpack(c, left);
  EXPECT_TRUE(left.empty());
  EXPECT_EQ(product(one.finish().rows, lamp(5)), product(other.finish().rows, lamp(5)));
}

TEST_F(OperatorTest, FileGivesTheSameAnswers) {
  write_operator(file(), op);
  const Operator read = open_operator(file());
  std::vector<Rgbx> exitance(kSlots, Rgbx{1, 2, 3, 0});
  std::vector<Rgbx> again = exitance;
  EXPECT_EQ(indirect_light(read, exitance), indirect_light(op, again));
  EXPECT_EQ(read.scene, "scene");
  EXPECT_EQ(read.options, "by hand");
  EXPECT_EQ(read.bytes(), op.bytes());
  EXPECT_EQ(read.places.back(), 39u);
}

TEST_F(OperatorTest, DamageIsNamed) {
  write_operator(file(), op);
  const std::string good = read_file(file());
  EXPECT_EQ(error_of(good), "");
  EXPECT_NE(error_of("hello").find("is no operator"), std::string::npos);
  EXPECT_NE(error_of(good.substr(0, good.size() - 100)).find("is damaged"), std::string::npos);
  std::string flipped = good;
  flipped[good.size() / 2] = static_cast<char>(flipped[good.size() / 2] ^ 1);
  EXPECT_NE(error_of(flipped).find("checksum"), std::string::npos);
  std::string newer = good;
  newer[12] = 2;
  EXPECT_NE(error_of(newer).find("version 2; this program reads version 1"), std::string::npos);
  EXPECT_THROW(open_operator(folder_ / "none.bin"), Error);
}

TEST_F(OperatorTest, WhatIsNotFiniteIsNotWritten) {
  albedo_[3][1] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(write_operator(file(), op), Error);
  albedo_[3][1] = 0.5f;
  lit_[7].position[2] = std::numeric_limits<float>::infinity();
  EXPECT_THROW(write_operator(file(), op), Error);
  lit_[7].position[2] = 0;
  std::vector<float> scales(op.gather.scales.begin(), op.gather.scales.end());
  scales[5] = std::numeric_limits<float>::infinity();
  op.gather.scales = scales;
  EXPECT_THROW(write_operator(file(), op), Error);
  EXPECT_FALSE(std::filesystem::exists(file()));
  scales[5] = 1;
  write_operator(file(), op);
}

TEST(OperatorPoint, NormalsAndAlbedosComeBack) {
  for (uint32_t i = 0; i < 500; ++i) {
    const Vec2 u = sobol_pair(i, 0, 3);
    const float z = 2 * u.x - 1, r = std::sqrt(1 - z * z), phi = 2 * kPi * u.y;
    const Vec3 n(r * std::cos(phi), r * std::sin(phi), z);
    EXPECT_LT(glm::distance(unpack_normal(pack_normal(n)), n), 1e-4f);
  }
  EXPECT_NEAR(unpack_albedo(pack_albedo(Rgb(0.02f, 0.5f, 1))).r, 0.02f, 1e-5f);
}

}  // namespace
}  // namespace sconce
