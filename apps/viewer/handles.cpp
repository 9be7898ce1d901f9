// SPDX-License-Identifier: Apache-2.0
// Arrows and a square that lamps and objects are dragged by.
#include <fmt/format.h>

#include "viewer/viewer.h"
#include "viewer/widgets.h"

namespace sconce::viewer {

namespace {

constexpr float kArrow = 78;  // pixels

ImU32 color_of(Grip grip) {
  switch (grip) {
    case Grip::x:
      return IM_COL32(232, 92, 84, 255);
    case Grip::y:
      return IM_COL32(128, 204, 96, 255);
    case Grip::z:
      return IM_COL32(96, 152, 240, 255);
    default:
      return palette::kAccent;
  }
}

}  // namespace

Lens Viewer::lens() const {
  return Lens(state_.camera, {.width = std::max(static_cast<int>(state_.canvas_size.x), 1),
                              .height = std::max(static_cast<int>(state_.canvas_size.y), 1)});
}

std::optional<ImVec2> Viewer::on_screen(const Lens& from, const Vec3& point) const {
  const auto at = project(from, point);
  if (!at) return std::nullopt;
  return ImVec2(state_.canvas_at.x + at->x, state_.canvas_at.y + at->y);
}

std::optional<ImVec2> Viewer::handle_at(const Vec3& place, Grip grip) const {
  const Lens from = lens();
  return on_screen(from, Gizmo::of(from, place, px(kArrow)).tip(grip));
}

bool Viewer::take_grip(Drag& drag, const Vec3& place, Vec2 at) const {
  const Lens from = lens();
  drag.start = place, drag.from = at;
  drag.grip = Gizmo::of(from, place, px(kArrow)).at(from, at, px(kNear));
  return drag.held = drag.grip != Grip::none;
}

void Viewer::draw_handles(const Vec3& place, Grip held, const std::string& name) const {
  const Lens from = lens();
  const auto middle = on_screen(from, place);
  if (!middle) return;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const Gizmo gizmo = Gizmo::of(from, place, px(kArrow));
  std::vector<ImVec2> square;
  for (const Vec3& corner : gizmo.square())
    if (const auto p = on_screen(from, corner)) square.push_back(*p);
  const auto lit = [&](Grip grip) { return held == grip ? palette::kText : color_of(grip); };
  if (square.size() == 4) {
    draw.AddConvexPolyFilled(square.data(), 4, faded(lit(Grip::floor), 0.35f));
    draw.AddPolyline(square.data(), 4, lit(Grip::floor), ImDrawFlags_Closed, px(1.5f));
  }
  for (const Grip grip : {Grip::x, Grip::y, Grip::z}) {
    const auto tip = on_screen(from, gizmo.tip(grip));
    if (!tip) continue;
    draw.AddLine(*middle, *tip, IM_COL32(0, 0, 0, 140), px(5));
    draw.AddLine(*middle, *tip, lit(grip), px(2.5f));
    draw.AddCircleFilled(*tip, px(5), lit(grip), 16);
  }
  const std::string line = fmt::format("{}   {:.2f}, {:.2f}, {:.2f} m", name, place.x, place.y, place.z);
  const ImVec2 size = ImGui::CalcTextSize(line.c_str()), corner(middle->x + px(14), middle->y - px(34));
  draw.AddRectFilled({corner.x - px(6), corner.y - px(3)},
                     {corner.x + size.x + px(6), corner.y + size.y + px(3)}, IM_COL32(18, 19, 21, 215),
                     px(5));
  draw.AddText(corner, palette::kText, line.c_str());
}

}  // namespace sconce::viewer
