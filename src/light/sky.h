// SPDX-License-Identifier: Apache-2.0
// Light from infinity: constant, or a lat-long image (row 0 = up, centre column = -z).
#pragma once

#include "light/lamp.h"

namespace sconce {

Lamp make_sky(const Light& light, const SkyLight& sky);

bool sample(const SkyLamp& lamp, Vec2 u, LightSample& out);
/// @param center, radius  sphere around what is lit, m
EmittedLight emit(const SkyLamp& lamp, const Vec3& center, float radius, Vec2 where, Vec2 whither);
Rgb radiance(const SkyLamp& lamp, const Vec3& direction);
/// Density of sample() per steradian.
float pdf(const SkyLamp& lamp, const Vec3& direction);

}  // namespace sconce
