// SPDX-License-Identifier: Apache-2.0
// Lamps that are not in any layer: new ones, those of light groups that come by transfer, moved or not.
#pragma once

#include "mix/mix.h"
#include "relight/lamp_move.h"
#include "scene/more_lights.h"
#include "trace/tracer.h"
#include "transfer/operator.h"

namespace sconce {

/// As a place that light arrives at.
SurfacePoint point_of(const OperatorPoint& point);

class MovedLamps {
 public:
  /// The scene's groups and more lights. Tracer and world must outlive it. A moved lamp that is a mesh shines
  /// from its new place through its old body: geometry stays.
  MovedLamps(const Scene& scene, const World& world, const Tracer& tracer, const MoreLights& added,
             std::span<const MovedGroup> groups, std::span<const LampMove> moves = {});
  MovedLamps(const MovedLamps&) = delete;
  MovedLamps& operator=(const MovedLamps&) = delete;

  std::size_t size() const { return chosen_.size(); }
  /// All lamps, and which of them are moved, with their weights: for other devices.
  const Lamps& lamps() const { return lamps_; }
  std::vector<std::pair<std::size_t, Rgb>> chosen() const;
  /// Direct illuminance at a point, lux, by one shadow ray for each lamp and one ray for all lamps of some
  /// size and skies, weighted by the balance heuristic (Veach 1997): a mean over `index`es of a stream is the
  /// soft shadow. Thread-safe.
  Rgb illuminance(const SurfacePoint& at, uint32_t stream, uint32_t index) const;

  /// The same by light group, added to `groups`; but only what comes by rays that meet one of the boxes. Two
  /// worlds that differ within boxes alone differ by this at any point, sample by sample.
  void add_light_through(std::span<const Bounds> boxes, const SurfacePoint& at, uint32_t stream,
                         uint32_t index, std::span<Rgb> groups) const;

  /// What a glossy surface mirrors of all light fields, these and those of the mix, cd/m2 (picture/glint.h).
  /// Thread-safe.
  Rgb glints(const MixSpec& mix, const Shade& surface, const Vec3& to_eye, const SurfacePoint& at,
             uint32_t stream, uint32_t index) const;

  /// Names of lamps from which most rays end on backs of surfaces: they stand inside something.
  std::vector<std::string> buried() const;

 private:
  struct Chosen {
    std::size_t lamp;
    Rgb weight;
    bool met = false;  ///< rays can meet it
  };
  /// Calls add(lamp, lux) for light by rays that are wanted(ray).
  template <class Wanted, class Add>
  void light(const SurfacePoint& at, uint32_t stream, uint32_t index, const Wanted& wanted,
             const Add& add) const;
  template <class Wanted, class Add>
  void met(const SurfacePoint& at, const Vec3& start, uint32_t stream, uint32_t index, const Wanted& wanted,
           const Add& add) const;

  const World& world_;
  const Tracer& tracer_;
  Scene scene_;
  World moved_world_;  ///< empty where no mesh moved
  Lamps lamps_;
  std::vector<std::size_t> near_;  ///< all that are light fields
  std::vector<Chosen> chosen_;
  std::vector<Rgb> met_;  ///< per lamp: weight of those that rays can meet; empty where there are none
};

/// b_d of the operator's cloud: albedo x direct illuminance, mean over each slot's points, lm/m2.
std::vector<Rgbx> light_cloud(const Operator& op, const MovedLamps& lamps);

}  // namespace sconce
