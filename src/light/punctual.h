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

}  // namespace sconce
