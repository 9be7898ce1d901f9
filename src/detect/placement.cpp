// SPDX-License-Identifier: Apache-2.0
#include "detect/placement.h"

namespace sconce {

namespace {

constexpr float kDim = 0.02f;  // light below it tells nothing

/// Mean light of each face.
std::vector<float> lights(const HostRenderer& host, std::span<const uint32_t> triangles, int texels,
                          CaptureCost& cost) {
  const TextureSpace space = face_cells(triangles, std::vector<int>(triangles.size(), texels));
  DrawRequest request;
  request.lights = DrawRequest::Lights::all;
  const Captured drawn = capture(host, space, request, "faces under all lights");
  cost += drawn.cost;
  bool clipped = false;
  std::vector<float> out;
  for (std::size_t i = 0; i < triangles.size(); ++i)
    out.push_back(luminance(face_mean(space, i, drawn, clipped)));
  return out;
}

}  // namespace

float placement_residual(const HostRenderer& host, std::span<const uint32_t> triangles, int texels,
                         CaptureCost& cost) {
  const std::vector<uint32_t> reversed(triangles.rbegin(), triangles.rend());
  const std::vector<float> here = lights(host, triangles, texels, cost),
                           there = lights(host, reversed, texels, cost);
  float worst = 0;
  for (std::size_t i = 0; i < here.size(); ++i) {
    const float a = here[i], b = there[here.size() - 1 - i];
    if (std::max(a, b) > kDim) worst = std::max(worst, std::abs(a - b) / std::max(a, b));
  }
  return worst;
}

}  // namespace sconce
