// SPDX-License-Identifier: Apache-2.0
// For tests and benchmarks only: what OpenGL draws of light fields, by rays.
#pragma once

#include "light/lamp.h"
#include "light/near_field.h"
#include "trace/tracer.h"

namespace sconce {

/// Eq. 14: all terms of the finest light field, lux at scale 1.
/// @param tracer  a shadow ray for each term; null = no shadows
inline double near_spots(const NearFieldLamp& lamp, const SurfacePoint& at, const Tracer* tracer,
                         std::size_t channel = 0) {
  const NearLamp& spots = lamp.field->channel(channel);
  const LightField& field = spots.field();
  const Vec3 x = (at.position - lamp.position) * lamp.to_world, n = at.shading_normal * lamp.to_world,
             start = offset_origin(at.position, at.geometric_normal, at.geometric_normal);
  double sum = 0;
  for (int row = 0; row < field.rows; ++row)
    for (int column = 0; column < field.columns; ++column) {
      const double term = spots.term(column, row, x, n);
      if (term == 0) continue;
      const Vec3 center = lamp.position + lamp.to_world * Vec3(Vec2(field.center(column, row)), 0),
                 to = center - at.position;
      if (!(glm::dot(to, at.geometric_normal) > 0)) continue;
      const float distance = glm::length(to);
      if (tracer != nullptr && tracer->occluded({start, to / distance, distance * (1 - 1e-4f)})) continue;
      sum += term;
    }
  return sum;
}

}  // namespace sconce
