// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "import/side_parts.h"

namespace sconce {

namespace {

constexpr float kConeEdge = 0.001f;  // least width of the cone's ramp in cosines (KHR_lights_punctual)

float radians(double degrees) {
  return static_cast<float>(degrees) * kPi / 180.0f;
}

/// Lumens of a lamp of 1 cd: a sphere, or the cone with its squared ramp.
float flux_of_one_candela(const Light& light) {
  const auto* spot = std::get_if<SpotLight>(&light.shape);
  if (spot == nullptr) return 4 * kPi;
  const float cap = 1 - std::cos(spot->outer);
  const float edge = std::min(cap, std::max(kConeEdge, std::cos(spot->inner) - std::cos(spot->outer)));
  return 2 * kPi * (cap - edge + edge / 3);
}

void set_shape(const SideTable& table, Light& light, bool fresh) {
  const auto type = table.text("type");
  if (fresh && !type)
    table.fail({}, "has no type and is not the name of a light in the scene", "type = point, spot, sun");
  if (type) {
    if (*type == "point") {
      if (!std::holds_alternative<PointLight>(light.shape)) light.shape = PointLight{};
    } else if (*type == "spot") {
      if (!std::holds_alternative<SpotLight>(light.shape)) light.shape = SpotLight{};
    } else if (*type == "sun") {
      light.shape = SunLight{};
    } else {
      table.fail("type", "'" + *type + "' is unknown", "point, spot, sun");
    }
  }
  auto* spot = std::get_if<SpotLight>(&light.shape);
  auto* point = std::get_if<PointLight>(&light.shape);
  for (const char* key : {"inner", "outer"})
    if (table.has(key) && spot == nullptr) table.fail(key, "is for spots only");
  if (spot != nullptr) {
    if (const auto outer = table.positive("outer")) spot->outer = radians(*outer);
    if (const auto inner = table.not_negative("inner"))
      spot->inner = radians(*inner);
    else if (table.has("outer"))
      spot->inner = std::min(spot->inner, spot->outer);
    if (spot->inner > spot->outer || spot->outer > kPi / 2 + 1e-5f)
      table.fail(table.has("inner") ? "inner" : "outer", "is out of range",
                 "degrees from the axis, 0 <= inner <= outer <= 90");
  }
  if (const auto range = table.not_negative("range")) {
    if (spot != nullptr)
      spot->range = static_cast<float>(*range);
    else if (point != nullptr)
      point->range = static_cast<float>(*range);
    else
      table.fail("range", "is for points and spots only");
  }
}

void set_place(const SideTable& table, Light& light, bool fresh) {
  const bool sun = std::holds_alternative<SunLight>(light.shape);
  const auto position = table.vector("position");
  if (fresh && !position && !sun) table.fail({}, "has no position", "position = [x, y, z] in metres");
  if (!fresh && !position && !table.has("direction") && !table.has("target")) return;
  const Vec3 at = position.value_or(Vec3(light.frame[3]));
  Vec3 direction = fresh ? Vec3(0, -1, 0) : -Vec3(light.frame[2]);
  if (table.has("direction") && table.has("target"))
    table.fail("target", "stands beside direction", "one of the two");
  if (const auto given = table.vector("direction")) direction = *given;
  if (const auto target = table.vector("target")) direction = *target - at;
  if (!(glm::length(direction) > 0))
    table.fail(table.has("target") ? "target" : "direction", "has no length");
  light.frame = looking(at, direction);
}

void set_strength(const SideTable& table, Light& light, bool fresh) {
  const float before = luminance(light.intensity);
  const auto color = table.lamp_color();
  const Rgb tone = color ? *color : before > 0 ? light.intensity / before : Rgb(1);
  if (table.has("intensity") && table.has("lumens"))
    table.fail("lumens", "stands beside intensity", "one of the two");
  float strength = before;
  if (const auto intensity = table.not_negative("intensity")) {
    strength = static_cast<float>(*intensity);
  } else if (const auto lumens = table.not_negative("lumens")) {
    if (std::holds_alternative<SunLight>(light.shape))
      table.fail("lumens", "means nothing for a sun", "intensity in lux");
    strength = static_cast<float>(*lumens) / flux_of_one_candela(light);
  } else if (fresh) {
    table.fail({}, "has no strength", "intensity (cd; lux for a sun) or lumens");
  }
  light.intensity = tone * strength;
}

}  // namespace

void apply_light(const SideContext& context, const SideNode& node) {
  const SideTable table(context.path.string(), "[[light]]", node,
                        {"name", "type", "position", "direction", "target", "intensity", "lumens", "color",
                         "kelvin", "inner", "outer", "range", "group"});
  const std::string name = table.text("name").value_or("");
  std::vector<Light*> lights;
  for (Light& light : context.scene.lights)
    if (!name.empty() && light.name == name && !std::holds_alternative<SkyLight>(light.shape))
      lights.push_back(&light);
  const bool fresh = lights.empty();
  Light added;
  added.name = name;
  if (fresh) lights = {&added};
  for (Light* light : lights) {
    set_shape(table, *light, fresh);
    set_place(table, *light, fresh);
    set_strength(table, *light, fresh);
    if (const auto group = table.text("group")) light->group_name = *group;
  }
  if (fresh) context.scene.lights.push_back(std::move(added));
}

}  // namespace sconce
