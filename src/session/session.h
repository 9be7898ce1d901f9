// SPDX-License-Identifier: Apache-2.0
// All that the window knows of a mix, without the window: moods, their history, presets, cross-fades, and the
// words that drive them. Every word is what a button does.
#pragma once

#include <filesystem>
#include <map>
#include <optional>

#include "mix/mix.h"
#include "scene/objects.h"
#include "session/fader.h"
#include "session/history.h"
#include "session/script.h"
#include "tone/exposure.h"

namespace sconce {

/// A lamp out of its layer.
struct MovedLamp {
  Vec3 at{0};                    ///< where its middle went
  std::optional<Vec3> target{};  ///< that it points to; none: as it did
  std::string kind{};  ///< that it has become, in the words of `sconce relight --light`, without a place; ""
                       ///< = its own

  bool operator==(const MovedLamp&) const = default;
};
/// By their number in Lamps::all().
using MovedPlaces = std::map<std::size_t, MovedLamp>;

/// What a preset keeps, but for the camera; and where lamps and objects went.
struct Mood {
  Faders faders;
  bool automatic = false;  ///< exposure follows the mix; else ev100 holds
  double stops = 0;        ///< on top of automatic
  double ev100 = 9;
  std::string tone = "agx";
  MovedPlaces moved{};
  ObjectMoves objects{};

  bool operator==(const Mood&) const = default;
};

/// A lamp that a preset can name.
struct SceneLamp {
  std::string name;  ///< lamp_names()
  std::optional<Vec3> place{};
};

/// @param camera  its name
/// @param lamps   by their number in Lamps::all()
Preset to_preset(std::span<const GroupInfo> groups, const Mood& mood, const std::string& camera,
                 std::span<const SceneLamp> lamps = {});
/// `current` with what the preset says. One that names lamps sends all others home.
/// @param lamps  none: they stay where they are, whatever the preset says
/// @throws UsageError
Mood to_mood(std::span<const GroupInfo> groups, const Preset& preset, const Mood& current,
             std::span<const SceneLamp> lamps = {});

class Session {
 public:
  /// @param lamps  that move; none where none does
  explicit Session(std::vector<GroupInfo> groups, std::vector<SceneLamp> lamps = {});

  const std::vector<GroupInfo>& groups() const { return groups_; }
  const std::vector<SceneLamp>& lamps() const { return lamps_; }
  const Mood& mood() const { return history_.now(); }
  /// @param gesture  changes in a row of the same name are one step of undo
  void change(Mood mood, const std::string& gesture = {});
  void end_gesture() { history_.end_gesture(); }
  bool undo() { return stop_fade(), history_.undo(); }
  bool redo() { return stop_fade(), history_.redo(); }
  /// What is now becomes the first step.
  void forget_history() { history_ = History<Mood>(Mood(mood())); }
  bool can_undo() const { return history_.can_undo(); }
  bool can_redo() const { return history_.can_redo(); }

  /// The mood that is being shown, on its way to mood() while a cross-fade runs.
  MixSpec mix() const;
  /// Fades from what is shown to the mood. @param seconds  0 = at once
  void fade_to(const Mood& mood, double seconds);
  /// Time goes on. @return whether a cross-fade is running
  bool advance(double seconds);
  double fade_progress() const;  ///< 1 when none is running

  /// A/B: two moods kept aside. 'a' or 'b'.
  void keep(char slot) { slot_of(slot) = mood(); }
  bool kept(char slot) const { return slot == 'a' ? a_.has_value() : b_.has_value(); }
  void recall(char slot, double seconds);

  /// The exposure of a mix that was metered.
  Exposure exposure(const Metering& metering) const;
  /// Holds what automatic exposure would choose.
  void meter_once(const Metering& metering);

  /// Does what the word says where it is about the mix: set, gain, solo, mute, master, kelvin, preset, save,
  /// keep, recall, undo, redo, ev100, auto, tone. @return false where it is about something else
  /// @throws UsageError, Error naming file or group
  bool perform(const Action& action);

  /// Index of a group. @throws UsageError with the names
  std::size_t group(std::string_view name) const;

 private:
  void stop_fade() { from_.reset(); }
  std::optional<Mood>& slot_of(char slot) { return slot == 'a' ? a_ : b_; }

  std::vector<GroupInfo> groups_;
  std::vector<SceneLamp> lamps_;
  History<Mood> history_;
  std::optional<Mood> a_, b_;
  std::optional<MixSpec> from_;  ///< of a cross-fade
  double fade_seconds_ = 0, fade_done_ = 0;
};

}  // namespace sconce
