// SPDX-License-Identifier: Apache-2.0
// Lamps measured from near on glossy surfaces: every term of a light field is a spot at its filter's centre,
// so that no ray of a lobe meets it by chance; the lobe is taken at that centre (Granier and others 2003, eq.
// 13).
#pragma once

#include "light/lamp.h"
#include "scene/world.h"
#include "trace/tracer.h"

namespace sconce {

/// Numbers of the lamps that are light fields.
std::vector<std::size_t> near_lamps(const Lamps& lamps);

/// What a surface mirrors of such a lamp towards the eye, cd/m2, shadow ray included, in the mean over all u.
/// Its lobe is at least as wide as half a filter seen from there.
/// @param at  its normals on the side of the eye
Rgb glint(const Lamps& lamps, std::size_t lamp, const Tracer& tracer, const Shade& surface,
          const Vec3& to_eye, const SurfacePoint& at, Vec2 u);

}  // namespace sconce
