// SPDX-License-Identifier: Apache-2.0
// Textures and materials at a point.
#include <array>

#include "scene/world.h"

namespace sconce {

namespace {

/// 8-bit sRGB and linear codes as linear floats.
struct DecodeTables {
  std::array<float, 256> srgb, linear;
  DecodeTables() {
    for (int i = 0; i < 256; ++i) {
      linear[static_cast<std::size_t>(i)] = static_cast<float>(i) / 255.0f;
      srgb[static_cast<std::size_t>(i)] = srgb_to_linear(static_cast<float>(i) / 255.0f);
    }
  }
};
const DecodeTables& tables() {
  static const DecodeTables decode;
  return decode;
}

int wrap(int i, int size, Texture::Wrap mode) {
  if (static_cast<unsigned>(i) < static_cast<unsigned>(size)) return i;
  switch (mode) {
    case Texture::Wrap::clamp:
      return std::clamp(i, 0, size - 1);
    case Texture::Wrap::mirror: {
      int j = i % (2 * size);
      if (j < 0) j += 2 * size;
      return j < size ? j : 2 * size - 1 - j;
    }
    case Texture::Wrap::repeat:
      break;
  }
  const int j = i % size;
  return j < 0 ? j + size : j;
}

/// Decodes one stored texel.
Texel decode(const unsigned char* p, int channels, const std::array<float, 256>& lut,
             const std::array<float, 256>& linear) {
  if (channels < 3) return {Rgb(lut[p[0]]), channels == 2 ? linear[p[1]] : 1.0f};
  return {Rgb(lut[p[0]], lut[p[1]], lut[p[2]]), channels == 4 ? linear[p[3]] : 1.0f};
}

}  // namespace

Vec2 TextureUse::transform(Vec2 uv) const {
  const Vec2 s = scale * uv;
  if (rotation == 0.0f) return offset + s;
  // KHR_texture_transform: a positive angle turns the coordinates, hence the image, counter-clockwise with v
  // down.
  const float c = std::cos(rotation), n = std::sin(rotation);
  return offset + Vec2(c * s.x + n * s.y, -n * s.x + c * s.y);
}

Texel sample_texture(const Scene& scene, const TextureUse& use, Vec2 uv, bool srgb) {
  if (!use.texture.valid()) return {};
  const Texture& texture = scene[use.texture];
  if (texture.pixels.data.empty()) return {};
  const Vec2 st = use.transform(uv);
  if (!std::isfinite(st.x) || !std::isfinite(st.y)) return {};
  // Fold into one (mirrored: two) periods first, so that any coordinate stays within int.
  const auto fold = [](float t, Texture::Wrap mode) {
    if (mode == Texture::Wrap::clamp) return std::clamp(t, -1.0f, 2.0f);
    return mode == Texture::Wrap::repeat ? t - std::floor(t) : t - 2 * std::floor(0.5f * t);
  };
  const float x = fold(st.x, texture.wrap_u) * static_cast<float>(texture.pixels.width);
  const float y = fold(st.y, texture.wrap_v) * static_cast<float>(texture.pixels.height);
  const Image8& image = texture.pixels;
  const DecodeTables& table = tables();
  const auto& lut = srgb ? table.srgb : table.linear;
  const auto row = [&](int j) {
    return &image.data[static_cast<std::size_t>(wrap(j, image.height, texture.wrap_v)) *
                       static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.channels)];
  };
  const auto column = [&](int i) {
    return static_cast<std::size_t>(wrap(i, image.width, texture.wrap_u)) *
           static_cast<std::size_t>(image.channels);
  };
  if (texture.nearest)
    return decode(row(static_cast<int>(std::floor(y))) + column(static_cast<int>(std::floor(x))),
                  image.channels, lut, table.linear);
  const float fx = std::floor(x - 0.5f), fy = std::floor(y - 0.5f);
  const float wx = x - 0.5f - fx, wy = y - 0.5f - fy;
  const int ix = static_cast<int>(fx), iy = static_cast<int>(fy);
  const unsigned char *top = row(iy), *bottom = row(iy + 1);
  const std::size_t left = column(ix), right = column(ix + 1);
  const auto fetch = [&](const unsigned char* p) { return decode(p, image.channels, lut, table.linear); };
  const Texel a = fetch(top + left), b = fetch(top + right), c = fetch(bottom + left),
              d = fetch(bottom + right);
  const float wa = (1 - wx) * (1 - wy), wb = wx * (1 - wy), wc = (1 - wx) * wy, wd = wx * wy;
  return {wa * a.rgb + wb * b.rgb + wc * c.rgb + wd * d.rgb,
          wa * a.alpha + wb * b.alpha + wc * c.alpha + wd * d.alpha};
}

Shade shade(const Scene& scene, const World& world, std::size_t triangle, Vec2 barycentric) {
  const Material& material = scene[world.materials[triangle]];
  Shade result;
  result.base_color = material.base_color;
  result.alpha = material.alpha;
  result.metallic = material.metallic;
  result.roughness = material.roughness;
  result.transmission = material.transmission;
  result.emission = material.emission;
  const auto look_up = [&](const TextureUse& use, bool srgb) {
    return sample_texture(scene, use, world.texcoord(triangle, barycentric, use.texcoord), srgb);
  };
  if (material.base_color_texture.texture.valid()) {
    const Texel texel = look_up(material.base_color_texture, true);
    result.base_color *= texel.rgb;
    result.alpha *= texel.alpha;
  }
  if (material.metallic_roughness_texture.texture.valid()) {
    const Texel texel = look_up(material.metallic_roughness_texture, false);
    result.metallic *= texel.rgb.b;
    result.roughness *= texel.rgb.g;
  }
  if (material.transmission_texture.texture.valid())
    result.transmission *= look_up(material.transmission_texture, false).rgb.r;
  if (material.emits() && material.emission_texture.texture.valid())
    result.emission *= look_up(material.emission_texture, true).rgb;
  return result;
}

Passing passing(const Material& material, const Shade& surface) {
  return {material.alpha_mode == Material::Alpha::blend ? 1 - surface.alpha : 0.0f,
          surface.transmission * (1 - surface.metallic), surface.base_color};
}

}  // namespace sconce
