// SPDX-License-Identifier: Apache-2.0
// The bars at top and bottom, notes, help, and what is shown where nothing is open.
#include <fmt/format.h>

#include "core/installed.h"
#include "viewer/viewer.h"
#include "viewer/widgets.h"

namespace fs = std::filesystem;

namespace sconce::viewer {

namespace {

constexpr ImGuiWindowFlags kBar = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                  ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoNav;

void begin_bar(const char* name, ImVec2 at, ImVec2 size, float pad) {
  ImGui::SetNextWindowPos(at);
  ImGui::SetNextWindowSize(size);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {px(14), pad});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
  ImGui::Begin(name, nullptr, kBar);
  ImGui::PopStyleVar(2);
}

struct Key {
  const char *keys, *what;
};
constexpr Key kKeys[] = {{"Left drag", "turn around what is under the pointer"},
                         {"Right drag", "look around"},
                         {"Middle or Shift drag", "move in the picture plane"},
                         {"Wheel", "nearer, further"},
                         {"W A S D, Q E", "fly; Shift: fast"},
                         {"C", "next camera of the scene"},
                         {"F", "all in sight"},
                         {"Ctrl-click", "wish for lux at a surface"},
                         {"Click a lamp's ring", "handles to drag it by, with sconce bake --movable"},
                         {"O or double click", "handles of the object under the pointer"},
                         {"H, L", "the lamp or object goes home; rings of lamps"},
                         {"R", "turns the object by 15 degrees; with Shift back"},
                         {"T", "the lamp points to what is under the pointer"},
                         {"Double click on a fader", "as baked; Shift: fine; Ctrl-wheel: a tenth of a stop"},
                         {"Ctrl Z, Ctrl Y", "undo, redo"},
                         {"1 to 9", "views, in their order"},
                         {"X", "meter once and hold"},
                         {"I", "reading under the pointer"},
                         {"Tab", "picture alone"},
                         {"P or F12", "write the picture; with Shift as OpenEXR"},
                         {"Ctrl S", "write a preset"},
                         {"F1", "this help"}};

}  // namespace

void Viewer::top_bar(ImVec2 at, ImVec2 size) {
  begin_bar("top", at, size, px(8));
  ImGui::PushFont(fonts().strong);
  ImGui::AlignTextToFramePadding();
  ImGui::PushStyleColor(ImGuiCol_Text, palette::kAccent);
  ImGui::TextUnformatted("sconce");
  ImGui::PopStyleColor();
  ImGui::PopFont();
  if (state_.ready()) opened_bar();
  ImGui::SameLine(size.x - px(84));
  if (ImGui::Button("Help F1", {px(70), 0})) state_.help = !state_.help;
  ImGui::End();
}

void Viewer::opened_bar() {
  ImGui::SameLine(0, px(16));
  ImGui::TextUnformatted(state_.file.filename().string().c_str());
  ImGui::SameLine(0, px(20));
  Session& session = *state_.session;
  const auto step = [&](const char* label, bool can, auto work) {
    ImGui::PushStyleColor(ImGuiCol_Text, can ? palette::kText : palette::kFaint);
    if (ImGui::Button(label) && can) work();
    ImGui::PopStyleColor();
    ImGui::SameLine();
  };
  step("Undo", session.can_undo(), [&] { session.undo(); });
  step("Redo", session.can_redo(), [&] { session.redo(); });
  if (own_folder_ == state_.package.parent_path() && !own_folder_.empty()) {
    if (ImGui::Button("Save package")) attempt([&] { save_package({}); });
    ImGui::SameLine();
  }
  ImGui::SameLine(0, px(20));
  ImGui::SetNextItemWidth(px(150));
  if (state_.sheet) {
    if (ImGui::Button("Whole picture")) state_.place = {};
  } else if (ImGui::BeginCombo("##camera", state_.camera.name.c_str())) {
    for (const Camera& camera : state_.opened->rays.scene().cameras)
      if (ImGui::Selectable(camera.name.c_str(), false)) state_.camera = camera;
    ImGui::EndCombo();
  }
  ImGui::SameLine();
  ImGui::SetNextItemWidth(px(130));
  if (ImGui::BeginCombo("##look", std::string(row_of(state_.look).label).c_str(),
                        ImGuiComboFlags_HeightLarge)) {
    for (const LookRow& row : look_rows())
      if ((row.of_pictures || !state_.sheet) &&
          ImGui::Selectable(std::string(row.label).c_str(), row.kind == state_.look))
        set_look(row.kind);
    ImGui::EndCombo();
  }
}

void Viewer::status_bar(ImVec2 at, ImVec2 size) {
  begin_bar("status", at, size, px(4));
  ImGui::PushFont(fonts().small);
  std::string line;
  if (baking_.running())
    line = fmt::format("baking: {} {:.0f} %", baking_.stage(), 100 * baking_.done());
  else if (opening_.running())
    line = "opening " + state_.coming.filename().string();
  else if (turning_)
    line = fmt::format("turntable, picture {} of {}; Escape stops", turning_->at + 1, turning_->count);
  else if (filming_.running())
    line = "making the film";
  else if (measuring_.running())
    line = "measuring";
  else if (preparing_.running())
    line = "preparing lamps to be moved";
  else if (tracing_.running())
    line = fmt::format("path tracing the reference, {} paths per pixel", traced_ ? traced_->samples : 0);
  else if (const std::string words = behind(); !words.empty())
    line = words;
  else if (state_.sheet)
    line =
        fmt::format("{} groups  {} x {}  {}", state_.session->groups().size(), state_.sheet->opened().width(),
                    state_.sheet->opened().height(), state_.sheet->opened().picture.renderer);
  else if (state_.ready())
    line = fmt::format("{} groups  {} x {}  {} page{}", state_.session->groups().size(),
                       state_.opened->package.manifest().width, state_.opened->package.manifest().height,
                       state_.opened->package.manifest().pages,
                       state_.opened->package.manifest().pages == 1 ? "" : "s");
  ImGui::TextDisabled("%s", line.c_str());
  const gpu::Capabilities& can = window_.context().capabilities();
  const std::string device = state_.ready() ? fmt::format("{}   mix {:.1f} ms", can.renderer.substr(0, 40),
                                                          state_.screen().fader_milliseconds())
                                            : can.renderer.substr(0, 40);
  ImGui::SameLine(size.x - ImGui::CalcTextSize(device.c_str()).x - px(14));
  ImGui::TextDisabled("%s", device.c_str());
  ImGui::PopFont();
  ImGui::End();
  // Notes float above the bar and go by themselves.
  while (!state_.notes.empty() && state_.notes.front().second < ImGui::GetTime()) state_.notes.pop_front();
  float y = at.y - px(10);
  ImDrawList& draw = *ImGui::GetForegroundDrawList();
  for (auto note = state_.notes.rbegin(); note != state_.notes.rend(); ++note) {
    const ImVec2 text = ImGui::CalcTextSize(note->first.c_str(), nullptr, false, 0.7f * size.x);
    y -= text.y + px(22);
    const float x = 0.5f * (size.x - text.x);
    draw.AddRectFilled({x - px(16), y}, {x + text.x + px(16), y + text.y + px(16)}, IM_COL32(40, 41, 46, 245),
                       px(8));
    draw.AddText(nullptr, 0, {x, y + px(8)}, palette::kText, note->first.c_str(), nullptr, 0.7f * size.x);
  }
}

void Viewer::help_card() {
  if (!state_.help) return;
  const ImVec2 all = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0.5f * all.x, 0.5f * all.y}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, px(10));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {px(28), px(20)});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, IM_COL32(32, 33, 37, 255));
  ImGui::Begin("help", &state_.help,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_AlwaysAutoResize);
  ImGui::PushFont(fonts().large);
  ImGui::TextUnformatted("Keys and mouse");
  ImGui::PopFont();
  for (const Key& key : kKeys) {
    ImGui::PushStyleColor(ImGuiCol_Text, palette::kAccent);
    ImGui::TextUnformatted(key.keys);
    ImGui::PopStyleColor();
    ImGui::SameLine(px(220));
    ImGui::TextUnformatted(key.what);
  }
  ImGui::Dummy({0, px(4)});
  ImGui::TextDisabled("All of it is a command, too: sconce render, fit, view --script. See docs/window.md.");
  ImGui::End();
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(3);
}

void Viewer::welcome(ImVec2 at, ImVec2 size) {
  ImGui::SetNextWindowPos(at);
  ImGui::SetNextWindowSize(size);
  ImGui::Begin("welcome", nullptr, kBar);
  const bool waiting = opening_.running() || baking_.running();
  const float width = px(520), x = 0.5f * (size.x - width), y = std::max(0.2f * size.y, px(40));
  ImGui::SetCursorPos({x, y});
  ImGui::BeginGroup();
  ImGui::PushTextWrapPos(x + width);
  ImGui::PushFont(fonts().large);
  ImGui::TextUnformatted(waiting ? state_.coming.filename().string().c_str() : "Drop a file here");
  ImGui::PopFont();
  if (waiting) {
    const std::string stage = baking_.running() ? baking_.stage() : "opening";
    ImGui::ProgressBar(baking_.running() ? static_cast<float>(baking_.done()) : 0.5f, {width, px(6)}, "");
    ImGui::TextDisabled("%s", stage.c_str());
  } else {
    for (const auto& [what, about] :
         {std::pair{"A package", "NAME.sconce, as sconce bake writes it"},
          {"A scene", "glTF, OBJ, FBX, COLLADA, 3DS, ...: baked while you look"},
          {"A picture", "OpenEXR with light groups, of Blender, V-Ray, Arnold, LuxCore, ..."}}) {
      ImGui::TextUnformatted(what);
      ImGui::SameLine(px(90));
      ImGui::TextDisabled("%s", about);
    }
    ImGui::Dummy({0, px(12)});
    for (const auto& [name, file] :
         {std::pair{"Try our bathroom", "scenes/bathroom.glb"}, {"Try our playhouse", "scenes/theatre.glb"}})
      if (const fs::path ours = installed_file(file); fs::exists(ours) && request_.bake) {
        if (ImGui::Button(name, {px(170), px(34)})) attempt([&] { open(ours); });
        ImGui::SameLine();
      }
    ImGui::NewLine();
    const float end = ImGui::GetCursorPosY() + px(8);
    dashed_frame(*ImGui::GetWindowDrawList(), {at.x + x - px(32), at.y + y - px(28)},
                 {at.x + x + width + px(32), at.y + end + px(12)});
    ImGui::SetCursorPosY(end + px(40));
    if (!remembered_.recent.empty()) ImGui::TextDisabled("Recent");
    for (const std::string& file : std::vector(remembered_.recent)) {
      if (ImGui::Selectable((fs::path(file).filename().string() + "##" + file).c_str(), false, 0, {width, 0}))
        attempt([&] { open(file); });
      const std::string folder = fs::path(file).parent_path().string();
      ImGui::SameLine(px(200));
      ImGui::TextDisabled("%s", fitting(folder, width - px(200)).c_str());
    }
  }
  ImGui::PopTextWrapPos();
  ImGui::EndGroup();
  ImGui::End();
}

}  // namespace sconce::viewer
