// SPDX-License-Identifier: Apache-2.0
// Colours, fonts and measures of the window.
#pragma once

#include <imgui.h>

#include "core/rgb.h"

namespace sconce::viewer {

/// @param scale  of the display
void set_theme(float scale);

struct Fonts {
  ImFont *text = nullptr, *strong = nullptr, *small = nullptr, *large = nullptr;
};
/// Of the current ImGui context.
const Fonts& fonts();
/// A measure that is right at scale 1.
float px(float at_scale_1);

namespace palette {
inline constexpr ImU32 kPanel = IM_COL32(26, 27, 30, 255), kRaised = IM_COL32(37, 38, 42, 255),
                       kHover = IM_COL32(49, 50, 55, 255), kTrack = IM_COL32(17, 18, 20, 255),
                       kLine = IM_COL32(52, 54, 59, 255), kText = IM_COL32(226, 227, 230, 255),
                       kDim = IM_COL32(142, 145, 152, 255), kFaint = IM_COL32(92, 95, 102, 255),
                       kAccent = IM_COL32(242, 176, 84, 255), kAccentDim = IM_COL32(242, 176, 84, 90),
                       kSolo = IM_COL32(250, 214, 80, 255), kMute = IM_COL32(226, 92, 86, 255),
                       kGood = IM_COL32(120, 196, 130, 255);
}  // namespace palette

/// Light as a chip of colour: as bright as a display can, its hue kept.
ImU32 chip(const Rgb& linear);
/// @param share  of the colour's own opacity
ImU32 faded(ImU32 color, float share);

}  // namespace sconce::viewer
