// SPDX-License-Identifier: Apache-2.0
// The options by which lamps and objects stand elsewhere than they were baked, and what stands there then,
// for verbs that follow rays.
#pragma once

#include <memory>

#include "relight_lamps.h"
#include "relight_objects.h"
#include "session/measure.h"

namespace sconce::app {

/// `--light`, `--lights`, `--move`, `--kind`, `--object`.
struct MoveOptions {
  LampWords lamps;
  std::vector<std::string> objects;

  /// @param relight  of LampWords
  void declare(Options& options, bool relight = false);
  /// @throws UsageError
  std::vector<ObjectPlace> places() const;
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
  bool any() const { return moved_ || !lamps_.empty() || !added_.lights.empty(); }
  /// Objects where they are.
  const View& view() const { return moved_ ? *moved_ : home_; }
  /// Lamps that belong to none of the package's groups.
  const MoreLights& added() const { return added_; }
  /// All but those.
  Scene scene() const { return standing_scene(view().scene(), view().world(), lamps_); }
  /// Of all of it, the window's; lamps of `added()` are one more group, the last.
  PointMeter meter(std::vector<SurfacePoint> points) const;
  /// Each lamp that is not as it was baked, for a preset; those that were added are none of it.
  const std::vector<PresetLamp>& preset_lamps() const { return preset_lamps_; }

 private:
  const View& home_;
  std::unique_ptr<View> moved_;  ///< null where objects stay
  std::vector<StandingLamp> lamps_;
  std::vector<PresetLamp> preset_lamps_;
  MoreLights added_;
};

/// The group of the lamps that are added, where there are some.
inline constexpr const char* kAddedGroup = "added";

}  // namespace sconce::app
