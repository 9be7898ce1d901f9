// SPDX-License-Identifier: Apache-2.0
// Measured lamps: far-field tables whose light leaves from all of the luminous opening, so that shadows are
// soft and the lamp looks its size from near.
#pragma once

#include "light/lamp.h"

namespace sconce {

Lamp make_luminaire(const Light& light, const Photometry& photometry);

/// A point of the opening's side that x sees, as a point lamp of the table's intensity: E = mean of I cos /
/// d2 over them. The direction is not met at random, as the opening is no surface: delta.
bool sample(const LuminaireLamp& lamp, const Vec3& x, Vec2 u, LightSample& out);
/// Directions in proportion to the bilinear intensity, exactly.
EmittedLight emit(const LuminaireLamp& lamp, Vec2 where, Vec2 whither);

/// Is there no light above the horizon (gamma > 90)?
bool dark_above(const Photometry& photometry);

/// A point of the opening, uniform over its silhouette seen along `towards` (unit, luminaire's frame), on the
/// near side; metres.
Vec3 on_opening(const Opening& opening, const Vec3& towards, Vec2 u);

}  // namespace sconce
