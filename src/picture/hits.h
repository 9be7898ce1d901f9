// SPDX-License-Identifier: Apache-2.0
// Camera hits, kept: all that a picture needs beside the mixed lightmap and the weights. Made by
// View::hits(), drawn by picture/show.h as often as faders move.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/id.h"
#include "scene/scene.h"

namespace sconce {

struct CameraHits {
  /// Sixteen bytes, read in one go. Where there is no light, albedo is 0 at some texel that exists.
  struct Pixel {
    uint32_t texel = 0;                ///< of its page: the one of four with the lowest x and y
    std::array<uint16_t, 2> place{};   ///< between the four, x and y, of kWhole
    std::array<uint16_t, 3> albedo{};  ///< rho / pi as halves
    uint16_t page = 0;
  };
  static constexpr uint16_t kWhole = 65535;

  /// What shines by itself; few pixels do, but a sky may be large.
  struct Shine {
    uint32_t x = 0;
    Id<LightGroup> group;  ///< none: weight 1
    Rgb radiance;          ///< cd/m2 at weight 1
  };

  int width = 0, height = 0;
  int pages = 0, page_width = 0, page_height = 0;
  std::size_t groups = 0;
  std::vector<Pixel> pixels;
  std::vector<Shine> shines;         ///< row by row, by x
  std::vector<std::size_t> row_end;  ///< per row: its end in `shines`

  std::span<const Pixel> row(int y) const {
    const auto count = static_cast<std::size_t>(width);
    return {&pixels[static_cast<std::size_t>(y) * count], count};
  }
  /// Calls f(shine) for the row's shines.
  template <class F>
  void for_each_shine(int y, const F& f) const {
    const auto row_index = static_cast<std::size_t>(y);
    for (std::size_t i = y == 0 ? 0 : row_end[row_index - 1]; i < row_end[row_index]; ++i) f(shines[i]);
  }
  std::size_t bytes() const { return pixels.size() * sizeof(Pixel) + shines.size() * sizeof(Shine); }
};

}  // namespace sconce
