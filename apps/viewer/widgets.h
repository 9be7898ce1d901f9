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
/// Black bodies from kKelvinMin to kKelvinMax, as the logarithmic slider above it.
void kelvin_ramp(ImVec2 size);
/// A card over the picture, and text on it.
void card(ImDrawList& draw, ImVec2 at, ImVec2 size);
void text(ImDrawList& draw, ImFont* font, ImVec2 at, ImU32 color, const std::string& line);
float width_of(ImFont* font, const std::string& line);
/// Of the last control, when the pointer rests on it.
void tip(const char* text);
/// The line, cut with "..." where it is wider, in the font that is in use.
std::string fitting(const std::string& line, float width);

}  // namespace sconce::viewer
