// SPDX-License-Identifier: Apache-2.0
#include "gpu/layer_pass.h"

#include <algorithm>
#include <numeric>

#include "core/error.h"

namespace sconce::gpu {

namespace {

constexpr std::size_t kMostWeights = 256;  // vec3; OpenGL guarantees 1024 floats of uniforms

/// The part of the layers as the composer wants it, groups numbered from 0.
ShaderSpec spec_of(const Context& context, const EncodedLayers& layers, const ShaderTier& tier,
                   ShaderSpec::Form form, const std::vector<std::size_t>& which) {
  ShaderSpec spec;
  spec.form = form;
  spec.units = context.capabilities().max_units;
  spec.pages = layers.pages();
  spec.target = &find_shader_target("glsl450");
  spec.tier = &tier;
  for (const std::size_t t : which) {
    spec.textures.push_back(layers.textures[t]);
    for (std::size_t& g : spec.textures.back().groups) g = spec.groups++;
  }
  return spec;
}

/// Within the device's limits?
bool fits(const Context& context, const ShaderSpec& spec) {
  if (spec.groups > kMostWeights) return false;
  const std::vector<ShaderSampler> samplers = compose(spec).samplers;
  return samplers.size() + kReservedUnits <= static_cast<std::size_t>(spec.units) &&
         std::all_of(samplers.begin(), samplers.end(), [&](const ShaderSampler& s) {
           return s.slices.size() <= static_cast<std::size_t>(context.capabilities().max_array_layers);
         });
}

struct Format {
  GLenum internal, external, type;
};
Format format_of(TexelType type, int channels) {
  const auto c = static_cast<std::size_t>(channels - 1);
  constexpr GLenum kExternal[] = {GL_RED, GL_RG, GL_RGB, GL_RGBA};
  constexpr GLenum kFloat[] = {GL_R32F, GL_RG32F, GL_RGB32F, GL_RGBA32F};
  constexpr GLenum kHalf[] = {GL_R16F, GL_RG16F, GL_RGB16F, GL_RGBA16F};
  constexpr GLenum kByte[] = {GL_R8, GL_RG8, GL_RGB8, GL_RGBA8};
  switch (type) {
    case TexelType::f32:
      return {kFloat[c], kExternal[c], GL_FLOAT};
    case TexelType::f16:
      return {kHalf[c], kExternal[c], GL_HALF_FLOAT};
    case TexelType::u8:
      return {kByte[c], kExternal[c], GL_UNSIGNED_BYTE};
    case TexelType::bc6h:
      break;
  }
  return {GL_COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT, GL_NONE, GL_NONE};
}

int channels_of(const EncodedImage& image) {
  return static_cast<int>(image.encoding->channels_of(image.channels));
}

void upload_plane(const Texture& to, const EncodedImage& image, int plane, int layer) {
  const std::size_t bytes = image.encoding->plane_bytes(image.width, image.height, image.channels);
  const std::byte* from = image.data.data() + static_cast<std::size_t>(plane) * bytes;
  const Format format = format_of(image.encoding->type, channels_of(image));
  if (format.type == GL_NONE)
    to.upload_blocks(from, bytes, layer);
  else
    to.upload(format.external, format.type, from, layer);
}

}  // namespace

LayerPass::LayerPass(const Context& context, const EncodedLayers& layers, const ShaderTier& tier,
                     ShaderSpec::Form form, const std::vector<std::size_t>& which)
    : shader_(compose(spec_of(context, layers, tier, form, which))),
      coefficient_(layers.textures[which.front()].coefficient) {
  for (const std::size_t t : which)
    for (const std::size_t g : layers.textures[t].groups) {
      groups_.push_back(g);
      colors_.push_back(layers.colors[g]);
    }
  upload(context, layers, which);
}

void LayerPass::upload(const Context& context, const EncodedLayers& layers,
                       const std::vector<std::size_t>& which) {
  for (const ShaderSampler& sampler : shader_.samplers) {
    const auto image = [&](const ShaderSampler::Slice& slice, int page) -> const EncodedImage& {
      return layers.images[which[slice.texture]][static_cast<std::size_t>(page)];
    };
    int channels = 0;  // textures of one array may hold fewer luminances than others
    for (const ShaderSampler::Slice& slice : sampler.slices)
      channels = std::max(channels, channels_of(image(slice, 0)));
    TextureParams params;
    params.format = format_of(sampler.encoding.encoding->type, channels).internal;
    params.width = layers.width();
    params.height = layers.height();
    params.layers = sampler.array ? static_cast<int>(sampler.slices.size()) : 0;
    params.filter = sampler.linear ? GL_LINEAR : GL_NEAREST;
    std::vector<Texture>& textures = textures_.emplace_back();
    if (sampler.array) {
      textures.emplace_back(context, params, "layers");
      for (std::size_t i = 0; i < sampler.slices.size(); ++i)
        upload_plane(textures.back(), image(sampler.slices[i], sampler.slices[i].page),
                     sampler.slices[i].plane, static_cast<int>(i));
      continue;
    }
    const ShaderSampler::Slice& only = sampler.slices.front();
    for (int page = 0; page < layers.pages(); ++page) {
      textures.emplace_back(context, params, "layers");
      upload_plane(textures.back(), image(only, page), only.plane, 0);
    }
  }
  context.check("uploading layers");
}

void LayerPass::bind(const Program& program, int first_unit, const std::vector<Rgb>& weights,
                     int page) const {
  for (std::size_t s = 0; s < textures_.size(); ++s) {
    const int unit = first_unit + static_cast<int>(s);
    const std::vector<Texture>& textures = textures_[s];
    textures[textures.size() == 1 ? 0 : static_cast<std::size_t>(page)].bind(unit);
    program.set(shader_.samplers[s].name.c_str(), unit);
  }
  std::vector<Rgb> own;
  for (std::size_t i = 0; i < groups_.size(); ++i) own.push_back(weights.at(groups_[i]) * colors_[i]);
  program.set("sconce_weight", own);
}

std::vector<std::vector<std::size_t>> split_layers(const Context& context, const EncodedLayers& layers,
                                                   const ShaderTier& tier, ShaderSpec::Form form) {
  std::vector<std::vector<std::size_t>> parts;
  std::vector<std::size_t> part;
  for (std::size_t t = 0; t < layers.textures.size(); ++t) {
    const bool apart = form != ShaderSpec::Form::functions && !part.empty() &&
                       layers.textures[part.back()].coefficient != layers.textures[t].coefficient;
    part.push_back(t);
    if (!apart && fits(context, spec_of(context, layers, tier, form, part))) continue;
    part.pop_back();
    if (part.empty())
      throw Error("OpenGL",
                  "a lightmap of " + std::to_string(layers.pages()) + " pages does not fit this device");
    parts.push_back(part);
    part = {t};
  }
  parts.push_back(part);
  return parts;
}

std::vector<LayerPass> make_passes(const Context& context, const EncodedLayers& layers,
                                   const ShaderTier& tier, ShaderSpec::Form form) {
  std::vector<LayerPass> passes;
  for (const std::vector<std::size_t>& part : split_layers(context, layers, tier, form))
    passes.emplace_back(context, layers, tier, form, part);
  return passes;
}

}  // namespace sconce::gpu
