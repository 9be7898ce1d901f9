// SPDX-License-Identifier: Apache-2.0
// Shaders that mix the layers of a package: from what the textures are to text, without any OpenGL (system A,
// "dynamic shader generation").
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "encode/layer_texture.h"
#include "tone/lut.h"

namespace sconce {

/// Dialects of GLSL.
struct ShaderTarget {
  std::string_view name, doc, head;  ///< head: the first lines of a shader
  bool compute;                      ///< has compute shaders
};
/// glsl450, glsl330, glsl300es; in this order.
std::span<const ShaderTarget> shader_targets();
/// @throws UsageError naming the choices
const ShaderTarget& find_shader_target(std::string_view name);

/// What a device's textures can do: table 1 of system A's paper for today. Where a device cannot take an
/// encoding, the host uploads another (tier_encoding).
struct ShaderTier {
  std::string_view name, doc;
  bool f32, f16, bc6h;  ///< such textures exist
  bool filter;          ///< texture units interpolate floats
};
/// full, half, unfiltered, byte; in this order, best first. Without any shader: the software mix.
std::span<const ShaderTier> shader_tiers();
/// @throws UsageError naming the choices
const ShaderTier& find_shader_tier(std::string_view name);
/// What is uploaded for an encoding: itself, halves for full floats, or 8-bit codes that hold as much.
/// @param is_signed  as coefficients of a basis are
EncodingChoice tier_encoding(const ShaderTier& tier, const EncodingChoice& encoding, bool is_signed = false);

/// Texture units that a composed shader leaves to its host: maps of the surface, a tone table.
inline constexpr int kReservedUnits = 4;

struct ShaderSpec {
  enum class Form : uint8_t {
    functions,  ///< vec3 sconce_illuminance(vec2 uv, int page) in lux, bilinear; no version line, no main.
                ///< With textures of g: (vec2 uv, int page, vec3 offset), offset = n - n_s in world space
    picture,    ///< a fragment shader: tone(albedo / pi * E + emission), sRGB
    atlas,      ///< a fragment shader that mixes one page of one coefficient texel by texel, in lux
    compute,    ///< the same as a compute shader
  } form = Form::picture;
  std::vector<LayerTexture> textures;  ///< with gains for every page; of all coefficients that are wanted
  std::size_t groups = 0;              ///< weights
  int pages = 1;
  int units = 16;  ///< texture units of a fragment shader, at least 8; beyond, textures of a kind share
                   ///< arrays, and always where functions serve several pages
  const ShaderTarget* target = nullptr;
  const ShaderTier* tier = nullptr;
  const ToneMapper* tone = nullptr;  ///< of a picture
  const ToneLut* lut = nullptr;      ///< instead of the formula, where given
};

/// @throws UsageError naming the choices
ShaderSpec::Form find_shader_form(std::string_view name);

/// A sampler of the composed shader and what lies in it.
struct ShaderSampler {
  std::string name;
  EncodingChoice encoding;  ///< as uploaded
  bool array = false;
  bool linear = false;  ///< texture units interpolate; otherwise the shader does, after decoding
  /// Slices in order, or the only one: (index of the texture, plane, page). The page of a plain texture is
  /// the drawn one.
  struct Slice {
    std::size_t texture;
    int plane, page;
  };
  std::vector<Slice> slices;
};

struct ComposedShader {
  std::string text;
  std::vector<ShaderSampler> samplers;
};

/// Uniforms beside the samplers: vec3 sconce_weight[groups], the weight of each group times its colour where
/// its luminance is packed. A picture also has vec3 sconce_albedo, vec3 sconce_emission (cd/m2, weighted),
/// float sconce_exposure and ToneParams sconce_tone, and with textures of g the input vec3 sconce_offset;
/// atlas and compute have int sconce_page; a sampler2D tone_lut comes with a table.
/// @throws Error when the target has no such form, or coefficients are mixed that must stay apart
ComposedShader compose(const ShaderSpec& spec);

}  // namespace sconce
