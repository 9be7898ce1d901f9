// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstring>

#include "core/error.h"
#include "mix/tier_layers.h"
#include "runtime/handles.h"

using namespace sconce;

struct sconce_shader {
  EncodedLayers layers;  ///< as they are uploaded
  ComposedShader composed;
  std::vector<std::byte> padded{};  ///< the last image that had fewer channels than its array
};

namespace {

using Slice = ShaderSampler::Slice;

/// The image of a sampler: a slice of an array, or the page of a plain texture.
const EncodedImage& image_of(const sconce_shader& shader, const ShaderSampler& sampler, int image) {
  const Slice& slice = sampler.slices[sampler.array ? static_cast<std::size_t>(image) : 0];
  return shader.layers.images[slice.texture][static_cast<std::size_t>(sampler.array ? slice.page : image)];
}

int channels_of(const EncodedImage& image) {
  return static_cast<int>(image.encoding->channels_of(image.channels));
}

sconce_texture describe(const sconce_shader& shader, const ShaderSampler& sampler) {
  constexpr int kTexels[] = {SCONCE_TEXELS_F32, SCONCE_TEXELS_F16, SCONCE_TEXELS_U8, SCONCE_TEXELS_BC6H};
  const int images = sampler.array ? static_cast<int>(sampler.slices.size()) : shader.layers.pages();
  int channels = 0;  // textures of one array may hold fewer luminances than others
  for (int i = 0; i < images; ++i) channels = std::max(channels, channels_of(image_of(shader, sampler, i)));
  return {sampler.name.c_str(),
          kTexels[static_cast<std::size_t>(sampler.encoding.encoding->type)],
          channels,
          sampler.linear ? 1 : 0,
          sampler.array ? 1 : 0,
          images};
}

}  // namespace

sconce_shader* sconce_shader_compose(const sconce_package* package, const sconce_shader_params* params,
                                     char* message, size_t message_size) {
  sconce_shader* shader = nullptr;
  guarded(message, message_size, [&] {
    const auto name = [](const char* text, const char* otherwise) {
      return text == nullptr ? otherwise : text;
    };
    const Package& from = package->package;
    ShaderSpec spec;
    spec.form = find_shader_form(name(params->form, "picture"));
    spec.target = &find_shader_target(name(params->target, "glsl450"));
    spec.tier = &find_shader_tier(name(params->tier, "full"));
    const char* const tone = name(params->tone, "agx");
    if (std::strcmp(tone, "none") != 0) spec.tone = &find_tone_mapper(tone);
    if (params->units != 0) spec.units = params->units;
    if (spec.units < 8) throw UsageError("texture units", std::to_string(spec.units), "8 or more");
    const std::size_t wanted = params->normal_maps != 0 ? coefficients(from.manifest().basis) : 1;
    EncodedLayers layers = for_tier(read_layers(from, wanted), *spec.tier);
    spec.textures = layers.textures;
    spec.groups = layers.colors.size();
    spec.pages = layers.pages();
    shader = new sconce_shader{std::move(layers), compose(spec)};
  });
  return shader;
}

void sconce_shader_free(sconce_shader* shader) {
  delete shader;
}

const char* sconce_shader_text(const sconce_shader* shader) {
  return shader->composed.text.c_str();
}

size_t sconce_shader_texture_count(const sconce_shader* shader) {
  return shader->composed.samplers.size();
}

int sconce_shader_texture(const sconce_shader* shader, size_t index, sconce_texture* texture) {
  if (index >= shader->composed.samplers.size()) return 1;
  *texture = describe(*shader, shader->composed.samplers[index]);
  return 0;
}

const void* sconce_shader_texels(sconce_shader* shader, size_t index, int image, size_t* bytes) {
  sconce_texture texture;
  if (sconce_shader_texture(shader, index, &texture) != 0 || image < 0 || image >= texture.images)
    return nullptr;
  const ShaderSampler& sampler = shader->composed.samplers[index];
  const EncodedImage& from = image_of(*shader, sampler, image);
  const std::size_t size = from.encoding->plane_bytes(from.width, from.height, from.channels);
  const Slice& slice = sampler.slices[sampler.array ? static_cast<std::size_t>(image) : 0];
  const std::byte* plane = from.data.data() + static_cast<std::size_t>(slice.plane) * size;
  const auto have = static_cast<std::size_t>(channels_of(from)),
             want = static_cast<std::size_t>(texture.channels);
  if (bytes != nullptr) *bytes = size / have * want;
  if (have == want) return plane;
  const std::size_t texels = static_cast<std::size_t>(from.width) * static_cast<std::size_t>(from.height),
                    texel = size / texels, wide = texel / have * want;
  shader->padded.assign(texels * wide, std::byte{0});
  for (std::size_t i = 0; i < texels; ++i) std::memcpy(&shader->padded[i * wide], plane + i * texel, texel);
  return shader->padded.data();
}

void sconce_shader_weights(const sconce_shader* shader, const float* weights, float* uniform) {
  for (const Rgb& color : shader->layers.colors)
    for (const float c : {color.r, color.g, color.b}) *uniform++ = *weights++ * c;
}
