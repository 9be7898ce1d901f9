// SPDX-License-Identifier: Apache-2.0
// Another renderer's picture: as large as there is room, dragged, and enlarged around the pointer.
#include <fmt/format.h>

#include <cmath>

#include "viewer/viewer.h"
#include "viewer/widgets.h"

namespace sconce::viewer {

void Viewer::draw_sheet(ImVec2 at, ImVec2 size) {
  begin_picture(at, size);
  const bool hovered = ImGui::IsItemHovered();
  const ImGuiIO& io = ImGui::GetIO();
  const OpenedPicture& opened = state_.sheet->opened();
  const Vec2 pixels(opened.width(), opened.height()), room(size.x, size.y), corner(at.x, at.y);
  SheetPlace& place = state_.place;
  const float fit = std::min(room.x / pixels.x, room.y / pixels.y);
  const auto top_left = [&] { return corner + 0.5f * room - fit * place.zoom * place.middle * pixels; };
  const Vec2 mouse(io.MousePos.x, io.MousePos.y);
  const auto under = [&] { return (mouse - top_left()) / (fit * place.zoom); };
  if (hovered && io.MouseWheel != 0) {
    const Vec2 held = under();
    place.zoom = std::clamp(place.zoom * std::exp2(0.25f * io.MouseWheel), 1.0f, 64.0f / fit);
    place.middle += (held - under()) / pixels;
  }
  if (ImGui::IsItemActive() && io.MouseDown[0])
    place.middle -= Vec2(io.MouseDelta.x, io.MouseDelta.y) / (fit * place.zoom * pixels);
  // No further than its edges.
  const Vec2 half = glm::min(0.5f * room / (fit * place.zoom * pixels), Vec2(0.5f));
  place.middle = glm::clamp(place.middle, half, 1.0f - half);
  attempt([&] { state_.sheet->draw(*state_.session, state_.look, state_.scale()); });

  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.PushClipRect(at, {at.x + size.x, at.y + size.y}, true);
  const Vec2 from = top_left(), to = from + fit * place.zoom * pixels;
  draw.AddImage(state_.sheet->texture(), {from.x, from.y}, {to.x, to.y});
  legend(draw);
  const Vec2 pixel = under();
  if (state_.reading && hovered && glm::all(glm::greaterThanEqual(pixel, Vec2(0))) &&
      glm::all(glm::lessThan(pixel, pixels))) {
    const PictureReading r = read_pixel(opened, state_.session->mix(), pixel);
    const auto [x, y] = reading_card(draw, r.groups);
    const std::string value = fmt::format("{:.3g}", luminance(r.value));
    text(draw, fonts().large, {x, y}, palette::kText, value);
    text(draw, fonts().small, {x + px(112), y + px(6)}, palette::kText,
         fmt::format("{:.0f}, {:.0f}", std::floor(pixel.x), std::floor(pixel.y)));
    text(draw, fonts().small, {x, y + px(42)}, palette::kDim,
         fmt::format("{:.3g}  {:.3g}  {:.3g}", r.value.r, r.value.g, r.value.b));
  }
  draw.PopClipRect();
  ImGui::End();
}

}  // namespace sconce::viewer
