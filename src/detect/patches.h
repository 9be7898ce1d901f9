// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "detect/capture.h"

namespace sconce {

/// What detection looks at as one: faces as wholes, or each texel of theirs.
class Patches {
 public:
  Patches(const TextureSpace& space, bool texels) {
    for (uint32_t face = 0; face < space.triangles.size(); ++face) {
      const auto close = [&] {
        faces_.push_back(face), first_.push_back(static_cast<uint32_t>(pixels_.size()));
      };
      const std::size_t before = pixels_.size();
      each_pixel(space, face, [&](std::size_t pixel) {
        pixels_.push_back(static_cast<uint32_t>(pixel));
        if (texels) close();
      });
      if (!texels || pixels_.size() == before) close();
    }
  }

  std::size_t size() const { return faces_.size(); }
  /// Of a patch: its face's index in the space. Patches of a face follow each other.
  uint32_t face(std::size_t patch) const { return faces_[patch]; }
  std::span<const uint32_t> pixels(std::size_t patch) const {
    return std::span(pixels_).subspan(first_[patch], first_[patch + 1] - first_[patch]);
  }
  /// Mean light. @param clipped  set where a channel of any pixel is
  Rgb mean(std::size_t patch, const Captured& captured, bool& clipped) const {
    std::array<double, 3> sum{};
    for (const uint32_t pixel : pixels(patch)) {
      const Rgb& light = captured.light[pixel];
      sum[0] += static_cast<double>(light.r), sum[1] += static_cast<double>(light.g);
      sum[2] += static_cast<double>(light.b);
      clipped = clipped || captured.is_clipped(pixel);
    }
    const double scale = 1 / std::max(static_cast<double>(pixels(patch).size()), 1.0);
    return Rgb(static_cast<float>(sum[0] * scale), static_cast<float>(sum[1] * scale),
               static_cast<float>(sum[2] * scale));
  }

 private:
  std::vector<uint32_t> faces_, pixels_, first_{0};
};

}  // namespace sconce
