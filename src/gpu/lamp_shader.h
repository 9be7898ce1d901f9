// SPDX-License-Identifier: Apache-2.0
// Lamps as the device shades them: any function of a point and a normal, in GLSL.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "light/lamp.h"

namespace sconce::gpu {

/// A value for one of a shader's uniforms: numbers, or for a sampler2D a picture or its file.
struct LampUniform {
  std::string name;
  std::vector<float> numbers{};
  std::string text{};                              ///< what was given, where that is no list of numbers
  std::shared_ptr<const Image> picture = nullptr;  ///< RGB, instead of a file
};

/// `vec3 light(vec3 P, vec3 N)` (gpu/lamp_head.glsl) and what is set before it is asked.
struct LampShader {
  enum class Shadow : uint8_t {
    none,
    map,   ///< one map along the axis; nothing is lit outside of it
    cube,  ///< all around
    sun,   ///< parallel light along the axis, fitted to the scene
  };
  std::string name;     ///< of the lamp, for messages
  std::string file;     ///< that the text is from, for messages
  std::string text;     ///< GLSL
  Mat4 frame{1.0f};     ///< points along -z
  Rgb intensity{1.0f};  ///< lamp_intensity
  Shadow shadow = Shadow::cube;
  float opening = 0;  ///< of one map, radians
  int side = 1024;    ///< of a map, texels
  std::vector<LampUniform> uniforms;
};

/// A lamp of a kind that OpenGL does not move.
class UnknownLamp : public Error {
 public:
  using Error::Error;
};

/// Lamps that the CPU knows: points, spots, suns and projectors by themselves, meshes and openings of
/// luminaires as `patches` small ones each. Light fields have none: NearLights.
/// @param chosen  number and weight of each
/// @param side    of their maps; a quarter for patches
/// @throws UnknownLamp: sky
std::vector<LampShader> lamp_shaders(const Lamps& lamps, std::span<const std::pair<std::size_t, Rgb>> chosen,
                                     int patches, int side);

}  // namespace sconce::gpu
