// SPDX-License-Identifier: Apache-2.0
// What a foreign renderer is asked for: to draw faces of its scene, with its own shaders, into texture space
// (system B). One callback; no OpenGL here, so any renderer will do.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "core/rgb.h"
#include "core/vec.h"

namespace sconce {

/// What the numbers of the renderer's target mean.
enum class TargetFormat : uint8_t {
  linear,  ///< floats, not clamped
  srgb8,   ///< 8-bit sRGB codes
  power8,  ///< 8-bit codes of value^0.45, as Hrbek's viewer had them
};

struct TargetFormatRow {
  std::string_view name;
  TargetFormat format;
};
inline constexpr std::array<TargetFormatRow, 3> kTargetFormats{
    {{"linear", TargetFormat::linear}, {"srgb8", TargetFormat::srgb8}, {"power8", TargetFormat::power8}}};

/// One picture. The renderer's vertex shader runs as for the screen; only its position is overwritten at last
/// (shader/vertex_override.h). No culling, no depth test, no tone curve.
struct DrawRequest {
  enum class Lights : uint8_t {
    none,
    probe,  ///< only the one of `probe`; without shadows
    all,    ///< the scene's own, as they are now, with their shadows, without the ambient term
  } lights = Lights::none;
  /// Parallel light, or a point light so far away that it is parallel.
  struct Probe {
    Vec3 to_light{0, 0, 1};  ///< unit
    float intensity = 1;     ///< x what the renderer calls 1
  } probe;
  Vec3 eye{0};              ///< where shaders that ask for it find the camera, m; not with Lights::all
  bool white_card = false;  ///< draw the faces with a diffuse material of reflectance 1 instead of theirs
  float background = 0;     ///< the target is cleared to it, linear: 0 black, 1 white

  int width = 0, height = 0;            ///< of the target, pixels
  std::span<const uint32_t> triangles;  ///< to draw, of the World
  /// Per triangle, where its corners lie in the target, in pixels from the corner of the first row's first
  /// pixel. Wound as the triangle: counter-clockwise where rows go up; clockwise where its back is asked for,
  /// which only renderers that light both sides will show (gl_FrontFacing is false).
  std::span<const std::array<Vec2, 3>> corners;

  std::size_t pixels() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
};

/// What came of it: RGB, row by row, the first row as of `DrawRequest::corners`.
struct Drawing {
  int width = 0, height = 0;
  std::vector<float> values;     ///< TargetFormat::linear
  std::vector<uint8_t> codes;    ///< the others
  double read_milliseconds = 0;  ///< of all, what reading back took; 0 where unknown
};

/// A foreign renderer. The callback restores its own state; it may throw, which is reported as its failure.
struct HostRenderer {
  std::function<Drawing(const DrawRequest&)> draw;
  TargetFormat format = TargetFormat::linear;
};

}  // namespace sconce
