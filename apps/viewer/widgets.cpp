// SPDX-License-Identifier: Apache-2.0
#include "viewer/widgets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/kelvin.h"
#include "session/fader.h"

namespace sconce::viewer {

FaderMove fader_track(const char* id, double gain, ImU32 color, bool on) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const ImVec2 size(ImGui::GetContentRegionAvail().x, px(20));
  FaderMove move{.gain = gain, .place = {at.x, at.y, size.x, size.y}};
  ImGui::InvisibleButton(id, size);
  const bool hovered = ImGui::IsItemHovered(), active = ImGui::IsItemActive();
  const ImGuiIO& io = ImGui::GetIO();
  const double range = kHighestStop - kLowestStop;
  const auto place = [&](double stops) {
    return at.x + size.x * static_cast<float>((stops - kLowestStop) / range);
  };
  const auto set = [&](double stops) {
    move.gain = gain_of(std::clamp(stops, kLowestStop, kHighestStop));
    move.moved = move.gain != gain || !on;
  };
  if (hovered && ImGui::IsMouseDoubleClicked(0)) {
    set(0);
  } else if (active && io.KeyShift) {
    if (io.MouseDelta.x != 0)
      set(stops_of(gain) + 0.1 * range * static_cast<double>(io.MouseDelta.x / size.x));
  } else if (active && (ImGui::IsItemActivated() || io.MouseDelta.x != 0)) {
    double stops = kLowestStop + range * static_cast<double>((io.MousePos.x - at.x) / size.x);
    if (std::abs(stops) < 0.12) stops = 0;  // as baked holds the hand a little
    set(stops);
  } else if (hovered && io.KeyCtrl && io.MouseWheel != 0) {
    set(stops_of(gain) + 0.1 * static_cast<double>(io.MouseWheel));
  }
  move.released = ImGui::IsItemDeactivated();

  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float middle = at.y + 0.5f * size.y, thick = px(6), round = 0.5f * thick;
  const float here = place(on ? stops_of(move.gain) : kLowestStop);
  const ImVec2 low(at.x, middle - 0.5f * thick), high(at.x + size.x, middle + 0.5f * thick);
  draw.AddRectFilled(low, high, palette::kTrack, round);
  for (int stop = static_cast<int>(kLowestStop) + 1; stop < kHighestStop; ++stop) {
    const float x = place(stop), tall = stop == 0 ? px(7) : px(2);
    draw.AddLine({x, middle - tall}, {x, middle + tall}, stop == 0 ? palette::kDim : palette::kLine);
  }
  if (here > low.x + 1) draw.AddRectFilled(low, {here, high.y}, faded(color, on ? 0.85f : 0.25f), round);
  const float radius = active ? px(8) : px(7);
  const ImVec2 knob(std::clamp(here, at.x + radius, at.x + size.x - radius), middle);
  draw.AddCircleFilled({knob.x, knob.y + px(1)}, radius + px(1), IM_COL32(0, 0, 0, 90), 24);
  draw.AddCircleFilled(knob, radius, hovered || active ? IM_COL32(255, 255, 255, 255) : palette::kText, 24);
  draw.AddCircleFilled(knob, px(3), on ? color : palette::kFaint, 16);
  return move;
}

bool toggle(const char* id, const char* label, bool lit, ImU32 color, float width) {
  ImGui::PushID(id);
  ImGui::PushStyleColor(ImGuiCol_Button, lit ? color : palette::kRaised);
  ImGui::PushStyleColor(ImGuiCol_ButtonHovered, lit ? color : palette::kHover);
  ImGui::PushStyleColor(ImGuiCol_ButtonActive, color);
  ImGui::PushStyleColor(ImGuiCol_Text, lit ? IM_COL32(20, 20, 22, 255) : palette::kDim);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {0, ImGui::GetStyle().FramePadding.y});
  const bool pressed = ImGui::Button(label, {width, 0});
  ImGui::PopStyleVar();
  ImGui::PopStyleColor(4);
  ImGui::PopID();
  return pressed;
}

bool light_switch(const char* id, bool on, ImU32 color) {
  const float side = ImGui::GetFrameHeight(), radius = px(7);
  const ImVec2 at = ImGui::GetCursorScreenPos(), middle(at.x + radius + px(2), at.y + 0.5f * side);
  const bool pressed = ImGui::InvisibleButton(id, {2 * radius + px(4), side});
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  if (on) {
    draw.AddCircleFilled(middle, radius + px(2), faded(color, 0.25f), 24);
    draw.AddCircleFilled(middle, px(5.5f), color, 24);
  } else {
    draw.AddCircle(middle, px(5.5f), ImGui::IsItemHovered() ? palette::kText : palette::kFaint, 24, px(1.5f));
  }
  return pressed;
}

bool color_chip(const char* id, ImU32 color, float width) {
  const float height = ImGui::GetFrameHeight();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const bool pressed = ImGui::InvisibleButton(id, {width, height});
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float inset = px(4);
  draw.AddRectFilled({at.x + inset, at.y + inset}, {at.x + width - inset, at.y + height - inset}, color,
                     px(4));
  if (ImGui::IsItemHovered())
    draw.AddRect({at.x + inset, at.y + inset}, {at.x + width - inset, at.y + height - inset},
                 IM_COL32(255, 255, 255, 200), px(4), 0, px(1.5f));
  return pressed;
}

bool slider(const char* id, const char* name, const std::string& words, float* value, float low, float high,
            ImGuiSliderFlags flags) {
  ImGui::PushFont(fonts().small);
  ImGui::TextDisabled("%s", name);
  ImGui::PopFont();
  ImGui::SameLine(0, 0);
  words_at_end(fonts().small, palette::kText, words);
  ImGui::SetCursorPosY(ImGui::GetCursorPosY() - px(3));
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ImGui::GetStyle().FramePadding.x, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_GrabRounding, px(8));
  const bool moved = ImGui::SliderFloat(id, value, low, high, "", flags);
  ImGui::PopStyleVar(2);
  return moved;
}

std::string signed_words(double value, int digits) {
  const std::string words = fmt::format("{:+.{}f}", value, digits);
  return words.front() == '-' ? "\u2212" + words.substr(1) : words;
}

float Rows::next(const std::string& words) {
  const float wide = std::min(ImGui::CalcTextSize(words.c_str()).x + px(20), width_);
  if (used_ > 0 && used_ + wide <= width_)
    ImGui::SameLine();
  else
    used_ = 0;
  used_ += wide + ImGui::GetStyle().ItemSpacing.x;
  return wide;
}

void words_at_end(ImFont* font, ImU32 color, const std::string& words) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float end = at.x + ImGui::GetContentRegionAvail().x;
  text(*ImGui::GetWindowDrawList(), font, {end - width_of(font, words), at.y}, color, words);
  ImGui::NewLine();
}

void kelvin_ramp(ImVec2 size) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  constexpr int kSteps = 48;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const auto color = [](int i) {
    return chip(
        kelvin_color(kKelvinMin * std::pow(kKelvinMax / kKelvinMin, double{1} * i / kSteps) * 0.9999 + 0.1));
  };
  for (int i = 0; i < kSteps; ++i) {
    const float x0 = at.x + size.x * static_cast<float>(i) / kSteps,
                x1 = at.x + size.x * static_cast<float>(i + 1) / kSteps;
    draw.AddRectFilledMultiColor({x0, at.y}, {x1, at.y + size.y}, color(i), color(i + 1), color(i + 1),
                                 color(i));
  }
  ImGui::Dummy(size);
}

void tip(const char* text) {
  if (!ImGui::IsItemHovered()) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(px(320));
  ImGui::TextUnformatted(text);
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

std::string fitting(const std::string& line, float width) {
  if (ImGui::CalcTextSize(line.c_str()).x <= width) return line;
  std::string cut = line;
  while (!cut.empty() && ImGui::CalcTextSize((cut + "...").c_str()).x > width) {
    while (cut.size() > 1 && (static_cast<unsigned char>(cut.back()) & 0xc0) == 0x80) cut.pop_back();
    cut.pop_back();
  }
  return cut + "...";
}

void dashed_frame(ImDrawList& draw, ImVec2 low, ImVec2 high) {
  const float dash = px(8), gap = px(7), thick = px(1.5f);
  for (float x = low.x; x < high.x; x += dash + gap)
    for (const float y : {low.y, high.y})
      draw.AddLine({x, y}, {std::min(x + dash, high.x), y}, palette::kFaint, thick);
  for (float y = low.y; y < high.y; y += dash + gap)
    for (const float x : {low.x, high.x})
      draw.AddLine({x, y}, {x, std::min(y + dash, high.y)}, palette::kFaint, thick);
}

void card(ImDrawList& draw, ImVec2 at, ImVec2 size) {
  draw.AddRectFilled(at, {at.x + size.x, at.y + size.y}, IM_COL32(18, 19, 21, 225), px(8));
}

void text(ImDrawList& draw, ImFont* font, ImVec2 at, ImU32 color, const std::string& line) {
  draw.AddText(font, font->FontSize, at, color, line.c_str());
}

float width_of(ImFont* font, const std::string& line) {
  return font->CalcTextSizeA(font->FontSize, FLT_MAX, 0, line.c_str()).x;
}

}  // namespace sconce::viewer
