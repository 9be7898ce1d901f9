// SPDX-License-Identifier: Apache-2.0
// Lamps over the picture: chosen by a click, dragged by handles, their light following.
#include <fmt/format.h>

#include "core/error.h"
#include "relight/package_operator.h"
#include "viewer/viewer.h"
#include "viewer/widgets.h"

namespace sconce::viewer {

void Viewer::forget_lamps() {
  refining_.stop(), preparing_.stop();
  state_.lamps = {};
}

void Viewer::prepare_lamps() {
  forget_lamps();
  if (!std::filesystem::exists(operator_path(state_.package, ""))) return;
  preparing_.start([opened = state_.opened](const Progress& progress, const auto& publish) {
    publish(std::make_shared<const Movable>(opened, progress));
  });
}

void Viewer::light_lamps() {
  if (auto movable = preparing_.take()) {
    state_.lamps.home = *movable;
    state_.lamps.mover = std::make_unique<LampMover>(
        *movable, [this](std::size_t lamp, const MovedLamp& state) { return other_lamp(lamp, state); });
    light_lamps_among_objects();
  }
  LampMover* mover = state_.lamps.mover.get();
  if (mover == nullptr) return;
  if (const auto fine = refining_.take()) {
    mover->refine(*fine);
    if (fine->inside)
      note("lamp '" + mover->movable().lamps.all()[fine->task.lamp].name + "' stands inside something");
  }
  watch_lamp_files();
  mover->follow(state_.session->mood().moved);
  if (const std::string problem = mover->problem(); problem != state_.lamps.problem) {
    state_.lamps.problem = problem;
    if (!problem.empty()) note(problem);
  }
  const auto rough = mover->rough();
  if (!rough || refining_.running() || state_.dragging()) return;
  refining_.start([movable = mover->shared(), task = *rough](const Progress& progress, const auto& publish) {
    publish(LampMover::light(*movable, task, progress));
  });
}

void Viewer::move_lamp(std::size_t lamp, const Vec3& to, bool gesture) {
  const Bounds& room = state_.opened->rays.world().bounds;
  Mood mood = state_.session->mood();
  mood.moved[lamp].at = glm::clamp(to, room.lo, room.hi);
  state_.session->change(mood, gesture ? fmt::format("lamp {}", lamp) : "");
}

void Viewer::aim_lamp(std::size_t lamp, const Vec3& target) {
  Mood mood = state_.session->mood();
  const auto found = mood.moved.find(lamp);
  const bool own = found == mood.moved.end() || found->second.kind.empty();
  const LampMover& mover = *state_.lamps.mover;
  if (own && !axis_of(mover.movable().lamps.all()[lamp]))
    throw Error("lamp '" + mover.movable().names[lamp] + "'", "shines all around: make a spot of it first");
  const Vec3 at = mover.place(lamp, mood.moved).value_or(Vec3(0));
  mood.moved[lamp].at = at, mood.moved[lamp].target = target;
  state_.session->change(mood);
}

void Viewer::put_back() {
  Mood mood = state_.session->mood();
  if (!state_.objects.chosen.empty())
    mood.objects.erase(state_.objects.chosen);
  else if (state_.lamps.chosen)
    mood.moved.erase(*state_.lamps.chosen);
  else
    return;
  state_.session->change(mood);
}

bool Viewer::hold_lamp(Vec2 at) {
  MovingLamps& lamps = state_.lamps;
  if (lamps.mover == nullptr) return false;
  const ImGuiIO& io = ImGui::GetIO();
  const MovedPlaces& moved = state_.session->mood().moved;
  if (ImGui::IsItemActivated() && io.MouseDown[0] && !io.KeyCtrl && !io.KeyShift) {
    if (lamps.chosen) take_grip(lamps.drag, lamps.mover->place(*lamps.chosen, moved).value_or(Vec3(0)), at);
    const Lens from = lens();
    for (std::size_t i = 0; i < lamps.mover->movable().lamps.size() && !lamps.drag.held; ++i) {
      const auto place = lamps.mover->place(i, moved);
      const auto spot = place ? project(from, *place) : std::nullopt;
      if (spot && glm::distance(*spot, at) <= px(kNear))
        lamps.chosen = i, lamps.drag.held = true, state_.objects.chosen.clear();
    }
  }
  if (!lamps.drag.held) return false;
  if (ImGui::IsItemActive()) {
    if (lamps.drag.grip != Grip::none && at != lamps.drag.from)
      move_lamp(*lamps.chosen, dragged(lamps.drag.grip, lamps.drag.start, lens(), lamps.drag.from, at), true);
  } else {
    lamps.drag = {};
    state_.session->end_gesture();
  }
  return true;
}

void Viewer::lamp_overlay() {
  const MovingLamps& lamps = state_.lamps;
  if (lamps.mover == nullptr || !lamps.shown) return;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const Lens from = lens();
  const MovedPlaces& moved = state_.session->mood().moved;
  for (std::size_t i = 0; i < lamps.mover->movable().lamps.size(); ++i) {
    const auto place = lamps.mover->place(i, moved);
    const auto spot = place ? on_screen(from, *place) : std::nullopt;
    if (!spot) continue;
    draw.AddCircle(*spot, px(6), IM_COL32(0, 0, 0, 160), 24, px(3));
    draw.AddCircle(*spot, px(6), moved.contains(i) ? palette::kAccent : palette::kText, 24, px(1.5f));
  }
  if (!lamps.chosen) return;
  const auto place = lamps.mover->place(*lamps.chosen, moved);
  const auto middle = place ? on_screen(from, *place) : std::nullopt;
  if (!middle) return;
  const auto state = moved.find(*lamps.chosen);
  const auto target =
      state != moved.end() && state->second.target ? on_screen(from, *state->second.target) : std::nullopt;
  if (target) {
    draw.AddLine(*middle, *target, IM_COL32(0, 0, 0, 140), px(3));
    draw.AddLine(*middle, *target, faded(palette::kAccent, 0.8f), px(1.2f));
    draw.AddCircle(*target, px(4), palette::kAccent, 16, px(1.5f));
  }
  draw_handles(*place, lamps.drag.grip, lamps.mover->movable().lamps.all()[*lamps.chosen].name);
}

}  // namespace sconce::viewer
