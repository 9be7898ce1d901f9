// SPDX-License-Identifier: Apache-2.0
// Lamps over the picture: chosen by a click, dragged by handles, their light following.
#include <fmt/format.h>

#include "core/error.h"
#include "relight/package_operator.h"
#include "viewer/viewer.h"
#include "viewer/widgets.h"

namespace sconce::viewer {

namespace {

constexpr float kArrow = 78, kNear = 9;  // pixels

ImU32 color_of(Grip grip) {
  switch (grip) {
    case Grip::x:
      return IM_COL32(232, 92, 84, 255);
    case Grip::y:
      return IM_COL32(128, 204, 96, 255);
    case Grip::z:
      return IM_COL32(96, 152, 240, 255);
    default:
      return palette::kAccent;
  }
}

}  // namespace

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
  if (auto movable = preparing_.take())
    state_.lamps.mover = std::make_unique<LampMover>(
        *movable, [this](std::size_t lamp, const MovedLamp& state) { return other_lamp(lamp, state); });
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
  if (!rough || refining_.running() || state_.lamps.grip != Grip::none) return;
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

void Viewer::put_lamp_back() {
  if (!state_.lamps.chosen) return;
  Mood mood = state_.session->mood();
  mood.moved.erase(*state_.lamps.chosen);
  state_.session->change(mood);
}

Lens Viewer::lens() const {
  return Lens(state_.camera, {.width = std::max(static_cast<int>(state_.canvas_size.x), 1),
                              .height = std::max(static_cast<int>(state_.canvas_size.y), 1)});
}

std::optional<ImVec2> Viewer::on_screen(const Lens& from, const Vec3& point) const {
  const auto at = project(from, point);
  if (!at) return std::nullopt;
  return ImVec2(state_.canvas_at.x + at->x, state_.canvas_at.y + at->y);
}

std::optional<ImVec2> Viewer::handle_at(const Vec3& lamp, Grip grip) const {
  const Lens from = lens();
  return on_screen(from, Gizmo::of(from, lamp, px(kArrow)).tip(grip));
}

bool Viewer::hold_lamp(Vec2 at) {
  MovingLamps& lamps = state_.lamps;
  if (lamps.mover == nullptr) return false;
  const ImGuiIO& io = ImGui::GetIO();
  const MovedPlaces& moved = state_.session->mood().moved;
  const Lens from = lens();
  if (ImGui::IsItemActivated() && io.MouseDown[0] && !io.KeyCtrl && !io.KeyShift) {
    if (lamps.chosen) {
      lamps.start = lamps.mover->place(*lamps.chosen, moved).value_or(Vec3(0));
      lamps.grip = Gizmo::of(from, lamps.start, px(kArrow)).at(from, at, px(kNear));
      lamps.from = at;
    }
    lamps.held = lamps.grip != Grip::none;
    for (std::size_t i = 0; i < lamps.mover->movable().lamps.size() && !lamps.held; ++i) {
      const auto place = lamps.mover->place(i, moved);
      const auto spot = place ? project(from, *place) : std::nullopt;
      if (spot && glm::distance(*spot, at) <= px(kNear)) lamps.chosen = i, lamps.held = true;
    }
  }
  if (!lamps.held) return false;
  if (ImGui::IsItemActive()) {
    if (lamps.grip != Grip::none && at != lamps.from)
      move_lamp(*lamps.chosen, dragged(lamps.grip, lamps.start, from, lamps.from, at), true);
  } else {
    lamps.grip = Grip::none, lamps.held = false;
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
  const Gizmo gizmo = Gizmo::of(from, *place, px(kArrow));
  std::vector<ImVec2> square;
  for (const Vec3& corner : gizmo.square())
    if (const auto p = on_screen(from, corner)) square.push_back(*p);
  const auto lit = [&](Grip grip) { return lamps.grip == grip ? palette::kText : color_of(grip); };
  if (square.size() == 4) {
    draw.AddConvexPolyFilled(square.data(), 4, faded(lit(Grip::floor), 0.35f));
    draw.AddPolyline(square.data(), 4, lit(Grip::floor), ImDrawFlags_Closed, px(1.5f));
  }
  for (const Grip grip : {Grip::x, Grip::y, Grip::z}) {
    const auto tip = on_screen(from, gizmo.tip(grip));
    if (!tip) continue;
    draw.AddLine(*middle, *tip, IM_COL32(0, 0, 0, 140), px(5));
    draw.AddLine(*middle, *tip, lit(grip), px(2.5f));
    draw.AddCircleFilled(*tip, px(5), lit(grip), 16);
  }
  const std::string line =
      fmt::format("{}   {:.2f}, {:.2f}, {:.2f} m", lamps.mover->movable().lamps.all()[*lamps.chosen].name,
                  place->x, place->y, place->z);
  const ImVec2 size = ImGui::CalcTextSize(line.c_str()), corner(middle->x + px(14), middle->y - px(34));
  draw.AddRectFilled({corner.x - px(6), corner.y - px(3)},
                     {corner.x + size.x + px(6), corner.y + size.y + px(3)}, IM_COL32(18, 19, 21, 215),
                     px(5));
  draw.AddText(corner, palette::kText, line.c_str());
}

}  // namespace sconce::viewer
