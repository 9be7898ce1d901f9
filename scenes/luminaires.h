// SPDX-License-Identifier: Apache-2.0
// Four lamps as makers would model them, for the virtual bench: reflectors, emitters and what stands in the
// light. They hang (nadir -y), their opening in the plane y = 0 about the origin.
#pragma once

#include "scene/scene.h"

namespace sconce::demo {

/// A pocket torch: filament a little before the focus of a paraboloid of 20 mm. 5 x 5 filters at 10 mm, 7 x 7
/// at 5 mm. 30 lm before losses.
Scene make_torch();

/// A bicycle light: an LED that shines up (-z) into half a fluted paraboloid, 42 x 28 mm. 9 x 7 filters
/// at 7.5 mm. 60 lm before losses.
Scene make_bicycle_light();

/// A downlight: an opal panel above a louvre of 4 x 4 mirror cells, 160 mm wide. 11 x 11 filters at 20 mm.
/// 1200 lm before losses.
Scene make_louvre();

/// A wall washer: six LEDs along a trough of 118 x 28 mm, one side a slanting mirror, the other matt; nothing
/// of it is round or even. What was tuned with the other three is tried on it. 15 x 6 filters at 10 mm. 300 lm
/// before losses.
Scene make_washer();

}  // namespace sconce::demo
