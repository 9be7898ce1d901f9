// SPDX-License-Identifier: Apache-2.0
// A projector: a slide thrown through a point, so that a screen across its axis is lit evenly but for it.
#pragma once

#include "light/lamp.h"

namespace sconce {

Lamp make_projector(const Light& light, const ProjectorLight& projector);

/// I = Light::intensity x slide / cos^3 towards x, black outside of the picture.
bool sample(const ProjectorLamp& lamp, const Vec3& x, LightSample& out);
/// Pixels in proportion to their luminance.
EmittedLight emit(const ProjectorLamp& lamp, Vec2 u);

}  // namespace sconce
