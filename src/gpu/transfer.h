// SPDX-License-Identifier: Apache-2.0
// transfer/operator.h on the device: direct light on the cloud in, indirect light on receivers out.
#pragma once

#include <optional>
#include <vector>

#include "gpu/buffer.h"
#include "gpu/program.h"
#include "transfer/operator.h"

namespace sconce::gpu {

/// An operator that was uploaded once, as its file holds it; shaders decode it in every product. All bounces
/// are one small matrix, as on the CPU.
class Transfer {
 public:
  /// @throws Error when a part of the operator is larger than the device allows
  Transfer(const Context& context, const Operator& op);

  /// b_d per slot, lm/m2, RGBA floats: to be written before apply().
  const Buffer& exitance() const { return exitance_; }
  /// FoldedBounces, then F, without what truncation leaves below zero: per receiver, lux, RGBA floats.
  void apply() const;
  const Buffer& illuminance() const { return illuminance_; }
  std::vector<Rgb> read() const;
  /// Read and written by one apply(), each buffer once per use.
  std::size_t bytes_moved() const;

 private:
  /// ClusterRows.
  struct Rows {
    Rows(const Context& context, const ClusterRows& rows, const std::string& what);
    uint32_t rows, cluster, blocks;
    bool plain;
    std::size_t bytes;
    Buffer first, indices, codes, basis_scales, means, weights, scales;
    Buffer sums;  ///< the basis' answers
  };
  /// What reflects between nodes.
  struct Bounces {
    Bounces(const Context& context, const Operator& op);
    uint32_t nodes;
    Rows first, all;
    Buffer folded, answers, albedo, coefficients, light, sum;
  };
  /// @param factor   of what is written
  /// @param more     it is added to what is there
  /// @param weights  Operator::albedo: of what is read; may be null
  void transform(const Buffer& from, uint32_t size, const Buffer& to, float factor = 1, bool more = false,
                 const Buffer* weights = nullptr) const;
  void answer(const Rows& rows, const Buffer& light) const;
  /// @param reflected  null for receivers
  void combine(const Rows& rows, const Buffer& answers, const Buffer& out, const Bounces* reflected) const;
  void bounce(const Bounces& bounces) const;

  const Context* context_;
  uint32_t slots_;
  Rows gather_;
  std::optional<Bounces> bounces_;
  Program haar_, basis_product_, dense_product_, row_product_;
  Buffer exitance_, coefficients_, averages_, illuminance_;
};

}  // namespace sconce::gpu
