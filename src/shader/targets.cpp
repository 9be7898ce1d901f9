// SPDX-License-Identifier: Apache-2.0
// The tables of dialects and tiers.
#include "core/find_row.h"
#include "shader/composer.h"

namespace sconce {

namespace {

constexpr ShaderTarget kTargets[] = {
    {"glsl450", "OpenGL 4.5", "#version 450 core\n", true},
    {"glsl330", "OpenGL 3.3", "#version 330 core\n", false},
    {"glsl300es", "OpenGL ES 3.0, WebGL 2",
     "#version 300 es\nprecision highp float;\nprecision highp int;\nprecision highp sampler2D;\nprecision "
     "highp "
     "sampler2DArray;\n",
     false},
};

constexpr ShaderTier kTiers[] = {
    {"full", "floats and blocks, all filtered", true, true, true, true},
    {"half", "halves, filtered", false, true, false, true},
    {"unfiltered", "floats, fetched by absolute texel and filtered in the shader", true, true, false, false},
    {"byte", "8-bit channels only", false, false, false, false},
};

constexpr struct {
  ShaderSpec::Form form;
  std::string_view name;
} kForms[] = {{ShaderSpec::Form::picture, "picture"},
              {ShaderSpec::Form::functions, "functions"},
              {ShaderSpec::Form::atlas, "atlas"},
              {ShaderSpec::Form::compute, "compute"}};

}  // namespace

std::span<const ShaderTarget> shader_targets() {
  return kTargets;
}
const ShaderTarget& find_shader_target(std::string_view name) {
  return find_row(shader_targets(), name, "shader target");
}
std::span<const ShaderTier> shader_tiers() {
  return kTiers;
}
const ShaderTier& find_shader_tier(std::string_view name) {
  return find_row(shader_tiers(), name, "tier");
}

ShaderSpec::Form find_shader_form(std::string_view name) {
  return find_row(kForms, name, "shader form").form;
}

EncodingChoice tier_encoding(const ShaderTier& tier, const EncodingChoice& encoding, bool is_signed) {
  const auto with = [&](const char* name) {
    return EncodingChoice{&find_encoding(name), encoding.luminance};
  };
  const char* const eight_bits = encoding.luminance ? "multi8" : is_signed ? "srgbe8" : "rgbe8";
  switch (encoding.encoding->type) {
    case TexelType::f32:
      return tier.f32 ? encoding : with(tier.f16 ? "f16" : eight_bits);
    case TexelType::f16:
      return tier.f16 ? encoding : with(eight_bits);
    case TexelType::bc6h:
      return tier.bc6h ? encoding : with(tier.f16 ? "f16" : eight_bits);
    case TexelType::u8:
      break;
  }
  return encoding;
}

}  // namespace sconce
