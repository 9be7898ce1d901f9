// SPDX-License-Identifier: Apache-2.0
// The side with the faders.
#include <fmt/format.h>

#include <algorithm>

#include "core/kelvin.h"
#include "session/search.h"
#include "viewer/viewer.h"
#include "viewer/widgets.h"

namespace sconce::viewer {

namespace {

constexpr std::size_t kRoomy = 8;  // groups; of more, words stand beside the name

struct Words {
  std::string stops, gain, lumens, kelvin;
};

std::string lumens(double flux) {
  return flux < 10 ? fmt::format("{:.2g} lm", flux) : fmt::format("{:.0f} lm", flux);
}

Words in_words(const GroupInfo& group, const Fader& fader, double master) {
  if (!fader.on) return {"off", {}, {}, {}};
  return {signed_words(stops_of(fader.gain), 1) + " EV", fmt::format("\u00d7{:.3g}", fader.gain),
          group.lumens > 0 ? lumens(group.lumens * fader.gain * master) : "",
          fader.color == Fader::Color::kelvin ? fmt::format("{:.0f} K", fader.kelvin) : ""};
}

void small_words(float x, const std::string& words, bool to_right = false) {
  ImGui::SameLine(to_right ? x - width_of(fonts().small, words) : x);
  ImGui::PushFont(fonts().small);
  ImGui::TextDisabled("%s", words.c_str());
  ImGui::PopFont();
}

}  // namespace

void Viewer::side_panel(ImVec2 at, ImVec2 size) {
  ImGui::SetNextWindowPos(at);
  ImGui::SetNextWindowSize(size);
  constexpr ImGuiWindowFlags kFixed =
      ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoBringToFrontOnFocus;
  ImGui::Begin("side", nullptr, kFixed | ImGuiWindowFlags_NoScrollWithMouse);
  if (ImGui::BeginTabBar("tabs")) {
    struct Tab {
      const char* name;
      void (Viewer::*draw)();
    };
    for (const Tab& tab : {Tab{"Mix", &Viewer::mix_panel}, Tab{"Look", &Viewer::look_panel},
                           Tab{"Light design", &Viewer::design_panel}})
      if (ImGui::BeginTabItem(tab.name)) {
        ImGui::BeginChild("content", {0, 0}, false);
        (this->*tab.draw)();
        ImGui::EndChild();
        ImGui::EndTabItem();
      }
    ImGui::EndTabBar();
  }
  // The border between picture and faders.
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const bool on_border = std::abs(mouse.x - at.x) < px(4) && mouse.y > at.y && mouse.y < at.y + size.y;
  if (on_border && ImGui::GetIO().MouseClicked[0]) state_.resizing = true;
  if (!ImGui::GetIO().MouseDown[0]) state_.resizing = false;
  if (on_border || state_.resizing) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  if (state_.resizing)
    remembered_.panel = std::clamp(remembered_.panel - ImGui::GetIO().MouseDelta.x / px(1), 300.0f, 900.0f);
  ImGui::End();
}

void Viewer::mix_panel() {
  Session& session = *state_.session;
  Mood mood = session.mood();
  moods_section();
  mood = session.mood();

  ImGui::PushFont(fonts().strong);
  ImGui::TextUnformatted("Master");
  ImGui::PopFont();
  ImGui::SameLine(0, 0);
  words_at_end(fonts().small, palette::kDim, signed_words(stops_of(mood.faders.master), 1) + " EV");
  const FaderMove master = fader_track("master", mood.faders.master, palette::kText, true);
  if (master.moved) {
    mood.faders.master = master.gain;
    session.change(mood, "master");
  }
  if (master.released) session.end_gesture();
  ImGui::Dummy({0, px(2)});

  std::vector<std::string> names;
  for (const GroupInfo& group : session.groups()) names.push_back(group.name);
  if (names.size() > 6) {
    std::array<char, 128> text{};
    state_.search.copy(text.data(), text.size() - 1);
    ImGui::SetNextItemWidth(-1);
    if (ImGui::InputTextWithHint("##search", "search groups", text.data(), text.size()))
      state_.search = text.data();
  }
  for (const FaderFolder& folder : fader_folders(names, state_.search)) {
    const std::string title = fmt::format("{}  ({})", folder.name, folder.groups.size());
    if (!folder.name.empty() && !ImGui::CollapsingHeader(title.c_str(), ImGuiTreeNodeFlags_DefaultOpen))
      continue;
    for (const std::size_t g : folder.groups) fader_row(g);
  }
}

std::string Viewer::about(std::size_t g) const {
  const GroupInfo& group = state_.session->groups()[g];
  if (state_.sheet)
    return fmt::format("{}\nmean {:.3g} as rendered", group.name, state_.sheet->opened().means[g]);
  const std::string flux = group.lumens > 0 ? lumens(group.lumens) + " as baked, " : "";
  std::string line = fmt::format("{}\n{}mean {:.1f} lux, noise {:.1f} %", group.name, flux, group.mean_lux,
                                 100 * group.noise);
  constexpr std::size_t kMost = 12;
  for (std::size_t i = 0; i < std::min(kMost, group.lamps.size()); ++i) line += "\n  " + group.lamps[i];
  if (group.lamps.size() > kMost) line += fmt::format("\n  and {} more", group.lamps.size() - kMost);
  return line;
}

void Viewer::fader_row(std::size_t g) {
  Session& session = *state_.session;
  const GroupInfo& group = session.groups()[g];
  Mood mood = session.mood();
  Fader& fader = mood.faders.groups[g];
  const MixSpec mix = session.mix();
  ImGui::PushID(static_cast<int>(g));
  const bool compact = session.groups().size() > kRoomy;
  bool changed = false;
  std::string gesture;

  // Name, solo, mute.
  const Rgb light = group.color * (mix.weights[g].is_black() ? unit_weights(session.groups(), mood.faders)[g]
                                                             : mix.weights[g]);
  const ImU32 color = chip(light);
  if (light_switch("on", fader.on, color)) fader.on = !fader.on, changed = true;
  tip(fader.on ? "switches the group off" : "switches the group on");
  ImGui::SameLine();
  ImGui::AlignTextToFramePadding();
  ImGui::PushFont(fonts().strong);
  ImGui::PushStyleColor(ImGuiCol_Text, mix.weights[g].is_black() ? palette::kDim : palette::kText);
  const float small = px(26), gap = px(4), chips = ImGui::GetContentRegionMax().x - 3 * small - 2 * gap;
  const Words words = in_words(group, fader, mood.faders.master);
  const float column = px(58), beside = compact ? 2 * column + 2 * gap : 0;
  ImGui::TextUnformatted(fitting(group.name, chips - ImGui::GetCursorPosX() - gap - beside).c_str());
  ImGui::PopStyleColor();
  ImGui::PopFont();
  if (ImGui::IsItemHovered()) tip(about(g).c_str());
  if (compact) {
    small_words(chips - column - gap, words.stops, true);
    small_words(chips - gap, words.kelvin.empty() ? words.lumens : words.kelvin, true);
  }
  ImGui::SameLine(chips);
  if (color_chip("color", color, small)) ImGui::OpenPopup("colour");
  tip("colour: its own, kelvin, another one, or a tint");
  ImGui::SameLine(0, gap);
  if (toggle("solo", "S", fader.solo, palette::kSolo, small)) fader.solo = !fader.solo, changed = true;
  tip("solo: this group alone");
  ImGui::SameLine(0, gap);
  if (toggle("mute", "M", fader.mute, palette::kMute, small)) fader.mute = !fader.mute, changed = true;
  tip("mute: hides this group, presets do not");
  color_popup(g);

  const auto closer = [&] {
    if (compact) ImGui::SetCursorPosY(ImGui::GetCursorPosY() - ImGui::GetStyle().ItemSpacing.y + px(1));
  };
  closer();
  const FaderMove move = fader_track("track", fader.gain, color, fader.on);
  state_.fader_places[group.name] = move.place;
  if (move.moved)
    fader.gain = move.gain, fader.on = move.gain > 0, changed = true, gesture = "gain " + group.name;
  if (!(fader.gain > 0)) fader.gain = 1;  // what switching on goes back to
  if (changed) session.change(mood, gesture);
  if (move.released) session.end_gesture();

  if (!compact) {
    ImGui::PushFont(fonts().small);
    ImGui::TextDisabled("%s", words.stops.c_str());
    ImGui::PopFont();
    small_words(px(66), words.gain), small_words(px(190), words.lumens, true);
    small_words(ImGui::GetContentRegionMax().x, words.kelvin, true);
  }
  closer();
  ImGui::Dummy({0, px(1)});
  ImGui::PopID();
}

void Viewer::color_popup(std::size_t g) {
  if (!ImGui::BeginPopup("colour")) return;
  Session& session = *state_.session;
  const GroupInfo& group = session.groups()[g];
  Mood mood = session.mood();
  Fader& fader = mood.faders.groups[g];
  bool changed = false;
  ImGui::PushFont(fonts().strong);
  ImGui::TextUnformatted(group.name.c_str());
  ImGui::PopFont();
  struct Choice {
    const char* name;
    Fader::Color color;
    const char* what;
  };
  for (const Choice& choice : {Choice{"Own", Fader::Color::own, "as baked"},
                               Choice{"Kelvin", Fader::Color::kelvin, "a colour temperature, the flux stays"},
                               Choice{"Colour", Fader::Color::color, "another colour, the flux stays"},
                               Choice{"Tint", Fader::Color::tint, "a filter before the lamp"}}) {
    if (toggle(choice.name, choice.name, fader.color == choice.color, palette::kAccent, px(66)))
      fader.color = choice.color, changed = true;
    tip(choice.what);
    ImGui::SameLine();
  }
  ImGui::NewLine();
  ImGui::SetNextItemWidth(px(290));
  if (fader.color == Fader::Color::kelvin) {
    auto kelvin = static_cast<float>(fader.kelvin);
    if (ImGui::SliderFloat("##kelvin", &kelvin, static_cast<float>(kKelvinMin),
                           static_cast<float>(kKelvinMax), "%.0f K", ImGuiSliderFlags_Logarithmic)) {
      fader.kelvin = std::clamp(static_cast<double>(kelvin), kKelvinMin, kKelvinMax);
      changed = true;
    }
    kelvin_ramp({px(290), px(8)});
    for (const int usual : {2200, 2700, 3000, 4000, 5000, 6500}) {
      if (ImGui::SmallButton(fmt::format("{}", usual).c_str())) fader.kelvin = usual, changed = true;
      ImGui::SameLine();
    }
    ImGui::NewLine();
  } else if (fader.color != Fader::Color::own) {
    changed |= ImGui::ColorPicker3("##picker", &fader.code.r,
                                   ImGuiColorEditFlags_NoSidePreview | ImGuiColorEditFlags_PickerHueWheel |
                                       ImGuiColorEditFlags_DisplayHex | ImGuiColorEditFlags_NoSmallPreview);
  }
  if (group.color_spread > 1e-4) {
    ImGui::PushStyleColor(ImGuiCol_Text, palette::kDim);
    ImGui::TextUnformatted("Its lamps differ: exact for their mean only.");
    ImGui::PopStyleColor();
  }
  if (changed) session.change(mood, "colour " + group.name);
  ImGui::EndPopup();
}

}  // namespace sconce::viewer
