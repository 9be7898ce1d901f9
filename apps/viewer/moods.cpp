// SPDX-License-Identifier: Apache-2.0
// Moods: two kept aside, those in files, and how long it takes to fade to them.
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>

#include "core/error.h"
#include "core/files.h"
#include "session/presets_near.h"
#include "viewer/viewer.h"
#include "viewer/widgets.h"

namespace fs = std::filesystem;

namespace sconce::viewer {

void Viewer::find_moods() {
  const Session& session = *state_.session;
  state_.moods = presets_near(state_.file, session.groups());
}

void Viewer::fade_to_file(const fs::path& file) {
  state_.session->perform({"preset", {file.string(), fmt::format("{}", state_.fade_seconds)}, "mood"});
  if (state_.session->lamps().empty() && !read_preset(file).lamps.empty())
    note("its lamps stay where they are: this package has no operator (sconce transfer)");
}

void Viewer::save_preset() {
  const std::string stem = state_.file.stem().string();
  std::string name = state_.mood_name.empty()
                         ? fmt::format("{:%Y%m%d-%H%M%S}", fmt::localtime(std::time(nullptr)))
                         : state_.mood_name;
  if (name.find('/') != std::string::npos) throw Error(name, "is no name for a file");
  const fs::path path = state_.file.parent_path() / (stem + "-" + name + ".toml");
  if (!state_.mood_name.empty() && fs::exists(path))
    throw Error(path.string(), "is there already", "another name, or drop it to fade to it");
  write_file(path, print_preset(to_preset(state_.session->groups(), state_.session->mood(), "",
                                          state_.session->lamps())));
  note("preset written: " + path.string());
  state_.mood_name.clear();
  find_moods();
}

void Viewer::moods_section() {
  Session& session = *state_.session;
  const float gap = ImGui::GetStyle().ItemSpacing.x, width = ImGui::GetContentRegionAvail().x;
  const float fourth = (width - 3 * gap) / 4;
  for (const char slot : {'a', 'b'}) {
    const std::string name(1, static_cast<char>(slot - 'a' + 'A'));
    if (toggle(("##keep" + name).c_str(), name.c_str(), session.kept(slot), palette::kAccent, fourth)) {
      if (session.kept(slot) && !ImGui::GetIO().KeyShift)
        session.recall(slot, state_.fade_seconds);
      else
        session.keep(slot);
    }
    tip("keeps the mix aside; a second click fades back to it, Shift-click keeps anew");
    ImGui::SameLine();
  }
  ImGui::SetNextItemWidth(-1);
  auto seconds = static_cast<float>(state_.fade_seconds);
  if (ImGui::DragFloat("##fade", &seconds, 0.05f, 0, 60, "fades take %.1f s"))
    state_.fade_seconds = static_cast<double>(seconds);
  tip("drag to change; of A and B, of moods, and of goals");

  Rows rows(width);
  for (const NearPreset& mood : state_.moods) {
    if (toggle(mood.file.c_str(), mood.name.c_str(), false, palette::kAccent, rows.next(mood.name)))
      attempt([&] { fade_to_file(mood.file); });
    tip(mood.file.c_str());
  }
  std::array<char, 64> name{};
  state_.mood_name.copy(name.data(), name.size() - 1);
  ImGui::SetNextItemWidth(width - fourth - gap);
  const bool entered = ImGui::InputTextWithHint("##mood", "name of a mood", name.data(), name.size(),
                                                ImGuiInputTextFlags_EnterReturnsTrue);
  state_.mood_name = name.data();
  ImGui::SameLine();
  if (ImGui::Button("Save", {fourth, 0}) || entered) attempt([&] { save_preset(); });
  tip("writes a preset beside the package, for `sconce render --preset`; one that is dropped is faded to");
  ImGui::Dummy({0, px(4)});
}

}  // namespace sconce::viewer
