// SPDX-License-Identifier: Apache-2.0
// Where faces lie in a target that a foreign renderer draws to.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "receive/atlas.h"

namespace sconce {

struct TextureSpace {
  int width = 0, height = 0;                 ///< pixels
  std::vector<uint32_t> triangles;           ///< of the World
  std::vector<std::array<Vec2, 3>> corners;  ///< per triangle, pixels; counter-clockwise where rows go up
  std::vector<uint8_t> covered;              ///< per pixel: 1 where its middle lies on a face

  std::size_t pixels() const { return covered.size(); }
};

/// A cell of its own for each face: half a square of `texels` x `texels`, n (n + 1) / 2 whole pixels.
/// @param texels  per triangle, at least 1: large faces get more and are so split
/// @throws Error where they do not fit into 16384 x 16384 pixels
TextureSpace face_cells(std::span<const uint32_t> triangles, std::span<const int> texels);

/// Cells of `texels` x `texels`, spread over a target of at least `side` x `side` pixels: face i lies in cell
/// i + `first` of a grid of as many as there are faces, `shift`, 0 to 1, of the way through the room that it
/// has there.
TextureSpace spread_cells(std::span<const uint32_t> triangles, int texels, int side, std::size_t first,
                          float shift);

/// Texels per face so that those are `size` m wide, 1 to `most`.
std::vector<int> texels_by_area(const World& world, std::span<const uint32_t> triangles, float size,
                                int most);

/// The faces where a lightmap has them, pages one above the other. Fronts only.
TextureSpace atlas_space(const Atlas& atlas);

/// The same faces as seen from behind: their corners go round the other way.
TextureSpace mirrored(TextureSpace space);

inline Vec2 pixel_middle(const TextureSpace& space, std::size_t pixel) {
  const auto width = static_cast<std::size_t>(space.width);
  return {static_cast<float>(pixel % width) + 0.5f, static_cast<float>(pixel / width) + 0.5f};
}

/// Calls f(pixel) for the pixels whose middle lies on a face.
template <class F>
void each_pixel(const TextureSpace& space, std::size_t face, F&& f) {
  const auto& [a, b, c] = space.corners[face];
  const Vec2 lo = glm::min(a, glm::min(b, c)), hi = glm::max(a, glm::max(b, c));
  const auto cross = [](Vec2 u, Vec2 v) { return u.x * v.y - u.y * v.x; };
  const float area = cross(b - a, c - a);
  if (area == 0) return;
  const auto clamp_to = [](float v, int size) { return std::clamp(static_cast<int>(v), 0, size); };
  const int x1 = clamp_to(std::ceil(hi.x), space.width), y1 = clamp_to(std::ceil(hi.y), space.height);
  for (int y = clamp_to(lo.y, space.height); y < y1; ++y)
    for (int x = clamp_to(lo.x, space.width); x < x1; ++x) {
      const Vec2 p(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
      const float wb = cross(p - a, c - a) / area, wc = cross(b - a, p - a) / area;
      if (wb >= 0 && wc >= 0 && wb + wc <= 1)
        f(static_cast<std::size_t>(y) * static_cast<std::size_t>(space.width) + static_cast<std::size_t>(x));
    }
}

/// Pixels that speak for a point of a face, with weights whose sum is 1: bilinear between those that faces
/// cover, or the nearest one.
struct PixelBlend {
  std::array<uint32_t, 4> pixels{};
  std::array<float, 4> weights{};
};
/// @param at  pixels
/// @return nothing where no face covers any pixel near
std::optional<PixelBlend> blend_at(const TextureSpace& space, Vec2 at);

}  // namespace sconce
