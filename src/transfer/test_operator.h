// SPDX-License-Identifier: Apache-2.0
// For tests and benchmarks only: operators of any size with made-up numbers, quickly.
#pragma once

#include "core/sobol.h"
#include "transfer/operator.h"

namespace sconce {

/// Numbers that depend on nothing but their order.
class MadeUp {
 public:
  uint32_t bits() { return mix32(0x6d616465u, next_++); }
  float unit() { return static_cast<float>(bits() >> 8) * 0x1p-24f; }

 private:
  uint32_t next_ = 0;
};

/// Rows whose answers to even light are about `level` of it, and to other light less.
inline ClusterRows made_up_rows(uint32_t rows, uint32_t columns, uint32_t cluster, std::size_t coefficients,
                                float level, MadeUp& numbers, std::shared_ptr<const void>& owner) {
  struct Owned {
    std::vector<uint32_t> first{0};
    std::vector<uint16_t> indices;
    std::vector<int8_t> codes;
    std::vector<float> scales, means, row_scales;
    std::vector<int16_t> weights;
  };
  const auto owned = std::make_shared<Owned>();
  const float side = std::sqrt(static_cast<float>(columns));
  const std::size_t clusters = (rows + cluster - 1) / cluster, filled = (rows + 15) / 16 * 16;
  const std::size_t step = std::max<std::size_t>(1, columns / coefficients);
  for (std::size_t c = 0; c < clusters; ++c) {
    for (std::size_t k = 1 + numbers.bits() % step; k < columns; k += step) {
      owned->indices.push_back(static_cast<uint16_t>(k));
      for (std::size_t r = 0; r < WaveletRows::kBlock; ++r)
        owned->codes.push_back(static_cast<int8_t>(numbers.bits() % 255 - 127));
    }
    for (std::size_t r = 0; r < WaveletRows::kBlock; ++r) {
      owned->scales.push_back(0.3f * level / (side * std::sqrt(static_cast<float>(coefficients))));
      owned->means.push_back(level * (0.5f + 0.5f * numbers.unit()) / side);
    }
    owned->first.push_back(static_cast<uint32_t>(owned->indices.size()));
  }
  for (std::size_t i = 0; i < filled; ++i)
    owned->row_scales.push_back((0.5f + 0.5f * numbers.unit()) / 16 / 32767);
  for (std::size_t i = 0; i < ClusterRows::kRank * filled; ++i)
    owned->weights.push_back(static_cast<int16_t>(32767 - numbers.bits() % 40000));
  ClusterRows out{rows, cluster, {}, owned->weights, owned->row_scales};
  out.basis = {columns,      static_cast<uint32_t>(ClusterRows::kRank * clusters),
               owned->first, owned->indices,
               owned->codes, owned->scales,
               owned->means, {}};
  owner = owned;
  return out;
}

/// As `sconce transfer` makes them by default, but for the numbers in it; without points.
struct MadeUpParams {
  uint32_t receivers = 1000, slots = 65536, slots_per_node = 1;
  bool bounces = true;
  bool plain = false;  ///< as the chapter's: rows without weights (clusters of 16), all bounces in one sweep
  uint32_t cluster = 256, first_cluster = 256, node_cluster = 2048;
  std::size_t coefficients = 1024, bounce_coefficients = 512;
};
inline Operator made_up_operator(const MadeUpParams& p) {
  MadeUp numbers;
  Operator op;
  op.width = static_cast<int>(p.receivers), op.height = op.pages = 1;
  op.sweeps = p.bounces ? 100 : 0;
  const uint32_t nodes = p.slots / p.slots_per_node;
  op.owners.resize(3);
  op.gather = made_up_rows(p.receivers, p.slots, p.cluster, p.coefficients, 0.9f, numbers, op.owners[0]);
  op.first = made_up_rows(nodes, p.slots, p.first_cluster, p.coefficients, 0.9f, numbers, op.owners[1]);
  op.bounce = made_up_rows(nodes, nodes, p.node_cluster, p.bounce_coefficients, 0.9f, numbers, op.owners[2]);
  if (p.plain) {
    op.sweeps = 1;
    for (ClusterRows* rows : {&op.gather, &op.first}) rows->weights = {}, rows->scales = {};
  }
  const auto albedo = std::make_shared<std::vector<Rgbx>>();
  const bool weighed = p.bounces && p.slots_per_node == 1;
  for (uint32_t i = 0; i < nodes; ++i)
    albedo->push_back({0.2f + 0.6f * numbers.unit(), 0.5f, 0.3f, weighed ? 0.1f + 0.9f * numbers.unit() : 0});
  op.albedo = *albedo;
  op.owners.push_back(albedo);
  return op;
}

}  // namespace sconce
