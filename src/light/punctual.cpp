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

/// Integrals over the cosine of the cone's full part and of its edge, the squared ramp.
struct ConeParts {
  float full, edge;
  float top;  ///< where the ramp ends: 1 unless the cone is narrower than it
};
ConeParts cone_parts(const PunctualLamp& lamp) {
  if (lamp.cos_outer <= -1) return {2, 0, 1};
  const float width = ramp_width(lamp), room = 1 - lamp.cos_outer;
  const float top = std::min(1.0f, room / width);
  return {std::max(0.0f, room - width), width * top * top * top / 3, top};
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
  if (spot) {
    lamp.cos_inner = std::cos(inner);
    lamp.cos_outer = std::cos(outer);
  }
  const ConeParts parts = cone_parts(lamp);
  return {light.name, light.group, lamp, intensity * (2 * kPi * (parts.full + parts.edge)), false};
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
  if (lamp.range > 0) factor *= range_window(lamp, d);
  if (factor <= 0) return false;
  out = {direction, d, lamp.intensity * factor, 1.0f, true};
  return true;
}

bool sample(const SunLamp& lamp, LightSample& out) {
  out = {lamp.direction, kInfinite, lamp.illuminance, 1.0f, true};
  return true;
}

float range_window(const PunctualLamp& lamp, float distance) {
  if (lamp.range <= 0) return 1;
  const float q = distance / lamp.range;
  return std::clamp(1 - q * q * q * q, 0.0f, 1.0f);
}

EmittedLight emit(const PunctualLamp& lamp, Vec2 u) {
  const ConeParts parts = cone_parts(lamp);
  const float total = parts.full + parts.edge, at = u.x * total;
  // The edge's density is the square of the ramp, so the ramp is a cube root.
  const float cosine = at < parts.full ? 1 - at
                                       : lamp.cos_outer + ramp_width(lamp) * parts.top *
                                                              std::cbrt(1 - (at - parts.full) / parts.edge);
  const float sine = std::sqrt(std::max(0.0f, 1 - cosine * cosine)), phi = 2 * kPi * u.y;
  const Vec3 local(sine * std::cos(phi), sine * std::sin(phi), cosine);
  return {lamp.position, Vec3(0), Frame(lamp.axis).to_world(local), lamp.intensity * (2 * kPi * total)};
}

EmittedLight emit(const SunLamp& lamp, const Vec3& center, float radius, Vec2 u) {
  return {on_disk(center, radius, lamp.direction, u), Vec3(0), -lamp.direction,
          lamp.illuminance * (kPi * radius * radius)};
}

Vec3 on_disk(const Vec3& center, float radius, const Vec3& towards, Vec2 u) {
  const Vec3 disk = square_to_cosine(u);
  return center + radius * Frame(towards).to_world(Vec3(disk.x, disk.y, 1));
}

}  // namespace sconce
