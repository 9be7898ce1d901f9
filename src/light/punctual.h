// SPDX-License-Identifier: Apache-2.0
// Point, spot and sun: lamps without extent.
#pragma once

#include "light/lamp.h"

namespace sconce {

Lamp make_punctual(const Light& light, const Rgb& intensity, float range, float inner, float outer,
                   bool spot);
Lamp make_sun(const Light& light);

bool sample(const PunctualLamp& lamp, const Vec3& x, LightSample& out);
bool sample(const SunLamp& lamp, LightSample& out);

/// Direction in proportion to intensity.
EmittedLight emit(const PunctualLamp& lamp, Vec2 u);
/// @param center, radius  sphere around what is lit, m
EmittedLight emit(const SunLamp& lamp, const Vec3& center, float radius, Vec2 u);
/// KHR_lights_punctual: what `range` leaves of the inverse square.
float range_window(const PunctualLamp& lamp, float distance);
/// Point on a disk of `radius` around center + radius * towards, perpendicular to `towards`; uniform.
Vec3 on_disk(const Vec3& center, float radius, const Vec3& towards, Vec2 u);

}  // namespace sconce
