// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "core/error.h"
#include "encode/half.h"
#include "mix/tier_layers.h"
#include "web/parts.h"

namespace sconce::web {

namespace {

/// @param coefficients  of the basis
EncodedLayers layers_of(const Package& package, std::size_t coefficients,
                        const std::optional<EncodingChoice>& encoding) {
  if (!encoding) return read_layers(package, coefficients);
  const Manifest& m = package.manifest();
  if (coefficients > 1 && (encoding->luminance || !encoding->encoding->is_signed))
    throw UsageError(
        "--encoding",
        encoding->name() + " cannot hold the signed basis " + std::string(basis_row(m.basis).name),
        "f32, f16, srgbe8");
  std::vector<Rgb> colors;
  for (const GroupInfo& group : m.groups) colors.push_back(group.color);
  EncodedLayers layers;
  for (std::size_t c = 0; c < coefficients; ++c) {
    EncodedLayers some =
        encode_layers(std::vector<EncodingChoice>(m.groups.size(), *encoding), m.pages, colors,
                      [&](std::size_t g, int page) { return package.layer(g, page, c); });
    for (LayerTexture& texture : some.textures) texture.coefficient = c;
    std::move(some.textures.begin(), some.textures.end(), std::back_inserter(layers.textures));
    std::move(some.images.begin(), some.images.end(), std::back_inserter(layers.images));
    layers.colors = some.colors;
  }
  return layers;
}

ShaderSpec spec_of(const EncodedLayers& layers, const ShaderTier& tier) {
  ShaderSpec spec;
  spec.form = ShaderSpec::Form::functions;
  spec.textures = layers.textures;
  spec.groups = layers.colors.size();
  spec.pages = layers.pages();
  spec.target = &find_shader_target("glsl300es");
  spec.tier = &tier;
  return spec;
}

const char* type_name(TexelType type) {
  constexpr const char* kNames[] = {"f32", "f16", "u8", "bc6h"};
  return kNames[static_cast<std::size_t>(type)];
}

std::size_t element_bytes(const EncodedImage& image) {
  return image.encoding->type == TexelType::bc6h ? 16 : image.encoding->plane_bytes(1, 1, image.channels);
}

/// What of WebGL 2 such textures need beyond its core.
Json needs_of(const ComposedShader& shader) {
  Json needs = Json::array();
  const auto any = [&](auto test) {
    return std::any_of(shader.samplers.begin(), shader.samplers.end(), test);
  };
  if (any([](const ShaderSampler& s) { return s.linear && s.encoding.encoding->type == TexelType::f32; }))
    needs.push_back("OES_texture_float_linear");
  if (any([](const ShaderSampler& s) { return s.encoding.encoding->type == TexelType::bc6h; }))
    needs.push_back("EXT_texture_compression_bptc");
  return needs;
}

}  // namespace

Json write_tier(SiteFiles& files, const Package& package, std::size_t coefficients, const ShaderTier& tier,
                const std::optional<EncodingChoice>& encoding) {
  const std::string name(tier.name);
  const EncodedLayers layers = for_tier(layers_of(package, coefficients, encoding), tier);
  const ComposedShader shader = compose(spec_of(layers, tier));
  Json out = {{"name", name}, {"doc", tier.doc}, {"needs", needs_of(shader)}};
  out["shader"] = files.write(name + ".glsl", [&] { return shader.text; })["file"];
  for (const Rgb& color : layers.colors) out["colors"].push_back(json_of(color));
  std::size_t bytes = 0;
  for (std::size_t t = 0; t < layers.textures.size(); ++t) {
    const EncodedImage& first = layers.images[t].front();
    Json texture = {
        {"encoding", layers.textures[t].encoding.name()},          {"type", type_name(first.encoding->type)},
        {"channels", first.encoding->channels_of(first.channels)}, {"planes", first.encoding->planes},
        {"coefficient", layers.textures[t].coefficient},           {"groups", layers.textures[t].groups}};
    for (int page = 0; page < layers.pages(); ++page) {
      const EncodedImage& image = layers.images[t][static_cast<std::size_t>(page)];
      texture["pages"].push_back(
          files.write_packed(fmt::format("layer-{}-{}-{}.bin", t, page, first.encoding->name), image.data,
                             element_bytes(image)));
      bytes += texture["pages"].back()["bytes"].get<std::size_t>();
    }
    out["textures"].push_back(std::move(texture));
  }
  out["bytes"] = bytes;
  for (const ShaderSampler& sampler : shader.samplers) {
    Json slices = Json::array();
    for (const auto& slice : sampler.slices)
      slices.push_back({{"texture", slice.texture}, {"plane", slice.plane}, {"page", slice.page}});
    out["samplers"].push_back(
        {{"name", sampler.name}, {"array", sampler.array}, {"linear", sampler.linear}, {"slices", slices}});
  }
  return out;
}

Json write_meter(SiteFiles& files, const MeterPoints& points) {
  std::vector<uint16_t> halves;
  halves.reserve(3 * points.values.size());
  for (const Rgb& v : points.values)
    for (const float c : {v.r, v.g, v.b}) halves.push_back(float_to_half(std::min(c, kLargestHalf)));
  Json out = {{"points", points.weights.size()},
              {"weights", files.write_packed("meter-weights.bin", points.weights)},
              {"values", files.write_packed("meter-values.bin", halves, 3 * points.groups)}};
  out["emitters"] = Json::array();
  for (const MeterPoints::Emitter& e : points.emitters)
    out["emitters"].push_back(
        {{"group", json_of(e.group)}, {"luminance", json_of(e.luminance)}, {"weight", e.weight}});
  return out;
}

}  // namespace sconce::web
