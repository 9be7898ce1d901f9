// SPDX-License-Identifier: Apache-2.0
#include "core/error.h"
#include "image/io.h"
#include "import/import.h"
#include "import/side_parts.h"
#include "scene/daylight.h"
#include "scene/sun_position.h"

namespace sconce {

namespace {

Image read_sky(const SideContext& context, const SideTable& table, const std::string& file) {
  try {
    return rgb_of(read_image(context.path.parent_path() / file));
  } catch (const Error& e) {
    table.fail("file", e.what(), "a lat-long .hdr, .exr or 8-bit picture");
  }
}

/// A sky by formula. @param sun  where the side file has one
Image make_sky(const SideTable& table, const SkyKind& kind, const std::optional<Vec3>& sun) {
  if (kind.needs_sun && !sun)
    table.fail("kind", "'" + std::string(kind.name) + "' needs to know where the sun is", "a table [sun]");
  Daylight daylight;
  daylight.sun = sun.value_or(daylight.sun);
  daylight.turbidity = table.number("turbidity").value_or(daylight.turbidity);
  if (!(daylight.turbidity >= 1.7 && daylight.turbidity <= 10))
    table.fail("turbidity", "is out of range", "1.7 to 10");
  daylight.ground = table.not_negative("ground").value_or(daylight.ground);
  if (daylight.ground > 1) table.fail("ground", "is out of range", "a reflectance, 0 to 1");
  return sky_picture(kind, daylight, table.positive("illuminance").value_or(0));
}

SunPosition find_sun(const SideTable& table) {
  if (table.has("latitude") || table.has("longitude") || table.has("time")) {
    for (const char* key : {"latitude", "longitude", "time"})
      if (!table.has(key)) table.fail(key, "is missing", "latitude, longitude and time go together");
    const double latitude = *table.number("latitude"), longitude = *table.number("longitude");
    if (!(std::abs(latitude) <= 90)) table.fail("latitude", "is out of range", "-90 to 90, north positive");
    if (!(std::abs(longitude) <= 180))
      table.fail("longitude", "is out of range", "-180 to 180, east positive");
    const std::string text = table.text("time").value_or("");
    const auto time = parse_time(text, longitude);
    if (!time) table.fail("time", "'" + text + "' is no time", "\"2026-06-21T15:00+02:00\"");
    return sun_position(*time, latitude, longitude);
  }
  SunPosition sun;
  const auto elevation = table.number("elevation");
  if (!elevation)
    table.fail({}, "has no place", "direction, or elevation and azimuth, or latitude, longitude and time");
  sun.elevation = *elevation;
  sun.azimuth = table.number("azimuth").value_or(sun.azimuth);
  if (!(std::abs(sun.elevation) <= 90)) table.fail("elevation", "is out of range", "-90 to 90 degrees");
  return sun;
}

void add_sky(Scene& scene, Light light) {
  std::erase_if(scene.lights, [](const Light& l) { return std::holds_alternative<SkyLight>(l.shape); });
  scene.lights.push_back(std::move(light));
}

}  // namespace

std::optional<Vec3> apply_sun(const SideContext& context, const SideNode& node) {
  const SideTable table(context.path.string(), "[sun]", node,
                        {"direction", "elevation", "azimuth", "latitude", "longitude", "time", "north",
                         "illuminance", "color", "kelvin", "group"});
  Vec3 towards;
  if (const auto direction = table.vector("direction")) {
    if (!(glm::length(*direction) > 0)) table.fail("direction", "has no length");
    towards = -glm::normalize(*direction);
  } else {
    towards = towards_sun(find_sun(table), table.number("north").value_or(0));
  }
  const double elevation =
      std::asin(std::clamp(static_cast<double>(towards.y), -1.0, 1.0)) * 180 / std::acos(-1.0);
  if (elevation <= 0) {
    context.progress.warn(table.where() + " is below the horizon; it gives no light");
    return towards;
  }
  Light light;
  light.name = "sun";
  light.frame = looking(Vec3(0), -towards);
  light.shape = SunLight{};
  light.intensity =
      table.lamp_color().value_or(Rgb(1)) *
      static_cast<float>(table.not_negative("illuminance").value_or(clear_sun_illuminance(elevation)));
  light.group_name = table.text("group").value_or("sun");
  context.scene.lights.push_back(std::move(light));
  return towards;
}

void apply_sky(const SideContext& context, const SideNode& node, const std::optional<Vec3>& sun) {
  const SideTable table(context.path.string(), "[sky]", node,
                        {"kind", "file", "luminance", "illuminance", "turbidity", "ground", "color", "kelvin",
                         "intensity", "rotate", "group"});
  Light light;
  light.name = "sky";
  SkyLight sky;
  light.intensity =
      table.lamp_color().value_or(Rgb(1)) * static_cast<float>(table.not_negative("intensity").value_or(1));
  const auto file = table.text("file");
  const std::string kind = table.text("kind").value_or(file ? "file" : "");
  for (const char* key : {"file", "luminance"})
    if (table.has(key) && !kind.empty() && !(kind == "file" && std::string_view(key) == "file"))
      table.fail(key, "stands beside " + std::string(kind == "file" ? "file" : "kind"),
                 "one of kind, file with intensity, luminance");
  if (kind == "file") {
    if (!file) table.fail("file", "is missing", "a lat-long .hdr, .exr or 8-bit picture");
    sky.image = read_sky(context, table, *file);
  } else if (!kind.empty()) {
    sky.image = make_sky(table, table.row("kind", kind, sky_kinds(), ", file"), sun);
  } else if (const auto level = table.not_negative("luminance")) {
    light.intensity *= static_cast<float>(*level);
  } else {
    table.fail({}, "has neither a kind, a picture nor a strength", "kind, file, or luminance in cd/m2");
  }
  if (kind.empty() || kind == "file")
    for (const char* key : {"illuminance", "turbidity", "ground"})
      if (table.has(key)) table.fail(key, "is for skies by formula", "kind = \"cie-overcast\"");
  const float turn = static_cast<float>(table.number("rotate").value_or(0)) * kPi / 180;
  const float c = std::cos(turn), s = std::sin(turn);
  light.frame[0] = glm::vec4(c, 0, -s, 0);
  light.frame[2] = glm::vec4(s, 0, c, 0);
  light.group_name = table.text("group").value_or("sky");
  light.shape = std::move(sky);
  add_sky(context.scene, std::move(light));
}

void add_default_sky(Scene& scene, const Progress& progress) {
  const bool emits = std::any_of(scene.instances.begin(), scene.instances.end(), [&](const Instance& i) {
    return scene.emits(i) && !scene[i.mesh].triangles.empty();
  });
  if (!scene.lights.empty() || emits) return;
  progress.warn(scene.name +
                ": the scene has no lights; it gets an overcast sky of 10,000 lx. Add emissive materials or "
                "KHR_lights_punctual lamps to it, or [[light]], [[luminaire]], [[emission]] or [sky] to the "
                "side file " +
                scene.name + ".toml beside it");
  Light light;
  light.name = light.group_name = "sky";
  light.intensity = Rgb(1);
  light.shape = SkyLight{sky_picture(sky_kinds().front(), {})};
  add_sky(scene, std::move(light));
}

}  // namespace sconce
