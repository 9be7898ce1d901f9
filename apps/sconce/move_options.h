// SPDX-License-Identifier: Apache-2.0
// The options by which lamps and objects stand elsewhere than they were baked, and what stands there then,
// for verbs that follow rays.
#pragma once

#include <memory>

#include "relight_lamps.h"
#include "relight_objects.h"
#include "session/measure.h"
#include "session/session.h"

namespace sconce::app {

/// `--light`, `--lights`, `--move`, `--kind`, `--object`.
struct MoveOptions {
  LampWords lamps;
  std::vector<std::string> objects;

  /// @param relight  of LampWords
  void declare(Options& options, bool relight = false);
  /// @throws UsageError
  std::vector<ObjectPlace> places() const;
  bool any() const;
  /// As they were given, for a report.
  std::string text() const;
};

/// A package's scene as these options and a preset's lamps have it.
class Rearrangement {
 public:
  /// Package and home must outlive it. @throws UsageError; Error for files
  Rearrangement(const MoveOptions& options, const Preset& preset, const Package& package, const View& home,
                const Progress& progress);

  /// Whether anything is not as it was baked.
  bool any() const { return moved_ || !lamps_.empty() || adds(); }
  /// Objects where they are.
  const View& view() const { return moved_ ? *moved_ : home_; }
  /// Lamps that belong to none of the package's groups, and whether there are some.
  const MoreLights& added() const { return added_; }
  bool adds() const;
  /// Lamps that rays do not know.
  struct Shader {
    std::size_t group;  ///< beyond the package's: none of them
    gpu::LampShader lamp;
  };
  const std::vector<Shader>& shaders() const { return shaders_; }
  /// All but those, and but light shaders.
  Scene scene() const { return standing_scene(view().scene(), view().world(), lamps_); }
  /// Of all of it, the window's; lamps that are added are one more group, the last. Shaders need OpenGL, and
  /// an operator: the package's, or with objects elsewhere one that is made here.
  /// @throws Error where there is none; what is wrong with a shader
  PointMeter meter(std::vector<SurfacePoint> points, const Progress& progress) const;
  /// Each lamp that is not as it was baked, by its number, and all of them for a preset; those that were
  /// added are none of it.
  const MovedPlaces& places() const { return places_; }
  std::vector<PresetLamp> preset_lamps() const;
  const ObjectMoves& objects() const { return objects_; }

 private:
  std::vector<KnownLamp> known(std::span<const SurfacePoint> points, const Progress& progress) const;

  const Package& package_;
  const View& home_;
  ObjectMoves objects_;
  std::unique_ptr<View> moved_;  ///< null where objects stay
  std::vector<StandingLamp> lamps_;
  MovedPlaces places_;
  std::vector<std::string> names_;  ///< lamp_names()
  MoreLights added_;
  std::vector<Shader> shaders_;
};

/// The group of the lamps that are added, where there are some.
inline constexpr const char* kAddedGroup = "added";

}  // namespace sconce::app
