// SPDX-License-Identifier: Apache-2.0
#include "detect/texture_space.h"

#include <numeric>

#include "core/error.h"

namespace sconce {

namespace {

constexpr int kMostPixels = 16384;  // a side of a target
constexpr float kInset = 0.25f;     // from a cell's corner: middles of pixels are clearly on the face, or not

std::array<Vec2, 3> cell_corners(int x, int y, int texels) {
  const Vec2 corner(static_cast<float>(x) + kInset, static_cast<float>(y) + kInset);
  const auto leg = static_cast<float>(texels);
  return {corner, corner + Vec2(leg, 0), corner + Vec2(0, leg)};
}

/// @throws Error
void check_size(const TextureSpace& space) {
  if (std::max(space.width, space.height) > kMostPixels)
    throw Error({}, std::to_string(space.triangles.size()) + " faces do not fit into one target",
                "up to " + std::to_string(kMostPixels) + " pixels a side: fewer faces, or fewer texels each");
}

void mark_covered(TextureSpace& space) {
  space.covered.assign(static_cast<std::size_t>(space.width) * static_cast<std::size_t>(space.height), 0);
  for (std::size_t i = 0; i < space.triangles.size(); ++i)
    each_pixel(space, i, [&](std::size_t pixel) { space.covered[pixel] = 1; });
}

}  // namespace

TextureSpace face_cells(std::span<const uint32_t> triangles, std::span<const int> texels) {
  TextureSpace space;
  space.triangles.assign(triangles.begin(), triangles.end());
  space.corners.resize(triangles.size());
  double area = 0;
  int widest = 1;
  for (const int n : texels) {
    area += static_cast<double>(n + 1) * (n + 1);
    widest = std::max(widest, n + 1);
  }
  space.width = std::max(widest, static_cast<int>(std::ceil(std::sqrt(area))));
  // Rows of cells, largest first, so that cells of a row are nearly as high as each other.
  std::vector<uint32_t> order(triangles.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return texels[a] > texels[b]; });
  int x = 0, y = 0, row = 0;
  for (const uint32_t i : order) {
    const int side = texels[i] + 1;
    if (x + side > space.width) x = 0, y += row, row = 0;
    row = std::max(row, side);
    space.corners[i] = cell_corners(x, y, texels[i]);
    x += side;
  }
  space.height = std::max(1, y + row);
  check_size(space);
  mark_covered(space);
  return space;
}

TextureSpace spread_cells(std::span<const uint32_t> triangles, int texels, int side, std::size_t first,
                          float shift) {
  TextureSpace space;
  space.triangles.assign(triangles.begin(), triangles.end());
  const std::size_t n = triangles.size();
  const int columns = std::max(1, static_cast<int>(std::ceil(std::sqrt(static_cast<double>(n)))));
  const int pitch = std::max(texels + 1, side / columns);
  space.width = space.height = columns * pitch;
  const int room = static_cast<int>(shift * static_cast<float>(pitch - texels - 1));
  for (std::size_t i = 0; i < n; ++i) {
    const auto cell = static_cast<int>((i + first) % n);
    space.corners.push_back(
        cell_corners(cell % columns * pitch + room, cell / columns * pitch + room, texels));
  }
  check_size(space);
  mark_covered(space);
  return space;
}

std::vector<int> texels_by_area(const World& world, std::span<const uint32_t> triangles, float size,
                                int most) {
  std::vector<int> texels;
  for (const uint32_t t : triangles)
    texels.push_back(static_cast<int>(
        std::clamp(std::sqrt(2 * world.area(t)) / size + 0.5f, 1.0f, static_cast<float>(most))));
  return texels;
}

TextureSpace atlas_space(const Atlas& atlas) {
  TextureSpace space;
  space.width = atlas.width;
  space.height = atlas.height * atlas.pages;
  for (uint32_t t = 0; t < atlas.front.size(); ++t) {
    const TexelTriangle& side = atlas.front[t];
    if (side.page < 0) continue;
    space.triangles.push_back(t);
    space.corners.push_back(side.uv);
    for (Vec2& corner : space.corners.back()) corner.y += static_cast<float>(side.page * atlas.height);
  }
  mark_covered(space);
  return space;
}

TextureSpace mirrored(TextureSpace space) {
  for (std::array<Vec2, 3>& corners : space.corners)
    for (Vec2& corner : corners) corner.x = static_cast<float>(space.width) - corner.x;
  mark_covered(space);
  return space;
}

std::optional<PixelBlend> blend_at(const TextureSpace& space, Vec2 at) {
  PixelBlend blend;
  const auto covered = [&](int x, int y) {
    return x >= 0 && y >= 0 && x < space.width && y < space.height &&
           space.covered[static_cast<std::size_t>(y) * static_cast<std::size_t>(space.width) +
                         static_cast<std::size_t>(x)] != 0;
  };
  const auto index = [&](int x, int y) { return static_cast<uint32_t>(y * space.width + x); };
  const Vec2 p = at - Vec2(0.5f);
  const int x0 = static_cast<int>(std::floor(p.x)), y0 = static_cast<int>(std::floor(p.y));
  float sum = 0;
  for (int k = 0; k < 4; ++k) {
    const int x = x0 + k % 2, y = y0 + k / 2;
    if (!covered(x, y)) continue;
    const float weight =
        (1 - std::abs(p.x - static_cast<float>(x))) * (1 - std::abs(p.y - static_cast<float>(y)));
    blend.pixels[static_cast<std::size_t>(k)] = index(x, y);
    sum += blend.weights[static_cast<std::size_t>(k)] = weight;
  }
  if (sum > 0) {
    for (float& weight : blend.weights) weight /= sum;
    return blend;
  }
  // Slivers that no pixel's middle lies on: their neighbours in the chart.
  constexpr int kReach = 3;
  float nearest = 1e30f;
  for (int y = y0 - kReach; y <= y0 + 1 + kReach; ++y)
    for (int x = x0 - kReach; x <= x0 + 1 + kReach; ++x) {
      const Vec2 d = p - Vec2(static_cast<float>(x), static_cast<float>(y));
      if (!covered(x, y) || !(glm::dot(d, d) < nearest)) continue;
      nearest = glm::dot(d, d);
      blend.pixels[0] = index(x, y);
    }
  if (nearest == 1e30f) return std::nullopt;
  blend.weights = {1, 0, 0, 0};
  return blend;
}

}  // namespace sconce
