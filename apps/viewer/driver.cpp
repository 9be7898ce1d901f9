// SPDX-License-Identifier: Apache-2.0
#include "viewer/driver.h"

#include <fmt/format.h>

#include <utility>

#include "core/error.h"
#include "core/files.h"
#include "core/text.h"
#include "image/io.h"
#include "viewer/viewer.h"

namespace sconce::viewer {

namespace {

std::vector<float> numbers(const Action& action, std::size_t i, std::size_t fewest) {
  std::vector<float> found;
  for (const std::string& part : split(action.arguments.at(i), ','))
    if (const auto value = parse_number(trim(part))) found.push_back(static_cast<float>(*value));
  if (found.size() < fewest)
    throw UsageError(action.where, "'" + action.arguments[i] + "' is not understood",
                     std::to_string(fewest) + " numbers with commas between");
  return found;
}

/// In the order of kGrips.
constexpr std::array<std::string_view, 4> kGripNames{"floor", "x", "y", "z"};

}  // namespace

bool Driver::step() {
  Viewer& v = *viewer_;
  v.hands_->keys.clear(), v.hands_->text.clear(), v.hands_->control = v.hands_->shift = false;
  if (shooting_) {
    if (v.shot_) write_png(actions_[at_ - 1].arguments.at(0), *v.shot_);
    shooting_ = false;
  }
  if (path_at_ < path_.size()) {
    const auto [x, y] = path_[path_at_];
    v.hands_->mouse = ImVec2(x, y);
    v.hands_->left = path_at_ > 0 && path_at_ + 1 < path_.size();  // over it, down, along, up
    ++path_at_;
    return true;
  }
  if (frames_ > 0) return --frames_, true;
  if (until_ > ImGui::GetTime()) return true;
  if (settling_) {
    const bool moving = v.drawing_more_ || v.opening_.running() || v.baking_.running() ||
                        v.measuring_.running() || v.preparing_.running() || v.refining_.running() ||
                        v.mirroring_.running() || v.turning_ || v.filming_.running() || v.objects_moving() ||
                        (v.state_.lamps.mover && v.state_.lamps.mover->rough());
    if (moving) return true;
    settling_ = false;
  }
  if (at_ >= actions_.size()) return false;
  const Action& action = actions_[at_++];
  // What a package's state is asked for before it is there waits for it.
  if (!v.state_.ready() && !v.state_.coming.empty() && action.word != "screenshot" &&
      action.word != "frames" && action.word != "wait" && action.word != "key" && action.word != "drop") {
    if (const std::string problem = v.state_.notes.empty() ? "" : v.state_.notes.back().first;
        !problem.empty())
      throw Error(action.where, problem);
    --at_;
    return true;
  }
  return perform(action);
}

void Driver::drag(float x0, float y0, float x1, float y1) {
  constexpr int kSteps = 8;
  path_ = {{x0, y0}};
  for (int i = 0; i <= kSteps; ++i) {
    const float t = static_cast<float>(i) / kSteps;
    path_.emplace_back(x0 + t * (x1 - x0), y0 + t * (y1 - y0));
  }
  path_.emplace_back(x1, y1);
  path_at_ = 0;
}

bool Driver::tug(const Action& action) {
  Viewer& v = *viewer_;
  State& s = v.state_;
  const auto& [word, arguments, where] = action;
  const auto named = std::find(kGripNames.begin(), kGripNames.end(), arguments[0]);
  if (named == kGripNames.end())
    throw UsageError(where, "unknown handle '" + arguments[0] + "'", "x, y, z, floor");
  std::optional<Vec3> place;
  if (!s.objects.chosen.empty())
    place = v.object_place();
  else if (s.lamps.chosen && s.lamps.mover)
    place = s.lamps.mover->place(*s.lamps.chosen, s.session->mood().moved);
  else
    throw Error(where, "nothing is chosen", "grab LAMP, pick OBJECT");
  const auto tip = place ? v.handle_at(*place, kGrips[static_cast<std::size_t>(named - kGripNames.begin())])
                         : std::nullopt;
  if (!tip) throw Error(where, "that handle is not in sight");
  const auto by = numbers(action, 1, 2);
  return drag(tip->x, tip->y, tip->x + by[0], tip->y + by[1]), true;
}

bool Driver::object(const Action& action) {
  Viewer& v = *viewer_;
  const auto& [word, arguments, where] = action;
  if (word == "objects") {
    if (v.objects_pending()) return --at_, frames_ = 1, true;
    std::string lines;
    if (const ObjectMover* mover = v.state_.objects.mover.get())
      for (const std::string& line : object_options(*mover)) lines += line + "\n";
    return write_file(arguments[0], lines), true;
  }
  v.choose_object(arguments[0], where);
  if (word == "object") {
    const auto to = numbers(action, 1, 3);
    v.move_object({to[0], to[1], to[2]}, to.size() > 3 ? to[3] : 0, false);
  }
  return frames_ = 1, true;
}

bool Driver::lamp(const Action& action) {
  Viewer& v = *viewer_;
  State& s = v.state_;
  const auto& [word, arguments, where] = action;
  if (!s.lamps.mover) {
    if (v.preparing_.running()) return --at_, true;  // it is being read
    v.light_lamps();                                 // it has just been
    if (!s.lamps.mover)
      throw Error(where, "lamps of this package stay where they are: it has no operator",
                  "sconce bake --movable, sconce transfer");
  }
  const LampMover& mover = *s.lamps.mover;
  if (word == "moves") {
    std::string lines;
    for (const std::string& line : move_options(mover, s.session->mood().moved)) lines += line + "\n";
    if (!mover.problem().empty()) lines += "# " + mover.problem() + "\n";
    return write_file(arguments[0], lines), true;
  }
  const std::vector<std::size_t> found = mover.find(arguments[0], where);
  s.lamps.chosen = found.front(), s.objects.chosen.clear();
  if (word == "kind") {
    for (const std::size_t lamp : found) v.set_kind(lamp, arguments[1] == "own" ? "" : arguments[1]);
    if (const std::string& problem = s.lamps.mover->problem(); !problem.empty()) throw Error(where, problem);
  }
  if (word == "aim") {
    const auto to = numbers(action, 1, 3);
    for (const std::size_t lamp : found) v.aim_lamp(lamp, {to[0], to[1], to[2]});
  }
  if (word == "lamp") {
    const auto to = numbers(action, 1, 3);
    v.move_lamp(found.front(), {to[0], to[1], to[2]}, false);
  }
  return frames_ = 1, true;
}

bool Driver::perform(const Action& action) {
  Viewer& v = *viewer_;
  State& s = v.state_;
  const auto& [word, arguments, where] = action;
  if (s.session && s.session->perform(action)) return frames_ = 1, true;
  if (word == "quit") return false;
  if (word == "frames") return frames_ = static_cast<int>(numbers(action, 0, 1)[0]), true;
  if (word == "wait") return until_ = ImGui::GetTime() + static_cast<double>(numbers(action, 0, 1)[0]), true;
  if (word == "settle") return frames_ = 2, settling_ = true;
  if (word == "drop") return v.drop(arguments[0]), frames_ = 2, true;
  if (word == "screenshot") return v.want_shot_ = shooting_ = true;
  if (word == "key") {
    for (const std::string& part : split(lower(arguments[0]), '+')) {
      if (part == "ctrl")
        v.hands_->control = true;
      else if (part == "shift")
        v.hands_->shift = true;
      else if (const int key = key_of(part))
        v.hands_->keys.insert(key);
      else
        throw UsageError(where, "unknown key '" + part + "'",
                         "a to z, 0 to 9, f1 to f12, space, escape, tab, ctrl, shift");
    }
    frames_ = 1;  // and lets go
    return true;
  }
  if (word == "type") return v.hands_->text = arguments[0], frames_ = 1, true;
  if (word == "move" || word == "click") {
    const auto at = numbers(action, 0, 2);
    if (word == "click")
      drag(at[0], at[1], at[0], at[1]);
    else
      v.hands_->mouse = ImVec2(at[0], at[1]), frames_ = 2;
    return true;
  }
  if (word == "drag") {
    const auto from = numbers(action, 0, 2), to = numbers(action, 1, 2);
    return drag(from[0], from[1], to[0], to[1]), true;
  }
  if (!s.ready()) throw Error(where, word + " needs an open package or picture");
  if (word == "pull") {
    const auto place = s.fader_places.find(s.session->groups()[s.session->group(arguments[0])].name);
    if (place == s.fader_places.end()) throw Error(where, "that fader is not shown");
    const float y = place->second.y + 0.5f * place->second.w;
    const double stops = stops_of(s.session->mood().faders.groups[s.session->group(arguments[0])].gain);
    const float x = place->second.x + place->second.z * static_cast<float>((stops - kLowestStop) /
                                                                           (kHighestStop - kLowestStop));
    return drag(x, y, x + numbers(action, 1, 1)[0], y), true;
  }
  if (word == "picture") return v.write_picture(arguments[0]), true;
  if (word == "times") {
    std::string lines = "own_ms,drawing_ms\n";
    for (const auto& [own, drawing] : std::exchange(v.times_, {}))
      lines += fmt::format("{:.3f},{:.3f}\n", own, drawing);
    return write_file(arguments[0], lines), true;
  }
  if (word == "hold") return s.session->meter_once(v.metering_now()), frames_ = 1, true;
  if (word == "look") return v.set_look(find_look(arguments[0]).kind), frames_ = 1, true;
  if (word == "scale") {
    FalseColor scale = s.scale();
    scale.low = numbers(action, 0, 1)[0], scale.high = numbers(action, 1, 1)[0];
    scale.decades = arguments.size() > 2;
    scale.check();
    return s.scale() = scale, frames_ = 1, true;
  }
  if (word == "lines") return s.scale().lines = arguments[0] == "on", frames_ = 1, true;
  if (word == "like") return v.seek_picture(arguments[0]), frames_ = 1, true;
  if (s.sheet) throw Error(where, word + " needs a package: a picture has one view and no surfaces");
  if (word == "camera")
    return s.camera = *find_camera(s.opened->rays.scene(), arguments[0]), frames_ = 1, true;
  if (word == "eye") {
    const auto eye = numbers(action, 0, 3), target = numbers(action, 1, 3);
    const float yfov = s.camera.yfov;
    s.camera = look_at({eye[0], eye[1], eye[2]}, {target[0], target[1], target[2]});
    s.camera.yfov = yfov;
    return frames_ = 1, true;
  }
  if (word == "turntable") {
    const int count = static_cast<int>(numbers(action, 1, 1)[0]);
    if (count < 2) throw UsageError(where, "a turn has at least two pictures", "turntable FILE N");
    return v.begin_turn(arguments[0], count), true;
  }
  if (word == "plane") {
    for (const MeasuredPlane& baked : s.opened->planes)
      if (baked.name == arguments[0]) return v.show_plane(baked), frames_ = 1, true;
    if (!parse_number(arguments[0])) {
      std::vector<std::string> names;
      for (const MeasuredPlane& baked : s.opened->planes) names.push_back(baked.name);
      throw UsageError(where, "there is no plane '" + arguments[0] + "'",
                       "a height in metres; baked: " + (names.empty() ? "none" : join(names, ", ")));
    }
    s.plane.height = numbers(action, 0, 1)[0];
    if (arguments.size() > 1) s.plane.spacing = numbers(action, 1, 1)[0];
    return v.show_plane(), frames_ = 1, true;
  }
  if (word == "ball") {
    const auto at = numbers(action, 0, 3);
    return v.place_ball({at[0], at[1], at[2]}, arguments.size() > 1 ? numbers(action, 1, 1)[0] : 0.1f),
           frames_ = 1, true;
  }
  if (word == "figures") return v.write_figures(arguments[0]), true;
  if (word == "wish") {
    const auto at = numbers(action, 0, 3);
    const Vec3 position(at[0], at[1], at[2]),
        normal = at.size() >= 6 ? glm::normalize(Vec3(at[3], at[4], at[5])) : Vec3(0, 1, 0);
    PointMeter meter(s.opened->rays, {{position, normal, normal}}, ReceiverKind::plane);
    meter.pass(4096, {});
    return v.add_goal(position, normal, static_cast<double>(numbers(action, 1, 1)[0]), meter.light().values),
           true;
  }
  if (word == "tug") return tug(action);
  if (word == "home") return v.put_back(), frames_ = 1, true;
  if (word == "object" || word == "pick" || word == "objects") return object(action);
  if (word == "lamp" || word == "kind" || word == "aim" || word == "grab" || word == "moves")
    return lamp(action);
  if (word == "seek") return v.seek(), frames_ = 1, true;
  if (word == "scene") return v.save_scene(arguments[0]), true;
  if (word == "package") return v.save_package(arguments[0]), true;
  throw Error(where, "the window does not know '" + word + "'");
}

}  // namespace sconce::viewer
