// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "photometry/light_field.h"

namespace sconce {

/// How far a light field may be from the lamp itself: how much its light changes with filters twice as wide,
/// in the mean about a place (ADR 39). What eq. 14 freezes and what filters blur; no noise.
class NearError {
 public:
  explicit NearError(const NearLamp& lamp);

  /// Of approximate(x, n), lux.
  double at(const Vec3& x, const Vec3& n) const;

 private:
  static constexpr std::size_t kPlaces = 24;
  /// Places about x that are looked at, from x, m.
  std::array<Vec3, kPlaces> places(const Vec3& x) const;
  /// Light of the filters twice as wide less that of the lamp, lux.
  double change(const Vec3& x, const Vec3& n) const;

  const NearLamp& lamp_;
  NearLamp wide_;
};

}  // namespace sconce
