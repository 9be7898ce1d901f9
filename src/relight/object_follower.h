// SPDX-License-Identifier: Apache-2.0
// Bounces of a package in which objects move: an operator whose affected rows are made again.
#pragma once

#include "relight/moved_lamps.h"
#include "relight/operator_parts.h"
#include "transfer/folded_bounces.h"

namespace sconce {

/// Bounces with objects at some places.
struct ObjectBounces {
  ObjectMoves moves;
  std::shared_ptr<const Operator> op;
  std::shared_ptr<const FoldedBounces> folded;  ///< of it, which it keeps
  std::vector<Rgb> light;  ///< lux at unit weight: [receiver x groups + group], receivers by place
  FollowReport made;       ///< of the operator's rows, for these places
  std::size_t slots = 0, receivers = 0;  ///< that there are
};

/// In a world of its own, so that others may look while it follows.
class ObjectFollower {
 public:
  /// Makes the operator, with objects at home. The package must outlive it. @throws Cancelled
  ObjectFollower(const Package& package, const View& home, const Progress& progress = {});
  ObjectFollower(const ObjectFollower&) = delete;
  ObjectFollower& operator=(const ObjectFollower&) = delete;

  /// With objects at home.
  const ObjectBounces& home() const { return home_; }
  /// Makes those rows again that objects' ways touch, and lights the cloud. One at a time.
  /// @throws Cancelled: then follow() once more
  ObjectBounces follow(const ObjectMoves& moves, const Progress& progress = {});

 private:
  ObjectBounces lit(Operator op, const ObjectMoves& moves) const;

  const Package& package_;
  Scene scene_;
  World world_;
  Tracer tracer_;
  ObjectPlaces places_;
  RelightReceivers receivers_;
  OperatorParts parts_;
  ObjectBounces home_;
};

}  // namespace sconce
