// SPDX-License-Identifier: Apache-2.0
#include "session/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/files.h"
#include "core/text.h"

namespace sconce {

namespace {

double number_in(const Action& action, std::size_t i, double low, double high) {
  const std::optional<double> value = parse_number(action.arguments.at(i));
  if (!value || !(*value >= low && *value <= high))
    throw UsageError(action.where, fmt::format("'{}' is no number for {}", action.arguments[i], action.word),
                     fmt::format("{:g} to {:g}", low, high));
  return *value;
}

/// `fade 2` behind a preset or a slot; 0 where it is not given.
double seconds_in(const Action& action, std::size_t i) {
  return action.arguments.size() > i ? number_in(action, i, 0, 3600) : 0;
}

char slot_in(const Action& action) {
  const std::string& slot = action.arguments.at(0);
  if (slot != "a" && slot != "b") throw UsageError(action.where, "unknown slot '" + slot + "'", "a, b");
  return slot[0];
}

double stops_in(const std::string& text) {
  return parse_number(text).value_or(0);
}

void move_lamps(const PresetLamp& lamp, std::span<const SceneLamp> lamps, MovedPlaces& moved) {
  if (lamps.empty()) return;
  std::vector<std::string> known;
  for (std::size_t i = 0; i < lamps.size(); ++i) {
    if (!lamps[i].place) continue;
    if (lamps[i].name == lamp.name) {
      moved[i] = {lamp.at.value_or(*lamps[i].place), lamp.target, lamp.kind};
      return;
    }
    known.push_back(lamps[i].name);
  }
  throw UsageError({}, "no lamp '" + lamp.name + "'" + did_you_mean(lamp.name, known), join(known, ", "));
}

}  // namespace

Preset to_preset(std::span<const GroupInfo> groups, const Mood& mood, const std::string& camera,
                 std::span<const SceneLamp> lamps) {
  Preset preset = to_preset(groups, mood.faders);
  if (mood.automatic)
    preset.exposure = mood.stops == 0 ? "auto" : fmt::format("{:+.4g}", mood.stops);
  else
    preset.ev100 = fmt::format("{:.4g}", mood.ev100);
  preset.tone = mood.tone;
  preset.camera = camera;
  for (const auto& [lamp, moved] : mood.moved)
    if (lamp < lamps.size()) preset.lamps.push_back({lamps[lamp].name, moved.at, moved.target, moved.kind});
  return preset;
}

Mood to_mood(std::span<const GroupInfo> groups, const Preset& preset, const Mood& current,
             std::span<const SceneLamp> lamps) {
  Mood mood = current;
  mood.faders = to_faders(groups, preset);
  if (!preset.exposure.empty()) mood.automatic = true, mood.stops = stops_in(preset.exposure);
  if (!preset.ev100.empty()) mood.automatic = false, mood.ev100 = stops_in(preset.ev100);
  if (!preset.tone.empty()) mood.tone = find_tone_mapper(preset.tone).name;
  if (!preset.lamps.empty() && !lamps.empty()) mood.moved.clear();
  for (const PresetLamp& lamp : preset.lamps) move_lamps(lamp, lamps, mood.moved);
  return mood;
}

Session::Session(std::vector<GroupInfo> groups, std::vector<SceneLamp> lamps)
    : groups_(std::move(groups)),
      lamps_(std::move(lamps)),
      history_(Mood{.faders = {.groups = std::vector<Fader>(groups_.size())}}) {}

void Session::change(Mood mood, const std::string& gesture) {
  stop_fade();
  history_.set(std::move(mood), gesture);
}

MixSpec Session::mix() const {
  const MixSpec target = make_mix(groups_, mood().faders);
  return from_ ? cross_fade(*from_, target, fade_progress()) : target;
}

void Session::fade_to(const Mood& target, double seconds) {
  MixSpec shown = mix();
  change(target);
  if (!(seconds > 0)) return;
  from_ = std::move(shown);
  fade_seconds_ = seconds, fade_done_ = 0;
}

bool Session::advance(double seconds) {
  if (!from_) return false;
  fade_done_ += seconds;
  if (fade_done_ >= fade_seconds_) stop_fade();
  return true;
}

double Session::fade_progress() const {
  return from_ ? std::min(fade_done_ / fade_seconds_, 1.0) : 1.0;
}

void Session::recall(char slot, double seconds) {
  if (const std::optional<Mood> kept = slot_of(slot)) fade_to(*kept, seconds);
}

Exposure Session::exposure(const Metering& metering) const {
  return mood().automatic ? auto_exposure(metering.log_mean, metering.maximum, mood().stops)
                          : ev100_exposure(mood().ev100, metering.maximum);
}

void Session::meter_once(const Metering& metering) {
  Mood held = mood();
  const Exposure metered = auto_exposure(metering.log_mean, metering.maximum, held.stops);
  held.automatic = false, held.stops = 0;
  // Of 0.01 EV, so that a preset holds the very value.
  held.ev100 = std::round(100 * ev100_of(metered)) / 100;
  change(held);
}

std::size_t Session::group(std::string_view name) const {
  std::vector<std::string> names;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    if (groups_[g].name == name) return g;
    names.push_back(groups_[g].name);
  }
  throw UsageError({}, "unknown light group '" + std::string(name) + "'" + did_you_mean(name, names),
                   join(names, ", "));
}

bool Session::perform(const Action& action) {
  const auto& [word, arguments, where] = action;
  Mood next = mood();
  const auto fader = [&]() -> Fader& { return next.faders.groups[group(arguments.at(0))]; };
  if (word == "undo") return undo(), true;
  if (word == "redo") return redo(), true;
  if (word == "keep") return keep(slot_in(action)), true;
  if (word == "recall") return recall(slot_in(action), seconds_in(action, 1)), true;
  if (word == "preset") {
    fade_to(to_mood(groups_, read_preset(arguments.at(0)), mood(), lamps_), seconds_in(action, 1));
    return true;
  }
  if (word == "save") {
    write_file(arguments.at(0), print_preset(to_preset(groups_, mood(), "", lamps_)));
    return true;
  }
  if (word == "set") {
    for (const std::string& text : arguments) {
      make_mix(groups_, std::vector{text}, "", {});  // says what is wrong
      for (std::size_t g = 0; g < groups_.size(); ++g)
        if (names_group(groups_, text, groups_[g].name))
          next.faders.groups[g] =
              with_setting(next.faders.groups[g], groups_[g], text.substr(text.rfind('=') + 1));
    }
  } else if (word == "solo") {
    fader().solo = !fader().solo;
  } else if (word == "mute") {
    fader().mute = !fader().mute;
  } else if (word == "master") {
    next.faders.master = parse_setting(arguments.at(0)).gain;
  } else if (word == "ev100") {
    next.automatic = false, next.ev100 = number_in(action, 0, -64, 64);
  } else if (word == "auto") {
    next.automatic = true, next.stops = arguments.empty() ? 0 : number_in(action, 0, -64, 64);
  } else if (word == "tone") {
    next.tone = find_tone_mapper(arguments.at(0)).name;
  } else {
    return false;
  }
  change(next);
  return true;
}

}  // namespace sconce
