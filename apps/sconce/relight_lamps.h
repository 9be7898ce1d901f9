// SPDX-License-Identifier: Apache-2.0
// The lamps that a command is told of: new ones, and those of the package that go elsewhere or become others.
#pragma once

#include "app.h"
#include "lamp_kinds.h"
#include "mix/preset.h"

namespace sconce::app {

/// What becomes of a lamp, of all lamps of a name, or of a group.
struct LampChange {
  std::string name;
  std::optional<Vec3> at{};      ///< none: where it stands
  std::optional<Vec3> target{};  ///< that it is turned to
  std::string kind{};            ///< of become(); "" = its own
};

struct WantedLamps {
  MoreLights more;
  std::vector<gpu::LampShader> shaders;
  std::vector<std::string> groups;  ///< by transfer instead of by their layers
  std::vector<LampChange> changes;
};

/// `--light`, `--lights`, `--move`, `--kind`.
struct LampWords {
  std::vector<std::string> lights, moves, kinds;
  std::string file;

  /// @param relight  groups by transfer, too
  void declare(Options& options, bool relight);
  /// @param preset  whose lamps the words change further
  /// @param some    none at all is an error
  /// @throws UsageError; Error for files
  WantedLamps parse(const Preset& preset, const Progress& progress, bool some) const;
};

/// A change in the package's terms.
struct ChangedLamps {
  std::string name;
  LampMove move;
  std::optional<Vec3> target;  ///< of what they become
  std::string kind;            ///< "" = their own

  /// What one of them becomes where it goes. @throws as become()
  OtherKind other(const Lamp& lamp, const Progress& progress) const;
};
/// @throws UsageError: no such lamp
std::vector<ChangedLamps> changed_lamps(const WantedLamps& wanted, const Scene& scene, const Lamps& lamps);

/// All of it for a picture.
struct RelitLamps {
  MoreLights more;
  std::vector<gpu::LampShader> shaders;
  std::vector<LampMove> moves;
  std::vector<MovedGroup> left;     ///< of take_lamps(): what is no longer in the lightmap
  std::vector<MovedGroup> shining;  ///< and shines as what it was, from where `moves` say
};

/// @param whole     of take_lamps()
/// @param lightmap  weights of groups that leave it become 0
/// @throws UsageError: no such lamp or group
RelitLamps place_lamps(const WantedLamps& wanted, const Scene& scene, const Lamps& lamps, bool whole,
                       MixSpec& lightmap, const Progress& progress);

}  // namespace sconce::app
