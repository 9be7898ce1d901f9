// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "import/side_parts.h"

namespace sconce {

namespace {

constexpr float kConeEdge = 0.001f;  // least width of the cone's ramp in cosines (KHR_lights_punctual)

float radians(double degrees) {
  return static_cast<float>(degrees) * kPi / 180.0f;
}

/// Lumens of a lamp of strength 1: a sphere, the cone with its squared ramp, a projector's picture in white,
/// or what its table says.
float flux_of_one(const Scene& scene, const Light& light) {
  if (const auto* measured = std::get_if<LuminaireLight>(&light.shape))
    return static_cast<float>(flux(scene[measured->luminaire].photometry));
  if (const auto* projector = std::get_if<ProjectorLight>(&light.shape)) {
    const float half = std::tan(0.5f * projector->yfov);
    return 4 * half * half * projector->aspect;
  }
  const auto* spot = std::get_if<SpotLight>(&light.shape);
  if (spot == nullptr) return 4 * kPi;
  const float cap = 1 - std::cos(spot->outer);
  const float edge = std::min(cap, std::max(kConeEdge, std::cos(spot->inner) - std::cos(spot->outer)));
  return 2 * kPi * (cap - edge + edge / 3);
}

/// The lamp as one of that shape, with what it has where it is one.
template <class Shape>
Shape& as(Light& light) {
  if (!std::holds_alternative<Shape>(light.shape)) light.shape = Shape{};
  return std::get<Shape>(light.shape);
}

void set_range(const SideTable& table, float& range) {
  if (const auto given = table.not_negative("range")) range = static_cast<float>(*given);
}

void set_point(const SideContext&, const SideTable& table, Light& light) {
  set_range(table, as<PointLight>(light).range);
}

void set_spot(const SideContext&, const SideTable& table, Light& light) {
  auto& spot = as<SpotLight>(light);
  set_range(table, spot.range);
  if (const auto outer = table.positive("outer")) spot.outer = radians(*outer);
  if (const auto inner = table.not_negative("inner"))
    spot.inner = radians(*inner);
  else if (table.has("outer"))
    spot.inner = std::min(spot.inner, spot.outer);
  if (spot.inner > spot.outer || spot.outer > kPi / 2 + 1e-5f)
    table.fail(table.has("inner") ? "inner" : "outer", "is out of range",
               "degrees from the axis, 0 <= inner <= outer <= 90");
}

void set_sun(const SideContext&, const SideTable&, Light& light) {
  as<SunLight>(light);
}

struct Kind {
  std::string_view name;
  void (*apply)(const SideContext&, const SideTable&, Light&);
  std::vector<std::string_view> keys;  ///< that not all lamps have
  bool (*is)(const Light&);  ///< whether a lamp that is there goes on as one without being told its type
};

template <class Shape>
bool is(const Light& light) {
  return std::holds_alternative<Shape>(light.shape);
}
bool is_none(const Light&) {
  return false;
}

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> rows{
      {"point", set_point, {"range"}, is<PointLight>},
      {"spot", set_spot, {"inner", "outer", "range"}, is<SpotLight>},
      {"sun", set_sun, {}, is<SunLight>},
      {"area", set_panel, {"size", "radius", "roll"}, is_none},
      {"projector", set_projector, {"file", "fov", "aspect", "roll"}, is_none},
  };
  return rows;
}

bool has(const Kind& kind, std::string_view key) {
  return std::find(kind.keys.begin(), kind.keys.end(), key) != kind.keys.end();
}

void set_shape(const SideContext& context, const SideTable& table, Light& light, bool fresh) {
  const auto type = table.text("type");
  if (fresh && !type)
    table.fail({}, "has no type and is not the name of a light in the scene",
               "type = point, spot, sun, area, projector");
  const auto known = std::find_if(kinds().begin(), kinds().end(), [&](const Kind& k) { return k.is(light); });
  const Kind* kind = type ? &table.row("type", *type, kinds()) : known != kinds().end() ? &*known : nullptr;
  for (const Kind& other : kinds())
    for (const std::string_view key : other.keys) {
      if (!table.has(key) || (kind != nullptr && has(*kind, key))) continue;
      std::string owners;
      for (const Kind& k : kinds())
        if (has(k, key)) owners += (owners.empty() ? "" : " and ") + std::string(k.name) + "s";
      table.fail(key, "is for " + owners + " only");
    }
  if (kind != nullptr) kind->apply(context, table, light);
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
  if (const auto roll = table.number("roll"))
    light.frame = light.frame * glm::rotate(Mat4(1.0f), radians(*roll), Vec3(0, 0, 1));
}

void set_strength(const Scene& scene, const SideTable& table, Light& light, bool fresh) {
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
    strength = static_cast<float>(*lumens) / flux_of_one(scene, light);
  } else if (fresh) {
    table.fail({}, "has no strength", "intensity (cd; lux for a sun) or lumens");
  }
  light.intensity = tone * strength;
}

}  // namespace

void apply_light(const SideContext& context, const SideNode& node) {
  const SideTable table(
      context.path.string(), "[[light]]", node,
      {"name", "type", "position", "direction", "target", "intensity", "lumens", "color", "kelvin", "inner",
       "outer", "range", "group", "size", "radius", "roll", "file", "fov", "aspect"});
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
    set_shape(context, table, *light, fresh);
    set_place(table, *light, fresh);
    set_strength(context.scene, table, *light, fresh);
    if (const auto group = table.text("group")) light->group_name = *group;
  }
  if (fresh) context.scene.lights.push_back(std::move(added));
}

}  // namespace sconce
