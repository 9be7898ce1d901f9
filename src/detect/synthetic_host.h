// SPDX-License-Identifier: Apache-2.0
// For tests and benchmarks: a renderer on the processor whose materials are known, with its own idea of what
// 1 is.
#pragma once

#include <stdexcept>

#include "detect/materials.h"
#include "trace/tracer.h"

namespace sconce {

struct SyntheticMaterial {
  SurfaceResponse response;
  float specular = 0, shininess = 0;  ///< a Phong lobe beside it, share of a white card's light
  bool halfway = false;               ///< the lobe is Blinn's
  bool two_sided = false;             ///< its back is lit, too
};

struct SyntheticLamp {
  Vec3 position;
  Rgb intensity;
};

struct SyntheticHost {
  const World& world;
  std::vector<SyntheticMaterial> materials;  ///< per Scene material
  TargetFormat format = TargetFormat::linear;
  float unit = 0.7f;  ///< what its light model makes of a white card under a light of 1
  float shift = 0;    ///< added to the reflectance at the corner of every face: not uniform
  std::vector<SyntheticLamp> lamps{};
  const Tracer* tracer = nullptr;  ///< shadows of the lamps
  bool attenuation = true;         ///< with the square of the distance
  bool clustered = false;          ///< lamps are looked up by the pixel: none in the target's right half
  std::size_t draws = 0;

  Rgb shaded(const SyntheticMaterial& m, const DrawRequest& request, const Vec3& at, const Vec3& n,
             bool right) const {
    const Rgb rho = request.white_card ? Rgb(1) : m.response.reflectance;
    Rgb sum;
    const auto light = [&](const Vec3& to, const Rgb& strength) {
      const float cosine = glm::dot(n, to);
      if (cosine <= 0) return;
      Rgb value = rho * cosine;
      if (!request.white_card && m.specular > 0) {
        const Vec3 mirror = 2 * cosine * n - to, eye = glm::normalize(request.eye - at);
        const float lobe = m.halfway ? glm::dot(n, glm::normalize(to + eye)) : glm::dot(mirror, eye);
        value += Rgb(m.specular * std::pow(std::max(0.0f, lobe), m.shininess));
      }
      sum += value * strength * unit;
    };
    if (request.lights == DrawRequest::Lights::probe)
      light(request.probe.to_light, Rgb(request.probe.intensity));
    if (request.lights == DrawRequest::Lights::all && !(clustered && right))
      for (const SyntheticLamp& lamp : lamps) {
        const float distance = glm::distance(lamp.position, at);
        const Vec3 to = (lamp.position - at) / distance;
        if (tracer != nullptr && tracer->occluded({offset_origin(at, n, n), to, distance})) continue;
        light(to, lamp.intensity * (attenuation ? 1 / (distance * distance) : 1.0f));
      }
    if (request.white_card) return sum;
    return sum + m.response.emission + m.response.transmission * request.background;
  }

  Drawing draw(const DrawRequest& request) {
    ++draws;
    const auto pixels = static_cast<std::size_t>(request.width) * static_cast<std::size_t>(request.height);
    std::vector<Rgb> picture(pixels, Rgb(request.background));
    TextureSpace space;
    space.width = request.width, space.height = request.height;
    space.corners.assign(request.corners.begin(), request.corners.end());
    for (std::size_t i = 0; i < request.triangles.size(); ++i) {
      const uint32_t t = request.triangles[i];
      const auto& [a, b, c] = request.corners[i];
      const glm::mat2 inverse = glm::inverse(glm::mat2(b - a, c - a));
      const bool mirrored = glm::determinant(inverse) < 0;
      each_pixel(space, i, [&](std::size_t pixel) {
        const Vec2 p = pixel_middle(space, pixel);
        const Vec2 w = inverse * (p - a);
        SyntheticMaterial m = materials[world.materials[t].value];
        m.response.reflectance += Rgb(shift * w.x * w.y * static_cast<float>(t % 2));
        const float side = m.two_sided && mirrored ? -1.0f : 1.0f;
        picture[pixel] = shaded(m, request, world.position(t, w), side * world.normal(t, w),
                                2 * p.x > static_cast<float>(request.width));
      });
    }
    Drawing out;
    out.width = request.width, out.height = request.height;
    for (const Rgb& v : picture)
      for (const float x : {v.r, v.g, v.b}) {
        const float code = std::clamp(x, 0.0f, 1.0f);
        if (format == TargetFormat::linear)
          out.values.push_back(x);
        else
          out.codes.push_back(static_cast<uint8_t>(std::lround(
              255 * (format == TargetFormat::srgb8 ? linear_to_srgb(code) : std::pow(code, 0.45f)))));
      }
    return out;
  }

  HostRenderer renderer() {
    return {[this](const DrawRequest& request) { return draw(request); }, format};
  }
};

}  // namespace sconce
