// SPDX-License-Identifier: Apache-2.0
// The big picture: drawing it, moving in it, and what is drawn over it.
#include <fmt/format.h>

#include <algorithm>

#include "scene/lens.h"
#include "viewer/viewer.h"
#include "viewer/widgets.h"

namespace sconce::viewer {

namespace {

PictureParams params_of(ImVec2 size) {
  return {.width = std::max(static_cast<int>(size.x), 1),
          .height = std::max(static_cast<int>(size.y), 1),
          .samples = 1};
}

}  // namespace

void Viewer::begin_picture(ImVec2 at, ImVec2 size) {
  state_.canvas_at = at, state_.canvas_size = size;
  ImGui::SetNextWindowPos(at);
  ImGui::SetNextWindowSize(size);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::Begin("picture", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoScrollWithMouse |
                   ImGuiWindowFlags_NoNav);
  ImGui::PopStyleVar();
  ImGui::InvisibleButton("canvas", size,
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                             ImGuiButtonFlags_MouseButtonMiddle);
}

void Viewer::draw_canvas(ImVec2 at, ImVec2 size) {
  begin_picture(at, size);
  navigate();
  const PictureParams p = params_of(size);
  attempt([&] {
    drawing_more_ |= state_.canvas->draw(
        *state_.session, {state_.camera, p.width, p.height, state_.look, state_.scale()}, state_.movers());
    follow_mirrors();
    if (state_.look == LookKind::reference && reference_ && traced_)
      state_.canvas->set_reference(reference_->picture(*traced_, state_.canvas->mix()), *state_.session);
  });
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImVec2 end(at.x + size.x, at.y + size.y);
  draw.AddImage(state_.canvas->texture(), at, end);
  if (state_.look == LookKind::reference) {
    const float middle = at.x + 0.5f * size.x;
    const bool there = reference_ && traced_;
    if (there) draw.AddImage(state_.canvas->reference(), {middle, at.y}, end, {0.5f, 0}, {1, 1});
    draw.AddLine({middle, at.y}, {middle, end.y}, palette::kAccent, px(1.5f));
    const auto label = [&](float x, const std::string& words) {
      card(draw, {x, at.y + px(10)}, {width_of(fonts().small, words) + px(16), px(24)});
      text(draw, fonts().small, {x + px(8), at.y + px(14)}, palette::kText, words);
    };
    label(middle + px(10),
          there ? fmt::format("path traced, {} paths per pixel", traced_->samples) : "path tracing begins");
    label(middle - px(30) - width_of(fonts().small, "lightmap"), "lightmap");
  }
  overlays();
  lamp_overlay();
  object_overlay();
  ImGui::End();
}

void Viewer::navigate() {
  const ImGuiIO& io = ImGui::GetIO();
  const bool hovered = ImGui::IsItemHovered(), active = ImGui::IsItemActive();
  const PictureParams p = params_of(state_.canvas_size);
  const Vec2 at(io.MousePos.x - state_.canvas_at.x, io.MousePos.y - state_.canvas_at.y);
  if (hold_lamp(at) || hold_object(at)) return;
  const Opened& opened = *state_.opened;
  const float reach = std::max(rays().world().bounds.diagonal(), 0.1f);
  if (hovered && !active) {
    state_.under = read_pixel(rays(), opened.layers, state_.session->mix(), state_.camera, p, at,
                              state_.canvas->moved_pages(state_.movers()));
  } else if (!hovered) {
    state_.under.reset();
  }
  const bool on_surface = state_.under && state_.under->surface;
  const Vec3 eye(state_.camera.frame[3]);
  if (hovered && on_surface && !state_.under->object.empty() &&
      ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left))
    choose_object(state_.under->object);
  if (ImGui::IsItemActivated()) {
    const Vec3 ahead =
        Lens(state_.camera, p).direction({0.5f * state_.canvas_size.x, 0.5f * state_.canvas_size.y});
    state_.pivot = on_surface ? state_.under->position : eye + 0.3f * reach * ahead;
    if (io.KeyCtrl && on_surface && io.MouseDown[0]) {
      const Lens lens(state_.camera, p);
      const Hit hit = rays().tracer().closest({lens.eye(), lens.direction(at)});
      const LightmapSide& side = rays().side(hit.triangle, hit.back);
      if (hit && side.page >= 0)
        add_goal(state_.under->position, state_.under->normal, 300,
                 layers_at(opened.layers, side.page, side.at(hit.barycentric)));
      state_.pivot.reset();
    }
  }
  const Vec2 drag(io.MouseDelta.x, io.MouseDelta.y);
  if (active && state_.pivot && drag != Vec2(0)) {
    const Vec2 turn = 2.5f / state_.canvas_size.y * Vec2(drag.x, -drag.y);
    const float pixel = 2 * std::tan(0.5f * state_.camera.yfov) / state_.canvas_size.y *
                        std::max(glm::length(*state_.pivot - eye), 0.2f);
    if (io.MouseDown[2] || (io.MouseDown[0] && io.KeyShift))
      state_.camera = pan(state_.camera, pixel * Vec2(-drag.x, drag.y));
    else if (io.MouseDown[1])
      state_.camera =
          look_around(state_.camera, state_.camera.yfov / state_.canvas_size.y * Vec2(drag.x, -drag.y));
    else if (io.MouseDown[0])
      state_.camera = orbit(state_.camera, *state_.pivot, turn);
  }
  if (hovered && io.MouseWheel != 0)
    state_.camera = approach(state_.camera,
                             on_surface ? state_.under->position : eye - reach * Vec3(state_.camera.frame[2]),
                             0.12f * io.MouseWheel);
  if (io.WantTextInput || io.KeyCtrl) return;
  const auto held = [](const char* key) { return ImGui::IsKeyDown(key_of(key)) ? 1.0f : 0.0f; };
  const Vec3 way(held("d") - held("a"), held("e") - held("q"), held("w") - held("s"));
  if (way != Vec3(0)) {
    const float speed = 0.25f * reach * (io.KeyShift ? 3.0f : 1.0f);
    state_.camera = fly(state_.camera, speed * std::min(io.DeltaTime, 0.1f) * way);
    drawing_more_ = true;
  }
}

void Viewer::overlays() {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImVec2 at = state_.canvas_at, size = state_.canvas_size;
  const MixSpec mix = state_.session->mix();
  const Lens from = lens();
  draw.PushClipRect(at, {at.x + size.x, at.y + size.y}, true);

  ball_overlay(draw, from);
  const MeasuredPlane& plane = state_.plane.measured;
  if (state_.plane.shown && plane.light.samples > 0) {
    const std::vector<float> lux = lux_of(plane.light, mix);
    const std::vector<uint8_t> dark = unreached(plane.light);
    const LuxStatistics s = lux_statistics(lux_of(plane.light, mix, dark));
    const FalseColor scale = fitting_scale(2 * std::max(s.average, 1.0), false);
    std::size_t i = 0;
    for (int row = 0; row < plane.grid.rows; ++row)
      for (int column = 0; column < plane.grid.columns; ++column, ++i) {
        const auto spot = on_screen(from, plane.grid.point(column, row));
        if (!spot || dark[i] != 0) continue;
        const Rgb c = false_color(scale.place(lux[i]));
        const auto byte = [](float v) { return static_cast<int>(255 * v + 0.5f); };
        draw.AddCircleFilled(*spot, px(4.5f), IM_COL32(0, 0, 0, 150), 16);
        draw.AddCircleFilled(*spot, px(3.5f), IM_COL32(byte(c.r), byte(c.g), byte(c.b), 255), 16);
        const std::string number = fmt::format("{:.0f}", lux[i]);
        const ImVec2 place(spot->x - 0.5f * width_of(fonts().small, number), spot->y - px(19));
        text(draw, fonts().small, {place.x + 1, place.y + 1}, IM_COL32(0, 0, 0, 220), number);
        text(draw, fonts().small, place, IM_COL32(255, 255, 255, 240), number);
      }
  }
  for (std::size_t i = 0; i < state_.goals.size(); ++i) {
    const auto spot = on_screen(from, state_.goals[i].position);
    if (!spot) continue;
    const std::string label = fmt::format("{}  {:.0f} lux", i + 1, state_.goals[i].target);
    const ImVec2 at_label(spot->x + px(15), spot->y - px(8));
    draw.AddRectFilled({at_label.x - px(4), at_label.y - px(2)},
                       {at_label.x + width_of(fonts().small, label) + px(4), at_label.y + px(16)},
                       IM_COL32(18, 19, 21, 215), px(4));
    draw.AddCircle(*spot, px(9), IM_COL32(0, 0, 0, 160), 24, px(4));
    draw.AddCircle(*spot, px(9), palette::kAccent, 24, px(2));
    text(draw, fonts().small, at_label, palette::kAccent, label);
  }

  legend(draw);

  if (state_.reading && state_.under && !state_.under->group_lux.empty()) {
    const Reading& r = *state_.under;
    const auto [x, y] = reading_card(draw, r.group_lux);
    const float total = luminance(r.illuminance);
    const std::string lux = fmt::format("{:.{}f}", total, total < 10 ? 1 : 0);
    text(draw, fonts().large, {x, y}, palette::kText, lux);
    text(draw, fonts().small, {x + width_of(fonts().large, lux) + px(6), y + px(16)}, palette::kDim, "lux");
    text(draw, fonts().small, {x + px(112), y + px(6)}, palette::kText,
         fmt::format("{:.3g} cd/m\u00b2", r.luminance));
    text(draw, fonts().small, {x + px(112), y + px(22)}, palette::kDim,
         fmt::format("albedo {:.2f}", luminance(r.albedo)));
    text(draw, fonts().small, {x, y + px(42)}, palette::kDim,
         r.material.empty() ? r.object : r.object + " \u00b7 " + r.material);
  }
  draw.PopClipRect();
}

void Viewer::legend(ImDrawList& draw) {
  if (row_of(state_.look).unit.empty()) return;
  const ImVec2 at = state_.canvas_at, size = state_.canvas_size;
  const FalseColor& scale = state_.scale();
  const float bar = px(14), tall = std::min(px(300), size.y - px(80)), x = at.x + px(26), y = at.y + px(54);
  card(draw, {x - px(14), y - px(40)}, {px(112), tall + px(58)});
  text(draw, fonts().strong, {x, y - px(30)}, palette::kText,
       state_.sheet ? "luminance" : std::string(row_of(state_.look).unit));
  constexpr int kSteps = 64;
  for (int i = 0; i < kSteps; ++i) {
    const Rgb c = false_color((static_cast<float>(i) + 0.5f) / kSteps);
    const auto byte = [](float v) { return static_cast<int>(255 * v + 0.5f); };
    const float y0 = y + tall * (1 - static_cast<float>(i + 1) / kSteps),
                y1 = y + tall * (1 - static_cast<float>(i) / kSteps);
    draw.AddRectFilled({x, y0}, {x + bar, y1 + 0.5f}, IM_COL32(byte(c.r), byte(c.g), byte(c.b), 255));
  }
  for (const float tick : legend_ticks(scale)) {
    const float ty = y + tall * (1 - scale.place(tick));
    draw.AddLine({x + bar, ty}, {x + bar + px(5), ty}, palette::kText);
    text(draw, fonts().small, {x + bar + px(10), ty - px(8)}, palette::kText, tick_text(tick));
  }
}

ImVec2 Viewer::reading_card(ImDrawList& draw, const std::vector<float>& light) {
  const MixSpec mix = state_.session->mix();
  std::vector<std::size_t> order;
  float total = 0;
  for (std::size_t g = 0; g < light.size(); ++g) {
    total += light[g];
    if (light[g] > 0) order.push_back(g);
  }
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return light[a] > light[b]; });
  order.resize(std::min<std::size_t>(order.size(), 6));
  const ImVec2 box(px(236), px(84) + px(19) * static_cast<float>(order.size()));
  const ImVec2 corner(state_.canvas_at.x + px(12),
                      state_.canvas_at.y + state_.canvas_size.y - box.y - px(12));
  card(draw, corner, box);
  const ImVec2 at(corner.x + px(14), corner.y + px(8));
  float y = at.y + px(64);
  for (const std::size_t g : order) {
    const float share = light[g] / std::max(total, 1e-9f);
    draw.AddRectFilled({at.x, y + px(13)}, {at.x + px(208) * std::min(share, 1.0f), y + px(15)},
                       chip(state_.session->groups()[g].color * mix.weights[g]), px(1));
    text(draw, fonts().small, {at.x, y - px(2)}, palette::kText, state_.session->groups()[g].name);
    const std::string percent = fmt::format("{:.0f} %", 100 * share);
    text(draw, fonts().small, {at.x + px(208) - width_of(fonts().small, percent), y - px(2)}, palette::kDim,
         percent);
    y += px(19);
  }
  return at;
}

}  // namespace sconce::viewer
