// SPDX-License-Identifier: Apache-2.0
#include <glm/gtc/matrix_transform.hpp>

#include "import/side_parts.h"

namespace sconce {

namespace {

struct Unit {
  std::string_view name;
  double metres;
};
constexpr Unit kUnits[] = {{"mm", 0.001}, {"cm", 0.01}, {"m", 1}, {"inch", 0.0254}, {"foot", 0.3048}};

/// Turns and moves a frame that must not be scaled.
void place(Mat4& frame, const Mat4& turn, float scale) {
  frame = turn * frame;
  frame[3] = glm::vec4(scale * Vec3(frame[3]), 1);
}

}  // namespace

void apply_scene(const SideContext& context, const SideNode& node) {
  const SideTable table(context.path.string(), "[scene]", node, {"unit", "up"});
  float scale = 1;
  if (const auto unit = table.text("unit"))
    scale = static_cast<float>(table.row("unit", *unit, kUnits).metres);
  Mat4 turn(1);
  if (const auto up = table.text("up")) {
    if (*up != "y" && *up != "z") table.fail("up", "'" + *up + "' is unknown", "y, z");
    if (*up == "z") turn = glm::rotate(turn, -kPi / 2, Vec3(1, 0, 0));
  }
  const Mat4 world = glm::scale(turn, Vec3(scale));
  for (Instance& instance : context.scene.instances) instance.transform = world * instance.transform;
  for (Camera& camera : context.scene.cameras) place(camera.frame, turn, scale);
  for (Light& light : context.scene.lights) {
    place(light.frame, turn, scale);
    if (auto* point = std::get_if<PointLight>(&light.shape)) point->range *= scale;
    if (auto* spot = std::get_if<SpotLight>(&light.shape)) spot->range *= scale;
  }
}

}  // namespace sconce
