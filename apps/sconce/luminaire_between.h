// SPDX-License-Identifier: Apache-2.0
// What stands between a lamp and the wall that `luminaire render` shows.
#pragma once

#include <optional>
#include <string>

#include "core/progress.h"
#include "light/lamp.h"
#include "trace/tracer.h"

namespace sconce::app {

/// Places and directions are in the luminaire's frame; in the scene the lamp hangs at the origin (nadir -y,
/// C0 +x, C90 -z).
class Between {
 public:
  /// @param scene  file; its own lamps do not count
  Between(const std::string& scene, const Progress& progress);

  /// The lamp that shines. @param exact_below  of a light field
  void hang(Luminaire lamp, double exact_below);
  /// Illuminance of a wall at x that faces up, lux, by shadow rays. @pre hang()
  Rgb lux(const Vec3& x, int rays, uint32_t seed) const;
  /// Share of the light that gets from a place along a unit direction over a distance, m.
  Rgb passed(const Vec3& from, const Vec3& direction, double distance) const;

 private:
  Scene scene_;
  World world_;
  Tracer tracer_;
  std::optional<Lamps> lamps_;
};

}  // namespace sconce::app
