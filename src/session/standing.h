// SPDX-License-Identifier: Apache-2.0
// The scene as it stands, lamps where they went and what they became, for rays that know nothing of layers.
#pragma once

#include <memory>
#include <optional>

#include "light/lamp.h"
#include "scene/more_lights.h"
#include "session/session.h"
#include "trace/tracer.h"

namespace sconce {

/// A lamp that is not as it was baked.
struct StandingLamp {
  std::size_t lamp = 0;  ///< of Lamps::all()
  MovedLamp state;
  std::optional<MoreLights> other{};  ///< in its stead; none: the lamp itself where its kind is its own, else
                                      ///< nothing that rays know (a shader): it is left out
};

class StandingScene {
 public:
  /// @param scene, world  with objects where they are @throws UsageError: a target for what points nowhere
  StandingScene(const Scene& scene, const World& world, std::span<const StandingLamp> lamps);
  StandingScene(const StandingScene&) = delete;
  StandingScene& operator=(const StandingScene&) = delete;

  const Scene& scene() const { return scene_; }
  const World& world() const { return world_; }
  const Tracer& tracer() const { return tracer_; }

 private:
  Scene scene_;
  World world_;
  Tracer tracer_;
};

}  // namespace sconce
