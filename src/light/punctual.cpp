// SPDX-License-Identifier: Apache-2.0
#include "light/punctual.h"

namespace sconce {

namespace {

Vec3 forward(const Mat4& frame) {
  return normalize_or(-Vec3(frame[2]), Vec3(0, 0, -1));
}

// KHR_lights_punctual: the cone's edge is the square of a ramp that is linear in the cosine.
float ramp_width(const PunctualLamp& lamp) {
  return std::max(0.001f, lamp.cos_inner - lamp.cos_outer);
}

float cone(const PunctualLamp& lamp, float cosine) {
  if (lamp.cos_outer <= -1) return 1.0f;
  const float t = std::clamp((cosine - lamp.cos_outer) / ramp_width(lamp), 0.0f, 1.0f);
  return t * t;
}

}  // namespace

Lamp make_punctual(const Light& light, const Rgb& intensity, float range, float inner, float outer,
                   bool spot) {
  PunctualLamp lamp;
  lamp.position = Vec3(light.frame[3]);
  lamp.axis = forward(light.frame);
  lamp.intensity = intensity;
  lamp.range = range;
  float solid_angle = 4 * kPi;
  if (spot) {
    lamp.cos_inner = std::cos(inner);
    lamp.cos_outer = std::cos(outer);
    const float width = ramp_width(lamp);
    // Integral of the squared ramp over the sphere: full inside, one third over the edge.
    solid_angle =
        2 * kPi * (std::max(0.0f, 1 - lamp.cos_outer - width) + std::min(width, 1 - lamp.cos_outer) / 3);
  }
  return {light.name, light.group, lamp, intensity * solid_angle, false};
}

Lamp make_sun(const Light& light) {
  return {light.name, light.group, SunLamp{-forward(light.frame), light.intensity}, light.intensity, true};
}

bool sample(const PunctualLamp& lamp, const Vec3& x, LightSample& out) {
  const Vec3 to = lamp.position - x;
  const float d2 = glm::dot(to, to);
  if (!(d2 > 1e-12f)) return false;
  const float d = std::sqrt(d2);
  const Vec3 direction = to / d;
  float factor = cone(lamp, glm::dot(-direction, lamp.axis)) / d2;
  if (lamp.range > 0) {
    const float q = d / lamp.range;
    factor *= std::clamp(1 - q * q * q * q, 0.0f, 1.0f);
  }
  if (factor <= 0) return false;
  out = {direction, d, lamp.intensity * factor, 1.0f, true};
  return true;
}

bool sample(const SunLamp& lamp, LightSample& out) {
  out = {lamp.direction, kInfinite, lamp.illuminance, 1.0f, true};
  return true;
}

}  // namespace sconce
