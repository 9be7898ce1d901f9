// SPDX-License-Identifier: Apache-2.0
// Objects of a package that stand elsewhere: what that changes of its lightmap. Layers stay as they were
// baked; the difference of direct light is found by those rays alone that meet an object where it is or was,
// that of bounces by two operators (object_follower.h).
#pragma once

#include <optional>

#include "relight/moved_lamps.h"
#include "relight/receivers.h"

namespace sconce {

/// The middle of an object, its bounds'. @throws UsageError naming those that there are
Vec3 middle_of_object(const View& view, const std::string& name, const std::string& where);

class MovedObjects {
 public:
  /// A view of its own, with all objects at home. Package and view must outlive it.
  MovedObjects(const Package& package, const View& home, const Progress& progress = {});
  MovedObjects(const MovedObjects&) = delete;
  MovedObjects& operator=(const MovedObjects&) = delete;

  /// The scene with objects where they are.
  const View& view() const { return view_; }
  const ObjectMoves& moves() const { return moves_; }
  /// Puts objects there; those that are not named go home. Nobody may look meanwhile. Throws UsageError for
  /// unknown names.
  void place(const ObjectMoves& moves, const std::string& where = {});

  /// How direct light differs from home, lux at unit weight: [receiver x groups + group]. Of texels that were
  /// covered at home all of it.
  /// @param rays  to each lamp from each texel; 1: from its middle
  std::vector<Rgb> direct(uint32_t rays, const Progress& progress = {}) const;
  const Atlas& atlas() const { return atlas_; }
  const RelightReceivers& texels() const { return texels_.receivers; }
  /// Where receivers lie: page x height x width + y x width + x, ascending.
  const std::vector<uint32_t>& places() const { return texels_.receivers.places; }

  /// Adds what objects change to mixed pages, gaps filled; what is below zero then is darkness.
  /// @param direct      direct()
  /// @param now, home   bounces in the same order, of here and of home
  void add_to(std::vector<Image>& pages, const MixSpec& mix, std::span<const Rgb> direct,
              std::span<const Rgb> now, std::span<const Rgb> home) const;

 private:
  void find_covered();

  const Package& package_;
  const View& home_;
  View view_;
  ObjectPlaces places_of_objects_;
  Atlas atlas_;
  AllTexels texels_;                                ///< on view_
  std::vector<SurfacePoint> middles_;               ///< per receiver, at home
  std::vector<uint8_t> covered_at_home_, covered_;  ///< per receiver
  std::vector<Bounds> boxes_;                       ///< around what moved, at home and now
  std::vector<Placement> placements_;               ///< per instance
  ObjectMoves moves_;
  MovedLamps lamps_at_home_;
  std::optional<MovedLamps> lamps_;
};

/// All lamps of a package's groups, at unit weight.
std::vector<MovedGroup> all_groups(const Package& package);

}  // namespace sconce
