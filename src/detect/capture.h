// SPDX-License-Identifier: Apache-2.0
// A foreign renderer's pictures as linear light, checked.
#pragma once

#include <string>

#include "detect/host.h"
#include "detect/texture_space.h"

namespace sconce {

/// What looking cost.
struct CaptureCost {
  std::size_t draws = 0;
  double milliseconds = 0;       ///< in the callback, reading back included
  double read_milliseconds = 0;  ///< of it, as far as the renderer tells

  CaptureCost& operator+=(const CaptureCost& o) {
    draws += o.draws, milliseconds += o.milliseconds, read_milliseconds += o.read_milliseconds;
    return *this;
  }
};

struct Captured {
  std::vector<Rgb> light;        ///< per pixel, linear: what the renderer calls 1 is 1
  std::vector<uint8_t> clipped;  ///< per pixel: 1 where a channel has the largest code; empty for floats
  CaptureCost cost;

  bool is_clipped(std::size_t pixel) const { return !clipped.empty() && clipped[pixel] != 0; }
  /// Pixels of another drawing of the same renderer, behind one's own.
  void append(const Captured& other);
};

/// What the renderer draws, once.
/// @param request  its size, triangles and corners are set here, from `space`
/// @param what     for messages: what is drawn
/// @throws Error naming the renderer's fault: it threw, has the wrong size or format, drew what is no light
Captured capture_once(const HostRenderer& host, const TextureSpace& space, DrawRequest request,
                      const std::string& what);
/// The same; where all lights leave everything black, a second drawing on white tells whether it draws at
/// all.
/// @throws Error also when it draws nothing
Captured capture(const HostRenderer& host, const TextureSpace& space, const DrawRequest& request,
                 const std::string& what);

/// Mean light of a face's pixels. @param clipped  set where a channel of any of them is
Rgb face_mean(const TextureSpace& space, std::size_t face, const Captured& captured, bool& clipped);

/// Linear value of an 8-bit code.
float decode_code(TargetFormat format, uint8_t code);
/// Half the largest step between codes: what rounding can cost, linear. 0 for floats.
float half_step(TargetFormat format);

}  // namespace sconce
