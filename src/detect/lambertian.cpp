// SPDX-License-Identifier: Apache-2.0
#include "detect/lambertian.h"

#include <map>

#include "detect/axes.h"

namespace sconce {

namespace {

/// Angles to the face's normal, in one plane, radians; of opposite signs on opposite sides.
struct Setting {
  float light, eye;
};
constexpr std::array<Setting, 3> kSettings{{{0.7f, -0.7f}, {0.9f, 0.9f}, {1.25f, -1.25f}}};

constexpr Setting kPlain{0.3f, 1.1f};  // far from the mirror: what texels of curved faces are compared with

constexpr float kIntensity = 0.75f;  // leaves 8-bit targets room for highlights
constexpr float kDim = 0.01f;        // cards below it tell nothing
constexpr float kCodes = 4;          // roundings that meet in a residual: light, emission, reflectance, card

/// Faces that look the same way share drawings.
using Facing = std::array<int, 3>;
Facing facing(const Vec3& n) {
  const auto step = [](float v) { return static_cast<int>(std::lround(16 * v)); };
  return {step(n.x), step(n.y), step(n.z)};
}

/// Whether a face's normals differ over it: narrow highlights are then lost in its mean.
bool curved(const World& world, uint32_t triangle) {
  constexpr float kFlat = 0.9994f;  // cosine of two degrees
  for (const Vec2 corner : {Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)})
    if (glm::dot(world.normal(triangle, corner), world.face_normals[triangle]) < kFlat) return true;
  return false;
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
    struct Pair {
      Captured drawn, card;
    };
    const auto draw = [&](const Setting& setting) {
      progress.check();
      DrawRequest request;
      request.lights = DrawRequest::Lights::probe;
      request.probe = {tilted(normal, setting.light), kIntensity};
      request.eye = far_eye(world, tilted(normal, setting.eye));
      Pair pair;
      pair.drawn = capture(host, space, request, "faces under a held-out light");
      request.white_card = true;
      pair.card = capture(host, space, request, "a white card under a held-out light");
      cost += pair.drawn.cost, cost += pair.card.cost;
      return pair;
    };
    const bool any_curved =
        std::any_of(triangles.begin(), triangles.end(), [&](uint32_t t) { return curved(world, t); });
    const Pair plain = any_curved ? draw(kPlain) : Pair();
    const Captured unlit = any_curved ? capture(host, space, {}, "unlit faces") : Captured();
    cost += unlit.cost;
    for (const Setting& setting : kSettings) {
      const auto [drawn, card] = draw(setting);
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
        if (!curved(world, triangles[i])) continue;
        each_pixel(space, i, [&](std::size_t pixel) {
          const Rgb &w = card.light[pixel], &w0 = plain.card.light[pixel];
          const float darkest = std::min({w.r, w.g, w.b}), darkest0 = std::min({w0.r, w0.g, w0.b});
          if (card.is_clipped(pixel) || plain.drawn.is_clipped(pixel) || plain.card.is_clipped(pixel) ||
              !(darkest > kDim) || !(darkest0 > kDim))
            return;
          const Rgb lit = drawn.light[pixel] - unlit.light[pixel],
                    before = plain.drawn.light[pixel] - unlit.light[pixel];
          const float off =
              std::max({std::abs(lit.r / w.r - before.r / w0.r), std::abs(lit.g / w.g - before.g / w0.g),
                        std::abs(lit.b / w.b - before.b / w0.b)});
          result.residual = std::max(result.residual, off);
          if (off > std::max(limit, kCodes * half_step(host.format) * (1 / darkest + 1 / darkest0)))
            result.holds = false;
        });
      }
    }
  }
  return out;
}

}  // namespace sconce
