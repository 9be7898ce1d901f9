// SPDX-License-Identifier: Apache-2.0
// A lamp becomes one of another kind: a point, a spot, or a shader that is watched while it is edited.
#include <fmt/format.h>

#include <cmath>

#include "core/error.h"
#include "gpu/direct_light.h"
#include "viewer/viewer.h"
#include "viewer/widgets.h"

namespace fs = std::filesystem;

namespace sconce::viewer {

namespace {

constexpr std::string_view kShader = "shader,";
constexpr double kLookEvery = 0.25;  // seconds

bool says(const std::string& words, std::string_view key) {
  return words.find("," + std::string(key) + "=") != std::string::npos;
}

/// The file that a shader's words name.
std::string file_of(const std::string& kind) {
  constexpr std::string_view kFile = ",file=";
  const std::size_t at = kind.find(kFile);
  if (!kind.starts_with(kShader) || at == std::string::npos) return {};
  const std::size_t begin = at + kFile.size();
  return kind.substr(begin, kind.find(',', begin) - begin);
}

/// Words with a place, and a direction and strength where they say none: downwards, the lamp's own flux.
std::string completed(const Lamp& lamp, const MovedLamp& state) {
  // Not within its own body.
  const Vec3 at = state.at + 0.01f * axis_of(lamp).value_or(Vec3(0));
  std::string words = state.kind + fmt::format(",position={:.6f},{:.6f},{:.6f}", at.x, at.y, at.z);
  if (!state.kind.starts_with("point") && !says(words, "target") && !says(words, "direction"))
    words += ",direction=0,-1,0";
  const double lumens = std::max(static_cast<double>(luminance(lamp.flux)), 1e-6);
  if (state.kind.starts_with(kShader)) {
    if (!says(words, "intensity")) words += fmt::format(",intensity={:.6g}", lumens / (4 * double{kPi}));
  } else if (!says(words, "lumens") && !says(words, "intensity")) {
    words += fmt::format(",lumens={:.6g}", lumens);
  }
  return words;
}

Rgb own_color(const Lamp& lamp, const std::string& words) {
  if (says(words, "color") || says(words, "kelvin") || !(luminance(lamp.flux) > 0)) return Rgb(1);
  return lamp.flux / luminance(lamp.flux);
}

/// Its light on texels, direct by shadow maps, lux.
std::vector<Rgb> light_of(const gpu::Context& context, const gpu::Geometry& geometry, const Movable& movable,
                          const gpu::LampShader& lamp) {
  const Operator& op = movable.op;
  gpu::DirectLight direct(context, geometry, movable.opened->rays.world().bounds, {lamp});
  const auto lit = [&](std::span<const OperatorPoint> points, uint32_t slots, uint32_t each) {
    const gpu::Buffer places(context, points, "points of the lightmap");
    const gpu::Buffer light(context, slots * sizeof(Rgbx), nullptr, "light of a lamp");
    direct.light_cloud(places, slots, each, light);
    std::vector<Rgbx> out(slots);
    light.read(slots * sizeof(Rgbx), out.data());
    return out;
  };
  std::vector<OperatorPoint> texels(op.receivers.begin(), op.receivers.end());
  for (OperatorPoint& texel : texels) texel.albedo = pack_albedo(Rgb(1));
  const std::vector<Rgbx> seen = lit(texels, static_cast<uint32_t>(texels.size()), 1);
  std::vector<Rgbx> cloud = lit(op.lit, op.slots(), op.points_per_slot);
  std::vector<Rgb> light(seen.size());
  movable.bounces.indirect(cloud, light);
  for (std::size_t i = 0; i < light.size(); ++i) light[i] += Rgb(seen[i][0], seen[i][1], seen[i][2]);
  return light;
}

}  // namespace

void Viewer::set_kind(std::size_t lamp, const std::string& kind) {
  Mood mood = state_.session->mood();
  MovedLamp& state = mood.moved[lamp];
  state.at = state_.lamps.mover->place(lamp, state_.session->mood().moved).value_or(Vec3(0));
  state.kind = kind;
  state_.session->change(mood);
  light_lamps();
}

OtherLamp Viewer::other_lamp(std::size_t lamp, const MovedLamp& state) {
  const Movable& movable = state_.lamps.mover->movable();
  const Lamp& own = movable.lamps.all()[lamp];
  const std::string words = completed(own, state);
  const Rgb color = own_color(own, words);
  if (!state.kind.starts_with(kShader)) {
    Light light = request_.parse_light(words);
    light.intensity = light.intensity * color;
    return light;
  }
  std::error_code ignored;
  state_.lamps.files[file_of(state.kind)] = fs::last_write_time(file_of(state.kind), ignored);
  gpu::LampShader shader = request_.parse_shader(words);
  shader.intensity = shader.intensity * color;
  return light_of(window_.context(), state_.canvas->geometry(), movable, shader);
}

void Viewer::watch_shaders() {
  MovingLamps& lamps = state_.lamps;
  if (ImGui::GetTime() < lamps.looked + kLookEvery) return;
  lamps.looked = ImGui::GetTime();
  for (const auto& [lamp, state] : state_.session->mood().moved) {
    const auto known = lamps.files.find(file_of(state.kind));
    if (known == lamps.files.end()) continue;
    std::error_code failed;
    const auto now = fs::last_write_time(known->first, failed);
    if (!failed && now != known->second) lamps.mover->remake(lamp);
  }
}

void Viewer::lamp_section() {
  MovingLamps& lamps = state_.lamps;
  if (lamps.mover == nullptr) return;
  ImGui::PushFont(fonts().strong);
  ImGui::TextUnformatted("Lamp");
  ImGui::PopFont();
  const MovedPlaces& moved = state_.session->mood().moved;
  if (lamps.chosen) {
    const std::size_t lamp = *lamps.chosen;
    const auto found = moved.find(lamp);
    const std::string kind = found != moved.end() ? found->second.kind : "";
    ImGui::TextUnformatted(lamps.mover->movable().lamps.all()[lamp].name.c_str());
    constexpr std::pair<const char*, const char*> kKinds[] = {
        {"own", ""}, {"point", "point"}, {"spot", "spot,inner=20,outer=35"}};
    for (const auto& [label, words] : kKinds) {
      if (words != kKinds[0].second) ImGui::SameLine();
      if (toggle(label, label, kind == words, palette::kAccent, px(64)) && kind != words)
        attempt([&] { set_kind(lamp, words); });
    }
    char text[512] = {};
    const std::string shown = lamps.words.empty() ? kind : lamps.words;
    shown.copy(text, sizeof text - 1);
    ImGui::SetNextItemWidth(-1);
    if (ImGui::InputTextWithHint("##kind", "spot,outer=40   shader,file=barn.glsl", text, sizeof text,
                                 ImGuiInputTextFlags_EnterReturnsTrue)) {
      lamps.words.clear();
      attempt([&] { set_kind(lamp, text); });
    } else if (ImGui::IsItemActive()) {
      lamps.words = text;
    } else {
      lamps.words.clear();
    }
    tip("the words of sconce relight --light without a place; a light shader is read again when its file "
        "changes, and "
        "may be dropped");
  } else {
    ImGui::TextDisabled("Click a lamp's ring to move it, or to make another one of it.");
  }
  ImGui::PushTextWrapPos();
  if (!lamps.problem.empty()) ImGui::TextColored({1, 0.55f, 0.4f, 1}, "%s", lamps.problem.c_str());
  ImGui::PopTextWrapPos();
  ImGui::Dummy({0, px(6)});
  ImGui::Separator();
}

}  // namespace sconce::viewer
