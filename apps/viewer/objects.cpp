// SPDX-License-Identifier: Apache-2.0
// Objects over the picture: chosen by a key or two clicks, dragged by handles; their shadows follow at once,
// bounces as soon as the operator has.
#include <fmt/format.h>

#include "core/error.h"
#include "core/text.h"
#include "viewer/viewer.h"
#include "viewer/widgets.h"

namespace sconce::viewer {

void Viewer::forget_objects() {
  finding_.stop(), shading_.stop(), following_.stop();
  state_.objects = {};
}

const View& Viewer::rays() const {
  const ObjectMover* mover = state_.objects.mover.get();
  return mover != nullptr && mover->any() ? mover->view() : state_.opened->rays;
}

void Viewer::light_objects() {
  MovingObjects& objects = state_.objects;
  if (!state_.session) return;
  const ObjectMoves& wanted = state_.session->mood().objects;
  const bool finding = finding_.running();
  if (auto mover = finding_.take()) objects.mover = *mover;
  objects.failed = objects.sought && !finding && objects.mover == nullptr;
  if (objects.mover == nullptr) {
    if (wanted.empty() || objects.sought) return;
    objects.sought = true;
    return finding_.start([opened = state_.opened](const Progress& progress, const auto& publish) {
      publish(std::make_shared<ObjectMover>(opened, progress));
    });
  }
  ObjectMover& mover = *objects.mover;
  if (auto fine = shading_.take()) mover.take(std::move(*fine));
  if (auto bounces = following_.take()) {
    if (!bounces->moves.empty())
      note(fmt::format("bounces have followed: {} of {} rows of the cloud and {} of {} of texels made again",
                       bounces->made.slots, bounces->slots, bounces->made.receivers, bounces->receivers));
    mover.take(std::move(*bounces));
    light_lamps_among_objects();
  }
  if (wanted != mover.moves()) {
    // Nobody else may look while things are being moved.
    shading_.stop(), refining_.stop(), tracing_.stop(), mirroring_.stop(), measuring_.stop();
    mirrored_ = 0;
    reference_.reset(), coming_.reset(), traced_.reset();
    mover.place(wanted);
    state_.canvas->follow(mover.view());
    light_lamps_among_objects();
  }
  if (objects.drag.grip != Grip::none) return;
  if (mover.rough() && !shading_.running())
    shading_.start([shared = objects.mover](const Progress& progress, const auto& publish) {
      publish(shared->refined(progress));
    });
  else if (!mover.rough() && mover.behind() && !following_.running())
    following_.start(
        [shared = objects.mover, moves = mover.moves()](const Progress& progress, const auto& publish) {
          publish(shared->follow(moves, progress));
        });
}

void Viewer::light_lamps_among_objects() {
  MovingLamps& lamps = state_.lamps;
  const ObjectMover* mover = state_.objects.mover.get();
  if (lamps.mover == nullptr || mover == nullptr) return;
  refining_.stop();
  if (!mover->any()) return lamps.mover->set_movable(lamps.home);
  ObjectBounces bounces;
  bounces.op = {lamps.home, &lamps.home->op}, bounces.folded = lamps.home->bounces;
  if (mover->bounces()) bounces.op = mover->bounces()->op, bounces.folded = mover->bounces()->folded;
  lamps.mover->set_movable(std::make_shared<const Movable>(
      state_.opened, mover->view(), bounces, mover->objects().atlas(), mover->objects().texels()));
}

void Viewer::choose_object(const std::string& name, const std::string& where) {
  const Vec3 middle = middle_of_object(state_.opened->rays, name, where);
  state_.objects.chosen = name, state_.objects.home = middle;
  state_.lamps.chosen.reset();
}

Vec3 Viewer::object_place() const {
  const ObjectMoves& moves = state_.session->mood().objects;
  const auto moved = moves.find(state_.objects.chosen);
  return state_.objects.home + (moved != moves.end() ? moved->second.by : Vec3(0));
}

float Viewer::object_turn() const {
  const ObjectMoves& moves = state_.session->mood().objects;
  const auto moved = moves.find(state_.objects.chosen);
  return moved != moves.end() ? moved->second.turn : 0;
}

void Viewer::move_object(const Vec3& to, float turn, bool gesture) {
  const Bounds& room = state_.opened->rays.world().bounds;
  const std::string& name = state_.objects.chosen;
  Mood mood = state_.session->mood();
  const Vec3 by = glm::clamp(to, room.lo, room.hi) - state_.objects.home;
  const ObjectMove move{by, std::remainder(turn, 360.0f)};
  mood.objects[name] = move;
  if (move == ObjectMove()) mood.objects.erase(name);
  state_.session->change(mood, gesture ? "object " + name : "");
}

bool Viewer::hold_object(Vec2 at) {
  MovingObjects& objects = state_.objects;
  if (objects.chosen.empty()) return false;
  const ImGuiIO& io = ImGui::GetIO();
  if (ImGui::IsItemActivated() && io.MouseDown[0] && !io.KeyCtrl && !io.KeyShift)
    take_grip(objects.drag, object_place(), at);
  if (!objects.drag.held) return false;
  if (ImGui::IsItemActive()) {
    if (at != objects.drag.from)
      move_object(dragged(objects.drag.grip, objects.drag.start, lens(), objects.drag.from, at),
                  object_turn(), true);
  } else {
    objects.drag = {};
    state_.session->end_gesture();
  }
  return true;
}

bool Viewer::objects_pending() const {
  if (!state_.session || !state_.opened || state_.objects.failed) return false;
  const ObjectMover* mover = state_.objects.mover.get();
  return (mover != nullptr ? mover->moves() : ObjectMoves()) != state_.session->mood().objects;
}

bool Viewer::objects_moving() const {
  const ObjectMover* mover = state_.objects.mover.get();
  return objects_pending() || shading_.running() || following_.running() ||
         (mover != nullptr && (mover->rough() || mover->behind()));
}

std::string Viewer::behind() const {
  const ObjectMover* mover = state_.objects.mover.get();
  if (finding_.running())
    return fmt::format("looking what lies under things: {} {:.0f} %", finding_.stage(),
                       100 * finding_.done());
  if (mover == nullptr || !mover->behind()) return {};
  std::string line = "bounces are still those of the object's old place";
  if (following_.running())
    line += fmt::format(", the operator follows: {} {:.0f} %", following_.stage(), 100 * following_.done());
  return line;
}

void Viewer::object_overlay() {
  const MovingObjects& objects = state_.objects;
  if (!objects.chosen.empty()) draw_handles(object_place(), objects.drag.grip, objects.chosen);
  const std::string line = behind();
  if (line.empty()) return;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float wide = width_of(fonts().strong, line);
  const ImVec2 at(state_.canvas_at.x + 0.5f * (state_.canvas_size.x - wide), state_.canvas_at.y + px(14));
  card(draw, {at.x - px(14), at.y - px(6)}, {wide + px(28), px(32)});
  text(draw, fonts().strong, at, palette::kAccent, line);
}

void Viewer::object_section() {
  MovingObjects& objects = state_.objects;
  ImGui::PushFont(fonts().strong);
  ImGui::TextUnformatted("Object");
  ImGui::PopFont();
  ImGui::SetNextItemWidth(-1);
  if (ImGui::BeginCombo("##object", objects.chosen.empty() ? "O over one, or choose" : objects.chosen.c_str(),
                        ImGuiComboFlags_HeightLarge)) {
    for (const std::string& name : object_names(state_.opened->rays.scene()))
      if (ImGui::Selectable(name.c_str(), name == objects.chosen)) choose_object(name);
    ImGui::EndCombo();
  }
  if (!objects.chosen.empty()) {
    Vec3 at = object_place();
    ImGui::SetNextItemWidth(-px(80));
    float turn = object_turn();
    if (ImGui::DragFloat3("##place", &at.x, 0.01f, 0, 0, "%.2f m")) move_object(at, turn, true);
    if (ImGui::IsItemDeactivatedAfterEdit()) state_.session->end_gesture();
    ImGui::SetNextItemWidth(-px(80));
    if (ImGui::DragFloat("##turn", &turn, 1, 0, 0, "turned by %.0f\xc2\xb0")) move_object(at, turn, true);
    if (ImGui::IsItemDeactivatedAfterEdit()) state_.session->end_gesture();
    tip("about the vertical through its middle; the key R by 15 degrees, Shift R back");
    ImGui::SameLine();
    if (ImGui::Button("Home", {-1, 0})) put_back();
    tip("its shadow follows at once, bounces when the operator has followed");
  }
  ImGui::Dummy({0, px(6)});
  ImGui::Separator();
}

}  // namespace sconce::viewer
