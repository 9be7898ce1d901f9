// SPDX-License-Identifier: Apache-2.0
// Lamps that are not in any layer: new ones, and those of light groups that come by transfer.
#pragma once

#include "light/lamp.h"
#include "trace/tracer.h"
#include "transfer/operator.h"

namespace sconce {

/// A light group of the package, and what its lamps are multiplied by.
struct MovedGroup {
  Id<LightGroup> group;
  Rgb weight;
};

class MovedLamps {
 public:
  /// The scene's groups and more lights. World and tracer must outlive it.
  MovedLamps(const Scene& scene, const World& world, const Tracer& tracer, const std::vector<Light>& lights,
             std::span<const MovedGroup> groups);

  std::size_t size() const { return chosen_.size(); }
  /// Direct illuminance at a point, lux, by one shadow ray for each lamp. Lamps of some size, sun and sky
  /// with a random point: a mean over `index`es of a stream is the soft shadow. Thread-safe.
  Rgb illuminance(const SurfacePoint& at, uint32_t stream, uint32_t index) const;

 private:
  struct Chosen {
    std::size_t lamp;
    Rgb weight;
  };
  const Tracer& tracer_;
  Scene scene_;
  Lamps lamps_;
  std::vector<Chosen> chosen_;
};

/// b_d of the operator's cloud: albedo x direct illuminance, mean over each slot's points, lm/m2.
std::vector<Rgbx> light_cloud(const Operator& op, const MovedLamps& lamps);

}  // namespace sconce
