// SPDX-License-Identifier: Apache-2.0
// A lamp becomes one of another kind; files that it is made of are watched while they are edited.
#include <fmt/format.h>

#include <cmath>

#include "core/error.h"
#include "gpu/lamp_light.h"
#include "viewer/viewer.h"
#include "viewer/widgets.h"

namespace fs = std::filesystem;

namespace sconce::viewer {

namespace {

constexpr double kLookEvery = 0.25;  // seconds

/// The file that the words of a kind name.
std::string file_of(const std::string& kind) {
  constexpr std::string_view kFile = ",file=";
  const std::size_t at = kind.find(kFile);
  if (at == std::string::npos) return {};
  const std::size_t begin = at + kFile.size();
  return kind.substr(begin, kind.find(',', begin) - begin);
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
  auto made = request_.become(movable.lamps.all()[lamp], {state.at, state.target}, state.kind);
  if (const std::string file = file_of(state.kind); !file.empty()) {
    std::error_code ignored;
    state_.lamps.files[file] = fs::last_write_time(file, ignored);
  }
  if (auto* lights = std::get_if<MoreLights>(&made)) return std::move(*lights);
  const auto light = std::make_shared<gpu::LampLight>(window_.context(), state_.canvas->geometry(),
                                                      movable.view.world().bounds,
                                                      std::move(std::get<gpu::LampShader>(made)));
  return PrelitLamp{light->on_receivers(movable.op, *movable.bounces),
                    [light](std::span<const SurfacePoint> points) { return light->at(points); }};
}

void Viewer::watch_lamp_files() {
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
  ImGui::PushFont(fonts().strong);
  ImGui::TextUnformatted("Lamp");
  ImGui::PopFont();
  if (lamps.mover == nullptr) {
    ImGui::PushTextWrapPos();
    ImGui::TextDisabled("%s",
                        preparing_.running()
                            ? "Reading how light goes on from lamps that move..."
                            : "Lamps stay where they are: bake with --movable, or run sconce transfer.");
    ImGui::PopTextWrapPos();
    ImGui::Dummy({0, px(6)});
    return ImGui::Separator();
  }
  const MovedPlaces& moved = state_.session->mood().moved;
  if (lamps.chosen) {
    const std::size_t lamp = *lamps.chosen;
    const auto found = moved.find(lamp);
    const std::string kind = found != moved.end() ? found->second.kind : "";
    const Lamp& own = lamps.mover->movable().lamps.all()[lamp];
    const std::string group =
        own.group.valid() ? " \u00b7 " + state_.session->groups()[own.group.value].name : "";
    const std::string title =
        lamps.mover->movable().names[lamp] + group + fmt::format(" \u00b7 {:.0f} lm", luminance(own.flux));
    ImGui::TextUnformatted(fitting(title, ImGui::GetContentRegionAvail().x).c_str());
    tip(title.c_str());
    const float gap = ImGui::GetStyle().ItemSpacing.x, width = ImGui::GetContentRegionAvail().x;
    const auto count = static_cast<float>(request_.kinds.size() + 1);
    const auto choice = [&](const std::string& name, const std::string& words, bool lit) {
      if (toggle(name.c_str(), name.c_str(), lit, palette::kAccent, (width - (count - 1) * gap) / count) &&
          !lit)
        attempt([&] { set_kind(lamp, words); });
    };
    choice("own", "", kind.empty());
    const std::string first = kind.substr(0, kind.find(','));
    for (const auto& [name, words] : request_.kinds) ImGui::SameLine(), choice(name, words, name == first);
    char text[512] = {};
    const std::string shown = lamps.words.empty() ? kind : lamps.words;
    shown.copy(text, sizeof text - 1);
    ImGui::SetNextItemWidth(-1);
    if (ImGui::InputTextWithHint("##kind", "spot,outer=40   luminaire,file=lamp.ldt", text, sizeof text,
                                 ImGuiInputTextFlags_EnterReturnsTrue)) {
      lamps.words.clear();
      attempt([&] { set_kind(lamp, text); });
    } else if (ImGui::IsItemActive()) {
      lamps.words = text;
    } else {
      lamps.words.clear();
    }
    tip("the words of sconce relight --kind; drop an IES or EULUMDAT file, or a light shader (.glsl), to "
        "make "
        "this lamp of it; files are read again when they change");
  } else {
    ImGui::PushTextWrapPos();
    ImGui::TextDisabled("Click a lamp's ring to move it, to turn it (T), or to make another one of it.");
    ImGui::PopTextWrapPos();
  }
  ImGui::PushTextWrapPos();
  if (!lamps.problem.empty()) ImGui::TextColored({1, 0.55f, 0.4f, 1}, "%s", lamps.problem.c_str());
  ImGui::PopTextWrapPos();
  ImGui::Dummy({0, px(6)});
  ImGui::Separator();
}

}  // namespace sconce::viewer
