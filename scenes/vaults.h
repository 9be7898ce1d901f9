// SPDX-License-Identifier: Apache-2.0
// Two rooms after the paper's test scenes, in metres, y up, floor at 0.
#pragma once

#include "scene/scene.h"

namespace sconce::demo {

/// A barrel vault on six columns, 6 x 9 m; 500 triangles, give or take ten.
Scene make_crypt();

/// A square walk of twin columns and arches about a garth, 14 x 14 m; some 8,000 triangles.
Scene make_cloister();

}  // namespace sconce::demo
