// SPDX-License-Identifier: Apache-2.0
#include "lamp_kinds.h"

#include <fmt/format.h>

#include <filesystem>

#include "core/error.h"
#include "core/text.h"
#include "import/lights.h"
#include "shader_lamp.h"

namespace sconce::app {

namespace {

constexpr LampKind kKinds[] = {
    {"point", "point", false, "lumens", ""},
    {"spot", "spot,inner=20,outer=35", true, "lumens", ""},
    {"area", "area,size=0.6,0.6", true, "lumens", ""},
    {"projector", "", true, "lumens", ".png, .jpg, .hdr"},
    {"sun", "sun,direction=-1,-2,-1,intensity=50000,kelvin=5500", true, "", ""},
    {"luminaire", "", true, "", ".ies, .ldt, .gldf, .xml"},
    {"shader", "", true, "intensity", ".glsl"},
};

const LampKind& kind_of(const std::string& words, const std::string& where) {
  const std::string name = words.substr(0, words.find(','));
  std::vector<std::string> known;
  for (const LampKind& kind : kKinds) {
    if (kind.name == name) return kind;
    known.emplace_back(kind.name);
  }
  throw UsageError(where, "unknown kind of lamp '" + name + "'" + did_you_mean(name, known),
                   join(known, ", "));
}

bool says(const std::string& words, std::string_view key) {
  return words.find("," + std::string(key) + "=") != std::string::npos;
}

bool says_any(const std::string& words, std::initializer_list<std::string_view> keys) {
  return std::any_of(keys.begin(), keys.end(), [&](std::string_view key) { return says(words, key); });
}

/// With a place, and a direction and strength where they say none.
std::string completed(const LampKind& kind, const Lamp& lamp, const LampPlace& at, std::string words) {
  // Not within its own body.
  const Vec3 axis = axis_of(lamp).value_or(Vec3(0)), place = at.position + 0.01f * axis;
  const auto vector = [](const Vec3& v) { return fmt::format("{:.6f},{:.6f},{:.6f}", v.x, v.y, v.z); };
  words += ",position=" + vector(place);
  if (kind.points && !says_any(words, {"target", "direction", "aim"}))
    words += at.target ? ",target=" + vector(*at.target)
                       : ",direction=" + vector(axis != Vec3(0) ? axis : Vec3(0, -1, 0));
  const double lumens = std::max(static_cast<double>(luminance(lamp.flux)), 1e-6);
  if (!kind.strength.empty() && !says_any(words, {"lumens", "intensity"}))
    words += fmt::format(",{}={:.6g}", kind.strength,
                         kind.strength == "lumens" ? lumens : lumens / (4 * double{kPi}));
  return words;
}

}  // namespace

std::span<const LampKind> lamp_kinds() {
  return kKinds;
}

std::string kind_of_file(const std::string& file) {
  const std::string extension = lower(std::filesystem::path(file).extension().string());
  for (const LampKind& kind : kKinds)
    for (const std::string& one : split(kind.file, ','))
      if (!extension.empty() && trim(one) == extension) return std::string(kind.name) + ",file=" + file;
  return {};
}

OtherKind parse_kind(const std::string& words, const std::string& where, const Progress& progress) {
  if (kind_of(words, where).name == "shader") return parse_shader_lamp(words, where);
  try {
    return parse_lights(words, where, progress);
  } catch (const Error& e) {
    throw UsageError({}, e.what());  // what a file would call an error is here a wrong use
  }
}

OtherKind become(const Lamp& lamp, const LampPlace& at, const std::string& words, const std::string& where,
                 const Progress& progress) {
  OtherKind made = parse_kind(completed(kind_of(words, where), lamp, at, words), where, progress);
  const float flux = luminance(lamp.flux);
  if (says_any(words, {"color", "kelvin", "cct"}) || !(flux > 0)) return made;
  const Rgb color = lamp.flux / flux;
  if (auto* shader = std::get_if<gpu::LampShader>(&made)) {
    shader->intensity = shader->intensity * color;
    return made;
  }
  auto& more = std::get<MoreLights>(made);
  // A light field has colours of its own.
  const bool field = !more.luminaires.empty() && more.luminaires.front().field != nullptr;
  for (Light& light : more.lights)
    if (!field) light.intensity = light.intensity * color;
  return made;
}

}  // namespace sconce::app
