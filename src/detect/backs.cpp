// SPDX-License-Identifier: Apache-2.0
#include "detect/backs.h"

#include "detect/axes.h"

namespace sconce {

std::vector<uint8_t> lit_backs(const World& world, const HostRenderer& host,
                               std::span<const CardedFace> faces, std::size_t materials, int texels,
                               const Progress& progress, CaptureCost& cost) {
  constexpr double kLit = 0.25;  // of what fronts reflect
  std::vector<double> shown(materials), expected(materials);
  for (std::size_t axis = 0; axis < kAxes; ++axis) {
    std::vector<uint32_t> triangles;
    std::vector<const CardedFace*> drawn;
    for (const CardedFace& f : faces)
      if (facing_axis(world.face_normals[f.face->triangle]) == axis)
        triangles.push_back(f.face->triangle), drawn.push_back(&f);
    if (drawn.empty()) continue;
    progress.check();
    const TextureSpace space = mirrored(face_cells(triangles, std::vector<int>(triangles.size(), texels)));
    DrawRequest request;
    request.lights = DrawRequest::Lights::probe;
    request.probe.to_light = -axis_direction(axis);
    request.eye = far_eye(world, request.probe.to_light);
    const Captured captured = capture(host, space, request, "backs under one light");
    cost += captured.cost;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      bool clipped = false;
      const SurfaceResponse& r = drawn[i]->face->response;
      const uint32_t m = world.materials[triangles[i]].value;
      shown[m] += static_cast<double>(luminance(face_mean(space, i, captured, clipped) - r.emission));
      expected[m] += static_cast<double>(luminance(r.reflectance) * drawn[i]->card);
    }
  }
  std::vector<uint8_t> lit(materials);
  for (std::size_t m = 0; m < materials; ++m)
    lit[m] = expected[m] > 0 && shown[m] > kLit * expected[m] ? 1 : 0;
  return lit;
}

}  // namespace sconce
