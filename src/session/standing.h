// SPDX-License-Identifier: Apache-2.0
// The scene as it stands, lamps where they went and what they became, for rays that know nothing of layers.
#pragma once

#include <memory>
#include <optional>

#include "light/lamp.h"
#include "scene/more_lights.h"
#include "trace/tracer.h"

namespace sconce {

/// A lamp that is not as it was baked.
struct StandingLamp {
  std::size_t lamp = 0;               ///< of Lamps::all()
  Mat4 motion{1.0f};                  ///< that it goes by, rigid
  bool itself = true;                 ///< else it is put out
  std::optional<MoreLights> other{};  ///< in the stead of one that is put out, of its group; none: nothing
                                      ///< that rays know (a shader)
};

/// The scene with lamps as they stand: bodies of luminous meshes go along. Its groups are the same.
/// @param from, world  with objects where they are
Scene standing_scene(const Scene& from, const World& world, std::span<const StandingLamp> lamps);

/// Puts lights into a group that is new and the last.
void add_group(Scene& scene, const std::string& name, MoreLights lights);

/// Ready for rays.
class StandingScene {
 public:
  explicit StandingScene(Scene scene);
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
