// SPDX-License-Identifier: Apache-2.0
#include "detect/placement.h"

namespace sconce {

namespace {

constexpr float kDim = 0.02f;  // light below it tells nothing
// Lists of lights are of a screen and of its tiles: faces have to come around on it.
constexpr std::size_t kDrawings = 4;
constexpr int kSide = 1024;  // pixels

/// Mean light of each face.
std::vector<float> lights(const HostRenderer& host, const TextureSpace& space, CaptureCost& cost) {
  DrawRequest request;
  request.lights = DrawRequest::Lights::all;
  const Captured drawn = capture(host, space, request, "faces under all lights");
  cost += drawn.cost;
  bool clipped = false;
  std::vector<float> out;
  for (std::size_t i = 0; i < space.triangles.size(); ++i)
    out.push_back(luminance(face_mean(space, i, drawn, clipped)));
  return out;
}

}  // namespace

float placement_residual(const HostRenderer& host, std::span<const uint32_t> triangles, int texels,
                         CaptureCost& cost) {
  std::vector<float> least(triangles.size(), 1e30f), most(triangles.size(), 0);
  for (std::size_t k = 0; k < kDrawings; ++k) {
    const float shift = (static_cast<float>(k) + 0.5f) / kDrawings;
    const std::vector<float> seen =
        lights(host, spread_cells(triangles, texels, kSide, k * triangles.size() / kDrawings, shift), cost);
    for (std::size_t i = 0; i < seen.size(); ++i)
      least[i] = std::min(least[i], seen[i]), most[i] = std::max(most[i], seen[i]);
  }
  float worst = 0;
  for (std::size_t i = 0; i < least.size(); ++i)
    if (most[i] > kDim) worst = std::max(worst, (most[i] - least[i]) / most[i]);
  return worst;
}

}  // namespace sconce
