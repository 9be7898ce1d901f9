// SPDX-License-Identifier: Apache-2.0
#include "textures.h"

#include <array>
#include <cstdlib>

#include "core/hash.h"
#include "core/rgb.h"
#include "core/vec.h"

namespace sconce::demo {
namespace {

Rgb hex(const char* text) {
  const auto v = std::strtoul(text, nullptr, 16);
  return Rgb(static_cast<float>(v >> 16 & 255), static_cast<float>(v >> 8 & 255),
             static_cast<float>(v & 255)) /
         255.0f;
}

Rgb mix(const Rgb& a, const Rgb& b, float t) {
  return a * (1 - t) + b * t;
}

float random(uint32_t a, uint32_t b, uint32_t c) {
  return static_cast<float>(mix32(a, mix32(b, c)) >> 8) / static_cast<float>(1 << 24);
}

/// Value noise in [0, 1] that repeats after `px` x `py` cells.
float noise(float x, float y, int px, int py, uint32_t seed) {
  const float fx = std::floor(x), fy = std::floor(y);
  const auto wrap = [](float v, int period) { return ((static_cast<int>(v) % period) + period) % period; };
  const auto value = [&](float i, float j) {
    return random(static_cast<uint32_t>(wrap(i, px)), static_cast<uint32_t>(wrap(j, py)), seed);
  };
  const auto ease = [](float t) { return t * t * (3 - 2 * t); };
  const float tx = ease(x - fx), ty = ease(y - fy);
  const float low = value(fx, fy) * (1 - tx) + value(fx + 1, fy) * tx;
  const float high = value(fx, fy + 1) * (1 - tx) + value(fx + 1, fy + 1) * tx;
  return low * (1 - ty) + high * ty;
}

/// Fills an image from a function of texel-centre coordinates in [0, 1).
template <class F>
Image8 paint(int width, int height, F color) {
  Image8 out{width, height, 3, {}};
  out.data.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Rgb c = color((static_cast<float>(x) + 0.5f) / static_cast<float>(width),
                          (static_cast<float>(y) + 0.5f) / static_cast<float>(height));
      for (const float v : {c.r, c.g, c.b})
        out.data.push_back(static_cast<unsigned char>(std::clamp(v, 0.0f, 1.0f) * 255 + 0.5f));
    }
  return out;
}

/// Share of a joint of the given width at distance `d` (metres) from its centre line, over one texel.
float joint(float d, float width, float texel) {
  return std::clamp((0.5f * width - d) / texel + 0.5f, 0.0f, 1.0f);
}

/// Distance to the nearest multiple of `period`.
float to_line(float x, float period) {
  return std::abs(x - period * std::floor(x / period + 0.5f));
}

struct Tiles {
  float width, height;  ///< metres
  int columns, rows;
  const char *color, *joint_color;
  float joint_width, contrast;
};

Image8 tiles(const Tiles& t, int size, uint32_t seed) {
  const float w = t.width * static_cast<float>(t.columns), h = t.height * static_cast<float>(t.rows);
  const Rgb body = hex(t.color), grout = hex(t.joint_color);
  return paint(size, size, [&](float u, float v) {
    const float x = u * w, y = v * h;
    const auto column = static_cast<uint32_t>(x / t.width), row = static_cast<uint32_t>(y / t.height);
    const float shade = 1 + t.contrast * (random(column, row, seed) - 0.5f);
    const float hue = 0.5f * t.contrast * (random(column, row, seed + 1) - 0.5f);
    const Rgb c = body * shade * Rgb(1 - hue, 1, 1 + hue);
    const float across = joint(to_line(x, t.width), t.joint_width, w / static_cast<float>(size));
    const float along = joint(to_line(y, t.height), t.joint_width, h / static_cast<float>(size));
    return mix(c, grout, std::max(across, along));
  });
}

}  // namespace

Image8 terrazzo() {
  constexpr int kSize = 1024;
  constexpr float kMetres = 1.2f, kTexel = kMetres / kSize;
  constexpr std::array kChips{"c98a6c", "9dab9b", "d8bf8f", "8d8882", "f4f0e7", "c3b7a6", "e9e0d4", "b5a391"};
  const Rgb cement = hex("dfd8cc");
  std::vector<Rgb> texels(static_cast<std::size_t>(kSize) * kSize, cement);
  for (uint32_t chip = 0; chip < 3600; ++chip) {
    const auto roll = [&](uint32_t k) { return random(chip, k, 77); };
    const float size = 2.5f + 11.0f * roll(0) * roll(1) * roll(1);  // texels
    const Vec2 at(roll(2) * kSize, roll(3) * kSize);
    const int sides = 5 + static_cast<int>(roll(4) * 3);
    const Rgb color =
        hex(kChips[static_cast<std::size_t>(roll(5) * roll(6) * 1.3f * kChips.size()) % kChips.size()]);
    const int reach = static_cast<int>(size * 1.6f) + 2;
    for (int dy = -reach; dy <= reach; ++dy)
      for (int dx = -reach; dx <= reach; ++dx) {
        float outside = -1e9f;  // signed distance to a polygon of half planes
        for (int s = 0; s < sides; ++s) {
          const auto k = static_cast<uint32_t>(s);
          const float angle =
              2 * kPi * (static_cast<float>(s) + 0.7f * roll(10 + k)) / static_cast<float>(sides);
          const float distance =
              static_cast<float>(dx) * std::cos(angle) + static_cast<float>(dy) * std::sin(angle);
          outside = std::max(outside, distance - size * (0.7f + 0.6f * roll(20 + k)));
        }
        const float cover = std::clamp(0.5f - outside, 0.0f, 1.0f);
        if (cover <= 0) continue;
        const int x = (static_cast<int>(at.x) + dx + 2 * kSize) % kSize,
                  y = (static_cast<int>(at.y) + dy + 2 * kSize) % kSize;
        Rgb& texel = texels[static_cast<std::size_t>(y) * kSize + static_cast<std::size_t>(x)];
        texel = mix(texel, color, cover);
      }
  }
  const Rgb grout = hex("b7aea0");
  return paint(kSize, kSize, [&](float u, float v) {
    const float line = std::min(to_line(u * kMetres, 0.6f), to_line(v * kMetres, 0.6f));
    const std::size_t index =
        static_cast<std::size_t>(v * kSize) * kSize + static_cast<std::size_t>(u * kSize);
    return mix(texels[index], grout, joint(line, 0.003f, kTexel));
  });
}

Image8 wall_tiles() {
  return tiles({0.075f, 0.2f, 8, 4, "84a08c", "d3d4c8", 0.003f, 0.14f}, 768, 11);
}

Image8 floor_mosaic() {
  return tiles({0.15f, 0.15f, 4, 4, "8f9a90", "c9c8bd", 0.003f, 0.10f}, 512, 12);
}

Image8 oak() {
  const Rgb light = hex("c89f6e"), dark = hex("9d7444");
  return paint(512, 512, [&](float u, float v) {
    const float wander = 0.9f * noise(u * 4, v * 3, 4, 3, 1);
    const float rings = 0.5f + 0.5f * std::sin(2 * kPi * (11 * u + wander));
    const float fibre = noise(u * 128, v * 6, 128, 6, 2), pores = noise(u * 256, v * 20, 256, 20, 3);
    const float t = 0.45f * rings * (0.4f + 0.6f * noise(u * 6, v * 2, 6, 2, 4)) + 0.35f * fibre;
    return mix(light, dark, std::clamp(t + (pores > 0.86f ? 0.3f : 0.0f), 0.0f, 1.0f));
  });
}

Image8 rug() {
  const Rgb wool = hex("ebe2d2"), clay = hex("b9623f"), ink = hex("3f4a4c");
  return paint(768, 480, [&](float u, float v) {
    const float from_end = std::min(u, 1 - u);
    Rgb c = wool;
    if (from_end > 0.07f && from_end < 0.12f) c = clay;
    if (from_end > 0.145f && from_end < 0.155f) c = ink;
    const float zigzag = 0.215f + 0.02f * (to_line(v, 0.1f) / 0.05f);
    if (std::abs(from_end - zigzag) < 0.006f) c = clay;
    if (from_end > 0.275f && from_end < 0.285f) c = ink;
    const float weave = 0.5f + 0.5f * std::sin(2 * kPi * 120 * v) * std::sin(2 * kPi * 192 * u);
    return c * (0.86f + 0.14f * weave) * (0.95f + 0.05f * noise(u * 96, v * 60, 96, 60, 21));
  });
}

Image8 terry(const char* srgb_body, const char* srgb_stripe) {
  const Rgb body = hex(srgb_body), stripe = hex(srgb_stripe);
  return paint(256, 512, [&](float u, float v) {
    const float from_end = std::min(v, 1 - v);
    const bool banded = (from_end > 0.075f && from_end < 0.085f) ||
                        (from_end > 0.095f && from_end < 0.125f) || (from_end > 0.135f && from_end < 0.145f);
    const float loops = noise(u * 128, v * 256, 128, 256, 31);
    return (banded ? stripe : body) * (0.88f + 0.24f * loops * (banded ? 0.5f : 1.0f));
  });
}

Image8 mirror_sheen() {
  const Rgb low = hex("8d999d"), high = hex("c3cdd0");
  return paint(96, 144, [&](float u, float v) {
    const float d = u + 1.1f * (1 - v);
    const auto band = [&](float centre, float width) {
      return std::exp(-(d - centre) * (d - centre) / (width * width));
    };
    return mix(
        low, high,
        std::clamp(0.75f * band(0.72f, 0.16f) + 0.5f * band(1.22f, 0.09f) + 0.12f * (1 - v), 0.0f, 1.0f));
  });
}

}  // namespace sconce::demo
