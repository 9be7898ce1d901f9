// SPDX-License-Identifier: Apache-2.0
// What keys do; bars.cpp lists them for people.
#include "viewer/viewer.h"

namespace sconce::viewer {

namespace {

constexpr float kTurn = 15;  // degrees, of an object

}  // namespace

void Viewer::keys() {
  const ImGuiIO& io = ImGui::GetIO();
  if (io.WantTextInput) return;
  const auto pressed = [](const char* name) { return ImGui::IsKeyPressed(key_of(name), false); };
  if (pressed("f1")) state_.help = !state_.help;
  if (pressed("escape"))
    state_.help = false, state_.lamps.chosen.reset(), state_.objects.chosen.clear(), stop_turn();
  if (!state_.ready()) return;
  Session& session = *state_.session;
  if (io.KeyCtrl) {
    if (pressed("z")) io.KeyShift ? session.redo() : session.undo();
    if (pressed("y")) session.redo();
    if (pressed("s")) attempt([&] { save_preset(); });
    return;
  }
  if (pressed("tab")) state_.panels = !state_.panels;
  if (pressed("l")) state_.lamps.shown = !state_.lamps.shown;
  if (pressed("h")) put_back();
  if (pressed("r") && !state_.objects.chosen.empty())
    move_object(object_place(), object_turn() + (io.KeyShift ? -kTurn : kTurn), false);
  if (pressed("t") && state_.lamps.chosen && state_.under && state_.under->surface)
    attempt([&] { aim_lamp(*state_.lamps.chosen, state_.under->position); });
  if (pressed("i")) state_.reading = !state_.reading;
  if (pressed("x")) session.meter_once(metering_now());
  if (pressed("p") || pressed("f12")) attempt([&] { screenshot(); });
  for (std::size_t i = 0; i < look_rows().size(); ++i)
    if (pressed(std::to_string(i + 1).c_str())) set_look(look_rows()[i].kind);
  if (state_.sheet) {
    if (pressed("f")) state_.place = {};
    return;
  }
  if (pressed("o") && state_.under && !state_.under->object.empty()) choose_object(state_.under->object);
  if (pressed("f")) state_.camera = frame_all(state_.camera, rays().world().bounds);
  const std::vector<Camera>& cameras = state_.opened->rays.scene().cameras;
  if (pressed("c") && !cameras.empty()) {
    std::size_t next = 0;
    for (std::size_t i = 0; i < cameras.size(); ++i)
      if (cameras[i].name == state_.camera.name) next = (i + 1) % cameras.size();
    state_.camera = cameras[next];
  }
}

}  // namespace sconce::viewer
