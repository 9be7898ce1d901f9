// SPDX-License-Identifier: Apache-2.0
// Lux on a plane while faders move, and faders moved to what is wished for.
#include <fmt/format.h>

#include <algorithm>

#include "viewer/viewer.h"
#include "viewer/widgets.h"

namespace sconce::viewer {

namespace {

const ImVec4 kWarning{1, 0.55f, 0.4f, 1};

void figure(const char* label, const std::string& value, bool first) {
  if (!first) ImGui::SameLine(0, px(18));
  ImGui::BeginGroup();
  ImGui::PushFont(fonts().large);
  ImGui::TextUnformatted(value.c_str());
  ImGui::PopFont();
  ImGui::PushFont(fonts().small);
  ImGui::TextDisabled("%s", label);
  ImGui::PopFont();
  ImGui::EndGroup();
}

}  // namespace

/// How far figures know what was moved.
void Viewer::standing_line() {
  if (!state_.away()) return;
  ImGui::PushFont(fonts().small);
  if (measuring_.running()) ImGui::TextDisabled("measuring all as it stands now");
  ImGui::PopFont();
}

/// What is known of baked planes follows the faders exactly: nothing is traced.
void Viewer::baked_section() {
  if (state_.opened->planes.empty()) return;
  const MixSpec mix = state_.session->mix();
  ImGui::PushFont(fonts().strong);
  ImGui::TextUnformatted("Baked planes");
  ImGui::PopFont();
  constexpr const char* kHeads[] = {"lux", "average", "minimum", "maximum", "U0"};
  if (!ImGui::BeginTable("planes", 5, ImGuiTableFlags_SizingStretchProp)) return;
  for (const char* head : kHeads) ImGui::TableSetupColumn(head);
  ImGui::TableHeadersRow();
  for (const MeasuredPlane& baked : state_.planes) {
    ImGui::TableNextColumn();
    const bool shown = state_.plane.shown && state_.plane.measured.name == baked.name;
    if (ImGui::Selectable(baked.name.c_str(), shown, ImGuiSelectableFlags_SpanAllColumns)) {
      if (shown)
        state_.plane.shown = false;
      else
        show_plane(baked);
    }
    const LuxStatistics s = plane_statistics(baked.light, mix);
    for (const std::string& value :
         {fmt::format("{:.0f}", s.average), fmt::format("{:.0f}", s.minimum),
          fmt::format("{:.0f}", s.maximum), fmt::format("{:.2f}", s.uniformity())}) {
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(value.c_str());
    }
  }
  ImGui::EndTable();
  standing_line();
  ImGui::Dummy({0, px(6)});
  ImGui::Separator();
}

void Viewer::plane_section() {
  Plane& plane = state_.plane;
  const MixSpec mix = state_.session->mix();
  ImGui::PushFont(fonts().strong);
  ImGui::TextUnformatted("Measuring plane");
  ImGui::PopFont();
  const bool shown = plane.shown && plane.measured.name.empty();
  const float width = ImGui::GetContentRegionAvail().x;
  if (toggle("plane", shown ? "On" : "Off", shown, palette::kAccent, px(54))) {
    if (shown)
      plane.shown = false, measure();
    else
      show_plane();
  }
  ImGui::SameLine();
  ImGui::SetNextItemWidth(0.36f * width);
  ImGui::DragFloat("##height", &plane.height, 0.01f, 0, 100, "%.2f m high");
  bool again = ImGui::IsItemDeactivatedAfterEdit();
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-1);
  ImGui::DragFloat("##spacing", &plane.spacing, 0.01f, 0.05f, 10, "every %.2f m");
  again |= ImGui::IsItemDeactivatedAfterEdit();
  if (again && shown) show_plane();
  const MeasuredLight& light = plane.measured.light;
  if (shown && light.samples > 0) {
    const LuxStatistics s = plane_statistics(light, mix);
    figure("average lux", fmt::format("{:.0f}", s.average), true);
    figure("minimum", fmt::format("{:.0f}", s.minimum), false);
    figure("maximum", fmt::format("{:.0f}", s.maximum), false);
    figure("uniformity", fmt::format("{:.2f}", s.uniformity()), false);
    ImGui::PushFont(fonts().small);
    ImGui::TextDisabled(
        "%s", fmt::format("{} x {} points, {} paths each{}", plane.measured.grid.columns,
                          plane.measured.grid.rows, light.samples, measuring_.running() ? ", measuring" : "")
                  .c_str());
    ImGui::PopFont();
    standing_line();
  }
  ImGui::Dummy({0, px(6)});
  ImGui::Separator();
}

void Viewer::design_panel() {
  if (!state_.sheet) baked_section(), plane_section(), lamp_section(), object_section();
  const MixSpec mix = state_.session->mix();
  const float width = ImGui::GetContentRegionAvail().x;
  ImGui::PushFont(fonts().strong);
  ImGui::TextUnformatted("Goals");
  ImGui::PopFont();
  ImGui::PushFont(fonts().small);
  ImGui::PushTextWrapPos();
  ImGui::TextDisabled("%s", state_.sheet ? "Drop a picture of the same view to wish for its mood."
                                         : "Ctrl-click a surface to wish for lux there; drop a picture to "
                                           "wish for its mood.");
  ImGui::PopTextWrapPos();
  ImGui::PopFont();
  for (std::size_t i = 0; i < state_.goals.size(); ++i) {
    Goal& goal = state_.goals[i];
    ImGui::PushID(static_cast<int>(i));
    float now = 0;
    for (std::size_t g = 0; g < goal.lux.size(); ++g) now += luminance(mix.weights[g] * goal.lux[g]);
    auto target = static_cast<float>(goal.target);
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(fmt::format("{}", i + 1).c_str());
    ImGui::SameLine(px(24));
    ImGui::SetNextItemWidth(0.4f * width);
    if (ImGui::DragFloat("##target", &target, 2, 0, 1e6f, "%.0f lux"))
      goal.target = static_cast<double>(target);
    ImGui::SameLine();
    if (std::all_of(goal.lux.begin(), goal.lux.end(), [](const Rgb& e) { return e.is_black(); }))
      ImGui::TextColored(kWarning, "no light gets there");
    else
      ImGui::TextDisabled("%s", fmt::format("now {:.0f}", now).c_str());
    ImGui::SameLine(width - px(24));
    const bool gone = ImGui::SmallButton("x");
    ImGui::PopID();
    if (gone) {
      state_.goals.erase(state_.goals.begin() + static_cast<std::ptrdiff_t>(i));
      if (state_.away()) measure();
      break;
    }
  }
  if (!state_.goals.empty()) standing_line();
  if (!state_.goals.empty() && ImGui::Button("Move faders, least power", {-1, 0})) seek();
  if (!state_.sought.empty() && state_.sought_faders == state_.session->mood().faders)
    ImGui::TextDisabled("%s", state_.sought.c_str());
  if (state_.sheet) return;
  ImGui::Dummy({0, px(6)});
  ImGui::Separator();
  if (state_.opened->probes) {
    if (ImGui::Button(state_.ball ? "Take the ball away" : "Place a ball", {-1, 0})) {
      if (state_.ball)
        state_.ball.reset();
      else
        place_ball(Vec3(state_.camera.frame[3]) -
                       0.25f * state_.opened->rays.world().bounds.diagonal() * Vec3(state_.camera.frame[2]),
                   0.1f);
    }
    tip("in the light of the package's probes, as what moves in an engine");
  }
  if (ImGui::Button("Write to scene", {-1, 0})) attempt([&] { save_scene({}); });
  tip("NAME-relit.glb beside the package: lamps and emitters as strong as mixed");
}

}  // namespace sconce::viewer
