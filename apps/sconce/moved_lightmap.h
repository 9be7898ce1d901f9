// SPDX-License-Identifier: Apache-2.0
// The lightmap of a package with lamps and objects elsewhere, group by group, by the window's own parts.
#pragma once

#include "gpu/geometry.h"
#include "move_options.h"
#include "session/movers.h"

namespace sconce::app {

class MovedLightmap {
 public:
  /// Lights all that moved, objects' bounces by an operator that is made here, lamps by the package's.
  /// @param now  of the same package @throws Error where lamps moved and there is no operator; what is wrong
  /// with a shader
  MovedLightmap(std::shared_ptr<const Opened> opened, const Rearrangement& now, const Progress& progress);

  const View& view() const { return objects_ ? objects_->view() : opened_->rays; }
  /// Must not outlive it.
  GroupedLight light() const;

 private:
  OtherLamp other(std::size_t lamp, const MovedLamp& state);
  PrelitLamp prelit(gpu::LampShader shader);
  void light_added(const Rearrangement& now, const Progress& progress);

  std::shared_ptr<const Opened> opened_;
  std::unique_ptr<ObjectMover> objects_;    ///< null where they stay
  std::shared_ptr<const Movable> movable_;  ///< null where lamps stay
  std::unique_ptr<gpu::Context> context_;   ///< made for the first shader
  std::unique_ptr<gpu::Geometry> geometry_;
  std::unique_ptr<LampMover> lamps_;
  std::vector<Image> added_;
};

}  // namespace sconce::app
