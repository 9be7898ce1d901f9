// SPDX-License-Identifier: Apache-2.0
// Lamps of a scene that go elsewhere, and what of the lightmap goes with them.
#pragma once

#include <optional>
#include <string>

#include "light/lamp.h"
#include "mix/settings.h"

namespace sconce {

/// Where lamps go.
struct LampPlace {
  Vec3 position;                 ///< of their middle, m
  std::optional<Vec3> target{};  ///< that they are turned to; none: turned as they were
};

/// Lamps of the scene that go elsewhere together.
struct LampMove {
  std::vector<std::size_t> lamps;      ///< of Lamps::all()
  std::vector<Id<LightGroup>> groups;  ///< theirs
  Mat4 motion{1.0f};                   ///< rigid
};

/// The middle of a lamp; none for what shines from everywhere.
std::optional<Vec3> place_of(const Lamp& lamp);
/// Where a lamp points, unit; none for what shines all around, or from no plane.
std::optional<Vec3> axis_of(const Lamp& lamp);

/// A name for each that no other has: its own, with "#2" behind it where it is the second of its name; "" for
/// what shines from everywhere.
std::vector<std::string> lamp_names(const Lamps& lamps);

/// Of the places of some lamps. @pre there are some
Vec3 middle_of(const Lamps& lamps, std::span<const std::size_t> some);

/// These lamps go to a place together, and the first that points anywhere points to the target.
/// @param name    of them, for errors
/// @param option  that asked for it
/// @throws UsageError: a target for what points nowhere
Mat4 motion_to(const Lamps& lamps, std::span<const std::size_t> some, const LampPlace& to,
               const std::string& name, const std::string& option);

/// The lamp of that name (lamp_names(), too), all lamps where several bear it, or all of a group; their
/// middle goes to the place, and the first that points anywhere points to the target.
/// @param option  that asked for it
/// @throws UsageError: no such lamp, or one without a place (sun, sky), or a target for what points nowhere
LampMove find_move(const Scene& scene, const Lamps& lamps, const std::string& name, const LampPlace& to,
                   const std::string& option);
/// The same lamps where they stand.
LampMove find_lamps(const Scene& scene, const Lamps& lamps, const std::string& name,
                    const std::string& option);

/// Lamps of a light group that come by transfer.
struct MovedGroup {
  Id<LightGroup> group;
  Rgb weight;                        ///< that its lamps are multiplied by
  std::vector<std::size_t> lamps{};  ///< of Lamps::all(); empty = all of the group
};

/// What leaves the lightmap: the groups named, and the lamps that move. Where they are all of a group its
/// weight leaves the mix; else its layer stays, and lightmap_share() is what it holds of them.
/// @param whole     groups go as a whole even where some of their lamps stay
/// @param lightmap  changed
std::vector<MovedGroup> take_lamps(const Lamps& lamps, std::span<const Id<LightGroup>> groups,
                                   std::span<const LampMove> moves, bool whole, MixSpec& lightmap);

/// Those whose layer stays.
std::vector<MovedGroup> in_part(std::span<const MovedGroup> taken);

}  // namespace sconce
