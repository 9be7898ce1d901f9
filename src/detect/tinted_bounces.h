// SPDX-License-Identifier: Apache-2.0
// Light by bounces on the receivers of an operator. Its rows have no colour: where surfaces let one colour
// through better than another, each channel has an operator of its own.
#pragma once

#include <functional>
#include <memory>

#include "core/stopwatch.h"
#include "detect/materials.h"
#include "transfer/folded_bounces.h"
#include "transfer/gradual_rows.h"

namespace sconce {

/// What a frame may cost beside the renderer's drawing and the bounces: after either at least one cluster of
/// receivers ends the frame.
struct FrameBudget {
  std::size_t receivers = static_cast<std::size_t>(-1);  ///< the same light on any machine
  double milliseconds = 1e30;

  bool limited(std::size_t all) const { return receivers < all || milliseconds < 1e30; }
};

/// TransferParams::transmission of each operator that is needed: one, or one for each of red, green and blue.
/// Empty where nothing lets light through.
std::vector<std::vector<float>> tints(const Detection& detection);

class TintedBounces {
 public:
  /// @param operators  one for all channels or three, of the same slots, points and receivers
  explicit TintedBounces(std::vector<Operator> operators);

  /// What all of them have alike: slots, points, receivers.
  const Operator& op() const { return ways_.front()->op; }
  /// @param of  per node: mean reflectance of its points
  void set_reflectance(std::span<const Rgb> of);
  /// A light's first answer within a budget begins with what the old one gave.
  void go_on_from(const TintedBounces& old);
  /// @param light    that leaves each slot
  /// @param running  since the frame began
  /// @return receivers whose light is right only in the mean of their cluster
  std::size_t solve(std::span<const Rgbx> light, const FrameBudget& budget, const Stopwatch& running);
  /// Of a receiver, at least 0.
  Rgb light(std::size_t receiver) const;

 private:
  struct Way {
    Operator op;
    std::vector<Rgbx> albedo;  ///< the operator's, per node
    std::unique_ptr<FoldedBounces> bounces;
    std::unique_ptr<GradualRows> gradual;  ///< made by the first budget
    std::vector<Rgbx> lit;                 ///< coefficients that it is at
    std::vector<Rgb> light;                ///< per receiver; may be below 0
  };
  std::size_t refine(const FrameBudget& budget, const Stopwatch& running);

  std::vector<std::unique_ptr<Way>> ways_;  ///< where they are, rows refer to them
};

}  // namespace sconce
