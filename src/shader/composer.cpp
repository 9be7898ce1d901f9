// SPDX-License-Identifier: Apache-2.0
#include "shader/composer.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"

namespace sconce {

namespace {

/// "v.rgb" of a texture's value times the weights of its groups.
constexpr const char* kChannel[] = {"r", "g", "b", "a"};

class Composer {
 public:
  explicit Composer(const ShaderSpec& spec) : spec_(spec) {
    for (const LayerTexture& texture : spec.textures) {
      encodings_.push_back(tier_encoding(*spec.tier, texture.encoding, texture.coefficient > 0));
      directional_ |= !by_texel() && texture.coefficient > 0;
    }
    share_samplers();
  }

  ComposedShader compose() {
    const bool whole = spec_.form != ShaderSpec::Form::functions;
    if (spec_.form == ShaderSpec::Form::compute && !spec_.target->compute)
      throw Error({}, std::string(spec_.target->name) + " has no compute shaders", "glsl450");
    for (const LayerTexture& texture : spec_.textures)
      if (by_texel() && texture.coefficient != spec_.textures.front().coefficient)
        throw Error({}, "an atlas is mixed for one coefficient at a time");
    if (whole) text_ += spec_.target->head;
    text_ +=
        fmt::format("// Mixes {} light groups out of {} textures.\n\n", spec_.groups, spec_.textures.size());
    declare();
    decoders();
    for (std::size_t t = 0; t < spec_.textures.size(); ++t) {
      texel_function(t);
      if (!by_texel()) value_function(t);
    }
    mix_function();
    if (whole) main_function();
    return {std::move(text_), std::move(samplers_)};
  }

 private:
  /// Atlas and compute shaders look at one texel of every texture and never between.
  bool by_texel() const {
    return spec_.form == ShaderSpec::Form::atlas || spec_.form == ShaderSpec::Form::compute;
  }

  bool linear(const Encoding& e) const {
    const bool is_float = e.type == TexelType::f32 || e.type == TexelType::f16;
    return e.filters && (!is_float || spec_.tier->filter);
  }

  /// Plain textures as long as the units suffice, then arrays of a kind.
  void share_samplers() {
    int plain = 0;
    for (const EncodingChoice& choice : encodings_) plain += choice.encoding->planes;
    arrays_ = plain > spec_.units - kReservedUnits ||
              (spec_.form == ShaderSpec::Form::functions && spec_.pages > 1);
    for (std::size_t t = 0; t < encodings_.size(); ++t) {
      const EncodingChoice& choice = encodings_[t];
      std::size_t s = samplers_.size();
      if (arrays_)
        for (s = 0; s < samplers_.size() && !(samplers_[s].encoding == choice); ++s) {
        }
      first_.push_back({s, 0});
      if (s < samplers_.size()) first_.back().slice = samplers_[s].slices.size();
      for (int plane = 0; plane < choice.encoding->planes; ++plane) {
        if (!arrays_ || s == samplers_.size())
          samplers_.push_back({fmt::format("sconce_layers_{}", samplers_.size()),
                               choice,
                               arrays_,
                               linear(*choice.encoding),
                               {}});
        ShaderSampler& sampler = arrays_ ? samplers_[s] : samplers_.back();
        for (int page = 0; page < (arrays_ ? spec_.pages : 1); ++page)
          sampler.slices.push_back({t, plane, page});
      }
    }
  }

  void declare() {
    for (const ShaderSampler& sampler : samplers_)
      text_ += fmt::format("uniform {} {};  // {}\n", sampler.array ? "sampler2DArray" : "sampler2D",
                           sampler.name, sampler.encoding.name());
    text_ += fmt::format("uniform vec3 sconce_weight[{}];\n\n", std::max<std::size_t>(1, spec_.groups));
  }

  void decoders() {
    std::vector<const Encoding*> done;
    for (const EncodingChoice& choice : encodings_) {
      if (std::find(done.begin(), done.end(), choice.encoding) != done.end()) continue;
      done.push_back(choice.encoding);
      const std::string_view glsl = choice.encoding->glsl;
      text_ += glsl.substr(glsl.find('\n') + 1);  // without the licence line
      text_ += "\n";
    }
  }

  /// The gain as an expression of `page`; declares the table that it needs.
  std::string gain(std::size_t t) {
    if (!encodings_[t].encoding->has_gain) return "vec4(1.0)";
    const std::string name = fmt::format("sconce_gain_{}", t);
    std::string values;
    for (int page = 0; page < spec_.pages; ++page) {
      const auto& g = spec_.textures[t].gain.at(static_cast<std::size_t>(page));
      values += fmt::format("{}vec4({:.9e}, {:.9e}, {:.9e}, {:.9e})", page == 0 ? "" : ", ", g[0], g[1], g[2],
                            g[3]);
    }
    text_ += fmt::format("const vec4 {}[{}] = vec4[{}]({});\n", name, spec_.pages, spec_.pages, values);
    return name + "[page]";
  }

  /// `call` of every plane, decoded. @param place  of the sampler's coordinates: "{0}" stands for the slice
  std::string decoded(std::size_t t, const char* function, const std::string& at, const char* vector,
                      const char* level, const std::string& gain) const {
    const EncodingChoice& choice = encodings_[t];
    std::string planes;
    for (int plane = 0; plane < choice.encoding->planes; ++plane) {
      const auto p = static_cast<std::size_t>(plane);
      const std::string& name = samplers_[first_[t].sampler + (arrays_ ? 0 : p)].name;
      std::string place = at;
      if (arrays_) {
        const std::size_t slice = first_[t].slice + p * static_cast<std::size_t>(spec_.pages);
        const bool whole = vector[0] == 'i';
        place = fmt::format(fmt::runtime(whole ? "{}({}, {} + page)" : "{}({}, float({} + page))"), vector,
                            at, slice);
      }
      planes += fmt::format("{}({}, {}{}), ", function, name, place, level);
    }
    return fmt::format("decode_{}({}{})", choice.encoding->name, planes, gain);
  }

  void texel_function(std::size_t t) {
    const bool wanted = by_texel() || !linear(*encodings_[t].encoding);
    const std::string g = gain(t);
    gains_.push_back(g);
    if (!wanted) return;
    text_ += fmt::format("vec4 sconce_texel_{}(ivec2 at, int page) {{\n  return {};\n}}\n\n", t,
                         decoded(t, "texelFetch", "at", "ivec3", ", 0", g));
  }

  /// Interpolated between texel centres, clamped at the edges of the page: by the texture unit, or here.
  void value_function(std::size_t t) {
    text_ += fmt::format("vec4 sconce_value_{}(vec2 uv, int page) {{\n", t);
    if (linear(*encodings_[t].encoding)) {
      text_ += "  return " + decoded(t, "texture", "uv", "vec3", "", gains_[t]) + ";\n}\n\n";
      return;
    }
    const std::string& sampler = samplers_[first_[t].sampler].name;
    text_ += fmt::format(
        "  ivec2 last = textureSize({0}, 0){1} - 1;\n"
        "  vec2 at = clamp(uv * vec2(last + 1) - 0.5, vec2(0.0), vec2(last));\n"
        "  ivec2 low = ivec2(at), high = min(low + 1, last);\n"
        "  vec2 part = at - vec2(low);\n"
        "  return mix(mix(sconce_texel_{2}(low, page), sconce_texel_{2}(ivec2(high.x, low.y), page), "
        "part.x),\n"
        "             mix(sconce_texel_{2}(ivec2(low.x, high.y), page), sconce_texel_{2}(high, page), "
        "part.x), "
        "part.y);\n}}\n\n",
        sampler, arrays_ ? ".xy" : "", t);
  }

  void mix_function() {
    const bool texel = by_texel();
    text_ += fmt::format(
        "// Illuminance in lux{}.\nvec3 sconce_illuminance({}, int page{}) {{\n  vec3 sum = vec3(0.0);\n",
        directional_ ? "; offset: the mapped normal minus the surface's, world space" : "",
        texel ? "ivec2 at" : "vec2 uv", directional_ ? ", vec3 offset" : "");
    if (std::any_of(spec_.textures.begin(), spec_.textures.end(),
                    [](const LayerTexture& t) { return t.encoding.luminance; }))
      text_ += "  vec4 y;\n";
    for (std::size_t t = 0; t < spec_.textures.size(); ++t) {
      const LayerTexture& texture = spec_.textures[t];
      const std::string value =
          texel ? fmt::format("sconce_texel_{}(at, page)", t) : fmt::format("sconce_value_{}(uv, page)", t);
      if (!texture.encoding.luminance) {
        constexpr const char* kAlong[] = {"", "offset.x * ", "offset.y * ", "offset.z * "};
        text_ += fmt::format("  sum += {}sconce_weight[{}] * {}.rgb;\n",
                             kAlong[directional_ ? texture.coefficient : 0], texture.groups.front(), value);
        continue;
      }
      text_ += fmt::format("  y = {};\n", value);
      for (std::size_t i = 0; i < texture.groups.size(); ++i)
        text_ += fmt::format("  sum += sconce_weight[{}] * y.{};\n", texture.groups[i], kChannel[i]);
    }
    text_ += directional_ ? "  return max(sum, vec3(0.0));\n}\n\n" : "  return sum;\n}\n\n";
  }

  void main_function() {
    switch (spec_.form) {
      case ShaderSpec::Form::functions:
        return;
      case ShaderSpec::Form::picture:
        return picture();
      case ShaderSpec::Form::atlas:
        text_ +=
            "uniform int sconce_page;\nout vec4 sconce_color;\n\nvoid main() {\n"
            "  sconce_color = vec4(sconce_illuminance(ivec2(gl_FragCoord.xy), sconce_page), 1.0);\n}\n";
        return;
      case ShaderSpec::Form::compute:
        text_ +=
            "layout(local_size_x = 16, local_size_y = 16) in;\nuniform int sconce_page;\n"
            "uniform writeonly image2D sconce_mixed;\n\nvoid main() {\n"
            "  ivec2 at = ivec2(gl_GlobalInvocationID.xy);\n"
            "  if (any(greaterThanEqual(at, imageSize(sconce_mixed)))) return;\n"
            "  imageStore(sconce_mixed, at, vec4(sconce_illuminance(at, sconce_page), 1.0));\n}\n";
        return;
    }
  }

  void picture() {
    if (spec_.tone != nullptr)
      text_ += (spec_.lut != nullptr ? tone_glsl(*spec_.lut) : tone_glsl(*spec_.tone)) +
               "\nuniform ToneParams sconce_tone;\n";
    text_ +=
        "uniform int sconce_page;\nuniform vec3 sconce_albedo, sconce_emission;  // cd/m2, weighted\n"
        "uniform float sconce_exposure;\n\nin vec2 sconce_uv;\n";
    if (directional_) text_ += "in vec3 sconce_offset;\n";
    text_ += fmt::format(
        "out vec4 sconce_color;\n\nvoid main() {{\n"
        "  vec3 light = sconce_illuminance(sconce_uv, sconce_page{});\n",
        directional_ ? ", sconce_offset" : "");
    text_ += "  vec3 seen = (sconce_albedo * 0.318309886 * light + sconce_emission) * sconce_exposure;\n";
    text_ += spec_.tone != nullptr
                 ? "  sconce_color = vec4(linear_to_srgb(tone_map(seen, sconce_tone)), 1.0);\n}\n"
                 : "  sconce_color = vec4(seen, 1.0);\n}\n";
  }

  struct Place {
    std::size_t sampler, slice;
  };

  const ShaderSpec& spec_;
  std::vector<EncodingChoice> encodings_;  ///< as uploaded, per texture
  std::vector<ShaderSampler> samplers_;
  std::vector<Place> first_;  ///< per texture: its first plane
  std::vector<std::string> gains_;
  bool arrays_ = false;
  bool directional_ = false;  ///< holds textures of g
  std::string text_;
};

}  // namespace

ComposedShader compose(const ShaderSpec& spec) {
  return Composer(spec).compose();
}

}  // namespace sconce
