// SPDX-License-Identifier: Apache-2.0
// What the example programs print and write, whoever draws.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/rgb.h"
#include "detect/realtime.h"
#include "image/io.h"
#include "room.h"

namespace room {

inline void print(const sconce::Detection& found) {
  for (std::size_t m = 0; m < found.materials.size(); ++m) {
    const sconce::SurfaceResponse& r = found.materials[m].response;
    fmt::print("material {}: reflectance {:.4f} {:.4f} {:.4f}, emission {:.3f} {:.3f} {:.3f}\n", m,
               r.reflectance.r, r.reflectance.g, r.reflectance.b, r.emission.r, r.emission.g, r.emission.b);
  }
  for (const std::string& finding : found.findings) fmt::print("{}\n", finding);
  fmt::print("detected in {} drawings, {:.0f} ms\n", found.cost.draws, found.cost.milliseconds);
}

inline void print(const sconce::FrameReport& frame) {
  if (!frame) fmt::print("without global illumination: {}\n", frame.fault);
  fmt::print("frame: {:.1f} ms in the renderer, {:.2f} of them to read back, {:.1f} ms to solve\n",
             frame.capture.milliseconds, frame.capture.read_milliseconds, frame.solve_milliseconds);
}

/// FILE.exr as it is, and FILE.png in sRGB.
/// @param rgba  kWidth x kHeight pixels of the renderer's
/// @param up    its rows go up
/// @param unit  what the renderer shows of 1
inline void write(const std::string& file, const float* rgba, bool up, float unit = 1) {
  sconce::Image linear = sconce::Image::rgb(kWidth, kHeight);
  sconce::Image8 codes;
  codes.width = kWidth, codes.height = kHeight, codes.channels = 3;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const float* v = rgba + 4 * ((up ? kHeight - 1 - y : y) * kWidth + x);
      const sconce::Rgb rgb(v[0] / unit, v[1] / unit, v[2] / unit);
      linear.set_rgb(x, y, rgb);
      for (const float c : {rgb.r, rgb.g, rgb.b})
        codes.data.push_back(
            static_cast<unsigned char>(std::lround(255 * sconce::linear_to_srgb(std::clamp(c, 0.0f, 1.0f)))));
    }
  sconce::write_exr(file + ".exr", linear, sconce::PixelType::full);
  sconce::write_png(file + ".png", codes);
}

}  // namespace room
