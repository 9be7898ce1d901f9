// SPDX-License-Identifier: Apache-2.0
#include "shader_lamp.h"

#include <array>

#include "core/error.h"
#include "core/files.h"
#include "core/text.h"
#include "import/lights.h"

namespace sconce::app {

namespace {

using Shadow = gpu::LampShader::Shadow;

/// `none`, `cube`, `sun`, or how wide one map opens, in degrees.
void set_shadow(const std::string& text, const std::string& where, gpu::LampShader& lamp) {
  for (const auto& [name, shadow] :
       {std::pair("none", Shadow::none), std::pair("cube", Shadow::cube), std::pair("sun", Shadow::sun)})
    if (text == name) {
      lamp.shadow = shadow;
      return;
    }
  const auto degrees = parse_number(text);
  if (!degrees || !(*degrees > 0 && *degrees <= 150))
    throw UsageError(where, "shadow=" + text,
                     "none, cube, sun, or the angle of one map in degrees, up to 150");
  lamp.shadow = Shadow::map;
  lamp.opening = static_cast<float>(*degrees) * kPi / 180;
}

gpu::LampUniform uniform(const std::string& name, const std::vector<std::string>& words) {
  gpu::LampUniform out{name, {}, join(words, ",")};
  for (const std::string& word : words)
    if (const auto number = parse_number(word)) out.numbers.push_back(static_cast<float>(*number));
  if (out.numbers.size() != words.size()) out.numbers.clear();
  return out;
}

}  // namespace

gpu::LampShader parse_shader_lamp(const std::string& text, const std::string& where) {
  constexpr std::array kPlace{"name", "position", "target", "direction", "intensity", "color", "kelvin"};
  gpu::LampShader lamp;
  LightWords place{"point", {}};
  bool strong = false, placed = false;
  for (const auto& [key, words] : split_light(text, where).values) {
    if (key == "file") {
      lamp.file = join(words, ",");
    } else if (key == "shadow") {
      set_shadow(join(words, ","), where, lamp);
    } else if (std::find(kPlace.begin(), kPlace.end(), key) != kPlace.end()) {
      place.values.emplace_back(key, words);
      strong = strong || key == "intensity";
      placed = placed || key == "position";
    } else {
      lamp.uniforms.push_back(uniform(key, words));
    }
  }
  if (lamp.file.empty()) throw UsageError(where, "names no file", "shader,file=NAME.glsl,...");
  if (!strong) place.values.push_back({"intensity", {"1"}});
  if (!placed && lamp.shadow == Shadow::sun) place.values.push_back({"position", {"0", "0", "0"}});
  const Light light = parse_light(place, where);
  lamp.name = light.name.empty() ? lamp.file : light.name;
  lamp.frame = light.frame;
  lamp.intensity = light.intensity;
  lamp.text = read_file(lamp.file);
  return lamp;
}

}  // namespace sconce::app
