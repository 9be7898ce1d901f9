// SPDX-License-Identifier: Apache-2.0
#include "viewer/theme.h"

#include <algorithm>
#include <filesystem>

namespace sconce::viewer {

namespace {

struct Theme {
  Fonts fonts;
  float scale = 1;
};
/// Kept in ImGui's own context, so that it ends with it.
Theme& theme() {
  return *static_cast<Theme*>(ImGui::GetIO().UserData);
}

/// The first font that is installed (packages.txt); ImGui's own where there is none.
ImFont* load(std::initializer_list<const char*> files, float size) {
  ImGuiIO& io = ImGui::GetIO();
  static constexpr ImWchar ranges[] = {0x20, 0xff, 0x2010, 0x2027, 0x2190, 0x2195, 0x2212, 0x2212, 0};
  for (const char* file : files) {
    std::error_code ignored;
    if (std::filesystem::exists(file, ignored))
      return io.Fonts->AddFontFromFileTTF(file, size, nullptr, ranges);
  }
  return io.Fonts->AddFontDefault();
}

ImVec4 color(ImU32 code) {
  return ImGui::ColorConvertU32ToFloat4(code);
}

void set_colors(ImGuiStyle& style) {
  ImGui::StyleColorsDark();
  const auto set = [&](ImGuiCol which, ImU32 code) { style.Colors[which] = color(code); };
  set(ImGuiCol_WindowBg, palette::kPanel);
  set(ImGuiCol_ChildBg, IM_COL32(0, 0, 0, 0));
  set(ImGuiCol_PopupBg, IM_COL32(32, 33, 37, 252));
  set(ImGuiCol_Border, palette::kLine);
  set(ImGuiCol_Text, palette::kText);
  set(ImGuiCol_TextDisabled, palette::kDim);
  set(ImGuiCol_FrameBg, palette::kTrack);
  set(ImGuiCol_FrameBgHovered, palette::kRaised);
  set(ImGuiCol_FrameBgActive, palette::kHover);
  set(ImGuiCol_Button, palette::kRaised);
  set(ImGuiCol_ButtonHovered, palette::kHover);
  set(ImGuiCol_ButtonActive, palette::kAccentDim);
  set(ImGuiCol_Header, palette::kRaised);
  set(ImGuiCol_HeaderHovered, palette::kHover);
  set(ImGuiCol_HeaderActive, palette::kHover);
  set(ImGuiCol_CheckMark, palette::kAccent);
  set(ImGuiCol_SliderGrab, palette::kAccent);
  set(ImGuiCol_SliderGrabActive, palette::kAccent);
  set(ImGuiCol_Separator, palette::kLine);
  set(ImGuiCol_ScrollbarBg, IM_COL32(0, 0, 0, 0));
  set(ImGuiCol_ScrollbarGrab, palette::kHover);
  set(ImGuiCol_TextSelectedBg, palette::kAccentDim);
  set(ImGuiCol_Tab, palette::kPanel);
  set(ImGuiCol_TabHovered, palette::kHover);
  set(ImGuiCol_TabActive, palette::kRaised);
  set(ImGuiCol_PlotHistogram, palette::kAccent);
  set(ImGuiCol_NavHighlight, palette::kAccent);
}

}  // namespace

void set_theme(float scale) {
  static Theme kept;  // ImGui's user data is a bare pointer
  ImGuiIO& io = ImGui::GetIO();
  io.UserData = &kept;
  kept.scale = scale;
  const auto inter = [&](const char* style, float size) {
    const std::string folder = "/usr/share/fonts/opentype/inter/Inter-";
    const std::string file = folder + style + ".otf";
    return load({file.c_str(), "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"}, size * scale);
  };
  kept.fonts = {inter("Regular", 15), inter("SemiBold", 15), inter("Regular", 12.5f), inter("Light", 30)};
  io.FontDefault = kept.fonts.text;
  ImGuiStyle& style = ImGui::GetStyle();
  set_colors(style);
  style.WindowRounding = 0, style.ChildRounding = 6, style.FrameRounding = 5, style.PopupRounding = 7;
  style.GrabRounding = 5, style.ScrollbarRounding = 6, style.TabRounding = 5;
  style.WindowBorderSize = 0, style.PopupBorderSize = 1, style.FrameBorderSize = 0;
  style.WindowPadding = {14, 12}, style.FramePadding = {9, 5}, style.ItemSpacing = {8, 7};
  style.ItemInnerSpacing = {6, 5}, style.ScrollbarSize = 10, style.GrabMinSize = 10;
  style.ScaleAllSizes(scale);
}

const Fonts& fonts() {
  return theme().fonts;
}

float px(float at_scale_1) {
  return at_scale_1 * theme().scale;
}

ImU32 chip(const Rgb& linear) {
  const float most = std::max(linear.max(), 1e-6f);
  const auto code = [&](float v) {
    return static_cast<int>(255 * linear_to_srgb(std::clamp(v / most, 0.0f, 1.0f)) + 0.5f);
  };
  return IM_COL32(code(linear.r), code(linear.g), code(linear.b), 255);
}

ImU32 faded(ImU32 code, float share) {
  const auto alpha = static_cast<ImU32>(static_cast<float>(code >> IM_COL32_A_SHIFT) * share);
  return (code & ~IM_COL32_A_MASK) | (alpha << IM_COL32_A_SHIFT);
}

}  // namespace sconce::viewer
