// SPDX-License-Identifier: Apache-2.0
// Emissive meshes in a glossy surface: a lobe's rays seldom meet one that is small and bright, points picked
// on it seldom lie within a narrow lobe. Both ways together, weighted by the balance heuristic (Veach and
// Guibas 1995, "Optimally Combining Sampling Techniques").
#pragma once

#include "light/lamp.h"
#include "mix/mix.h"
#include "scene/world.h"
#include "trace/tracer.h"

namespace sconce {

/// One point of a glossy surface and what it may mirror. What it refers to must outlive it.
class Highlights {
 public:
  /// @param to_eye   unit, above the surface
  /// @param at       its normals on the side of the eye
  /// @param surface  of some roughness: a mirror's lobe has no density
  Highlights(const Lamps& lamps, const MixSpec& mix, const Shade& surface, const Vec3& to_eye,
             const SurfacePoint& at);

  /// What is mirrored of a point picked on one of the lamps, cd/m2 at the mix's weights, shadow ray included.
  /// Its mean over all u and share() of what the lobe's rays meet are together the lamps' image.
  Rgb pick(const Tracer& tracer, Vec2 u) const;

  /// Weight of the emission that a ray of the lobe (gloss()) meets; 1 where pick() never gets to.
  /// @param ray  its origin at the surface
  float share(const Ray& ray, const Hit& hit) const;

 private:
  const Lamps* lamps_;
  const MixSpec* mix_;
  const Shade& surface_;
  Vec3 to_eye_;
  const SurfacePoint& at_;
  std::vector<float> chance_;  ///< per lamp, sum 1; empty where no mesh can be seen
};

}  // namespace sconce
