// SPDX-License-Identifier: Apache-2.0
// Exposure, tone curve, cameras, and what of the package is looked at.
#include <fmt/format.h>

#include "viewer/viewer.h"
#include "viewer/widgets.h"

namespace sconce::viewer {

namespace {

void heading(const char* text) {
  ImGui::Dummy({0, px(4)});
  ImGui::PushFont(fonts().strong);
  ImGui::TextUnformatted(text);
  ImGui::PopFont();
}

}  // namespace

void Viewer::look_panel() {
  Session& session = *state_.session;
  Mood mood = session.mood();
  const float width = ImGui::GetContentRegionAvail().x;

  const float half = 0.5f * (width - ImGui::GetStyle().ItemSpacing.x);
  heading("Exposure");
  if (toggle("held", "Held", !mood.automatic, palette::kAccent, half) && mood.automatic)
    session.meter_once(metering_now());
  tip("stays as it is while faders move; X meters anew");
  ImGui::SameLine();
  if (toggle("auto", "Automatic", mood.automatic, palette::kAccent, half) && !mood.automatic) {
    mood.automatic = true, mood.stops = 0;
    session.change(mood);
  }
  tip("follows the mix, as `sconce render` does");
  mood = session.mood();
  auto value = static_cast<float>(mood.automatic ? mood.stops : mood.ev100);
  if (mood.automatic
          ? slider("##exposure", "Brighter or darker", signed_words(mood.stops, 2) + " EV", &value, -6, 6)
          : slider("##exposure", "EV 100, higher is darker", fmt::format("{:.2f}", mood.ev100), &value, -4,
                   18)) {
    (mood.automatic ? mood.stops : mood.ev100) = static_cast<double>(value);
    session.change(mood, "exposure");
  }
  if (ImGui::IsItemDeactivated()) session.end_gesture();

  heading("Tone curve");
  Rows curves(width);
  for (const ToneMapper& mapper : tone_mappers()) {
    const std::string name(mapper.name);
    if (toggle(name.c_str(), name.c_str(), mood.tone == name, palette::kAccent, curves.next(name))) {
      mood.tone = name;
      session.change(mood);
    }
    tip(std::string(mapper.doc).c_str());
  }

  heading("View");
  for (const LookRow& row : look_rows()) {
    if (state_.sheet && !row.of_pictures) continue;
    if (toggle(std::string(row.name).c_str(), std::string(row.label).c_str(), state_.look == row.kind,
               palette::kAccent, (width - 2 * ImGui::GetStyle().ItemSpacing.x) / 3))
      set_look(row.kind);
    tip(std::string(row.doc).c_str());
    if (state_.sheet ? row.kind == LookKind::picture : static_cast<int>(row.kind) % 3 != 2) ImGui::SameLine();
  }
  if (!row_of(state_.look).unit.empty()) {
    FalseColor scale = state_.scale();
    float ends[] = {scale.low, scale.high};
    ImGui::Dummy({0, px(2)});
    ImGui::SetNextItemWidth(-1);
    if (ImGui::DragFloat2("##scale", ends, std::max(scale.high * 0.01f, 0.001f), 0, 1e7f, "%.4g"))
      scale.low = ends[0], scale.high = ends[1];
    tip("where the scale begins and ends");
    if (state_.look != LookKind::noise) {
      if (ImGui::Button("Fit")) scale = scale_for(state_.look, metering_now(), scale);
      tip("ends the scale where this mix does");
      ImGui::SameLine();
    }
    if (ImGui::Checkbox("by decades", &scale.decades) && scale.decades && !(scale.low > 0))
      scale.low = scale.high * 1e-4f;
    ImGui::SameLine();
    ImGui::Checkbox("iso-lines", &scale.lines);
    if (scale.low >= 0 && scale.high > scale.low && (!scale.decades || scale.low > 0)) state_.scale() = scale;
  }
  if (state_.look == LookKind::reference) {
    ImGui::Dummy({0, px(2)});
    if (ImGui::Button("Trace this view", {half, 0})) refine_reference();
    tip("the right half, path traced from where the camera stands now");
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("%s", traced_ ? fmt::format("{} paths per pixel", traced_->samples).c_str()
                                      : "the first paths are traced");
  }

  if (state_.sheet) return;
  if (const Scene& scene = state_.opened->rays.scene(); scene.has_mirrors() || scene.has_panes()) {
    ImGui::Checkbox("reflections at rest", &state_.reflections);
    tip("what mirrors, metals and glossy surfaces show, by rays, as soon as nothing moves");
  }
  heading("Cameras");
  Rows cameras(width);
  for (const Camera& camera : state_.opened->rays.scene().cameras)
    if (toggle((camera.name + "##camera").c_str(), camera.name.c_str(),
               camera.name == state_.camera.name && camera.frame == state_.camera.frame, palette::kAccent,
               cameras.next(camera.name)))
      state_.camera = camera;
  ImGui::Dummy({0, px(2)});
  auto fov = state_.camera.yfov * 180 / kPi;
  if (slider("##fov", "Field of view", fmt::format("{:.0f}\u00b0", fov), &fov, 10, 120))
    state_.camera.yfov = fov * kPi / 180;
  if (ImGui::Button("All in sight", {half, 0}))
    state_.camera = frame_all(state_.camera, state_.opened->rays.world().bounds);
  ImGui::SameLine();
  if (ImGui::Button(turning_ ? "Stop turning" : "Turntable", {half, 0}))
    turning_ ? stop_turn() : attempt([&] { begin_turn(); });
  tip("the camera turns once, around the scene or on its spot where walls stand in the way: a film where "
      "ffmpeg is installed, else 120 pictures");
}

}  // namespace sconce::viewer
