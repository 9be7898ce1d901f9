// SPDX-License-Identifier: Apache-2.0
#include "detect/lambertian.h"

#include <map>

namespace sconce {

namespace {

/// Angles to the face's normal, in one plane, radians; of opposite signs on opposite sides.
struct Setting {
  float light, eye;
};
constexpr std::array<Setting, 3> kSettings{{{0.7f, -0.7f}, {0.9f, 0.9f}, {1.25f, -1.25f}}};

constexpr float kIntensity = 0.75f;  // leaves 8-bit targets room for highlights
constexpr float kDim = 0.01f;        // cards below it tell nothing
constexpr float kCodes = 4;          // roundings that meet in a residual: light, emission, reflectance, card

/// Faces that look the same way share drawings.
using Facing = std::array<int, 3>;
Facing facing(const Vec3& n) {
  const auto step = [](float v) { return static_cast<int>(std::lround(16 * v)); };
  return {step(n.x), step(n.y), step(n.z)};
}

Vec3 tilted(const Vec3& n, float angle) {
  return std::cos(angle) * n + std::sin(angle) * Frame(n).x;
}

}  // namespace

std::vector<HeldOut> held_out_residuals(const World& world, const HostRenderer& host,
                                        std::span<const DetectedFace> known, std::size_t materials,
                                        int texels, float limit, const Progress& progress,
                                        CaptureCost& cost) {
  std::vector<const DetectedFace*> largest(materials, nullptr);
  for (const DetectedFace& face : known) {
    const DetectedFace*& best = largest[world.materials[face.triangle].value];
    if (best == nullptr || world.area(face.triangle) > world.area(best->triangle)) best = &face;
  }
  std::map<Facing, std::vector<const DetectedFace*>> groups;
  for (const DetectedFace* face : largest)
    if (face != nullptr) groups[facing(world.face_normals[face->triangle])].push_back(face);

  std::vector<HeldOut> out(materials);
  for (const auto& [direction, faces] : groups) {
    std::vector<uint32_t> triangles;
    for (const DetectedFace* face : faces) triangles.push_back(face->triangle);
    const TextureSpace space = face_cells(triangles, std::vector<int>(triangles.size(), texels));
    const Vec3 normal = world.face_normals[triangles[0]];
    for (const Setting& setting : kSettings) {
      progress.check();
      DrawRequest request;
      request.lights = DrawRequest::Lights::probe;
      request.probe = {tilted(normal, setting.light), kIntensity};
      request.eye = world.bounds.center() + 10 * world.bounds.diagonal() * tilted(normal, setting.eye);
      const Captured drawn = capture(host, space, request, "faces under a held-out light");
      request.white_card = true;
      const Captured card = capture(host, space, request, "a white card under a held-out light");
      cost += drawn.cost, cost += card.cost;
      for (std::size_t i = 0; i < faces.size(); ++i) {
        bool clipped = false, card_clipped = false;
        const Rgb light = face_mean(space, i, drawn, clipped),
                  white = face_mean(space, i, card, card_clipped);
        const float least = std::min({white.r, white.g, white.b});
        if (card_clipped || !(least > kDim)) continue;
        const SurfaceResponse& r = faces[i]->response;
        const Rgb d = light - (r.emission + r.reflectance * white);
        // Where highlights clip, what is seen of them counts.
        const float residual =
            std::max({std::abs(d.r) / white.r, std::abs(d.g) / white.g, std::abs(d.b) / white.b});
        HeldOut& result = out[world.materials[faces[i]->triangle].value];
        result.residual = std::max(result.residual, residual);
        if (residual > std::max(limit, kCodes * half_step(host.format) / least)) result.holds = false;
      }
    }
  }
  return out;
}

}  // namespace sconce
