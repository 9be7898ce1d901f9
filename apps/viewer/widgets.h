// SPDX-License-Identifier: Apache-2.0
// The few controls that Dear ImGui does not have.
#pragma once

#include <string>

#include "viewer/theme.h"

namespace sconce::viewer {

struct FaderMove {
  bool moved = false, released = false;
  double gain = 1;
  ImVec4 place{0, 0, 0, 0};  ///< of the track: x, y, width, height
};
/// A fader over stops: dragged (Shift: finely), wheel with Ctrl a tenth of a stop, double click 0 EV.
/// @param color  of the light
FaderMove fader_track(const char* id, double gain, ImU32 color, bool on);

/// A button that is lit or not. @return whether it was pressed
bool toggle(const char* id, const char* label, bool lit, ImU32 color, float width);
/// A lamp's switch: a disk of its colour, or a ring.
bool light_switch(const char* id, bool on, ImU32 color);
bool color_chip(const char* id, ImU32 color, float width);
/// Its name and its value above the track, none of them under the hand. @param words  of the value
bool slider(const char* id, const char* name, const std::string& words, float* value, float low, float high,
            ImGuiSliderFlags flags = 0);
/// `+0.5`, with a true minus.
std::string signed_words(double value, int digits);
/// Buttons as wide as their words, in as many rows as they need.
class Rows {
 public:
  explicit Rows(float width) : width_(width) {}
  /// Before each. @return its width
  float next(const std::string& words);

 private:
  float width_, used_ = 0;
};
/// Words at the right end of the line that is being written.
void words_at_end(ImFont* font, ImU32 color, const std::string& words);
/// Black bodies from kKelvinMin to kKelvinMax, as the logarithmic slider above it.
void kelvin_ramp(ImVec2 size);
/// Where something may be dropped.
void dashed_frame(ImDrawList& draw, ImVec2 low, ImVec2 high);
/// A card over the picture, and text on it.
void card(ImDrawList& draw, ImVec2 at, ImVec2 size);
void text(ImDrawList& draw, ImFont* font, ImVec2 at, ImU32 color, const std::string& line);
float width_of(ImFont* font, const std::string& line);
/// Of the last control, when the pointer rests on it.
void tip(const char* text);
/// The line, cut with "..." where it is wider, in the font that is in use.
std::string fitting(const std::string& line, float width);

}  // namespace sconce::viewer
