// SPDX-License-Identifier: Apache-2.0
// For tests and benchmarks only: what OpenGL draws of light fields, by rays.
#pragma once

#include "light/lamp.h"
#include "light/near_field.h"
#include "picture/gloss.h"
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

/// Whether the edge of a term's shadow is at most two texels of its map away.
/// @param side  of a map, texels (gpu/near_lights.cpp: it shows M and a margin of 3)
inline bool near_shadow_edge(const NearFieldLamp& lamp, const SurfacePoint& at, const Tracer& tracer,
                             int side) {
  const NearLamp& spots = lamp.field->finest();
  const LightField& field = spots.field();
  const Vec3 local = (at.position - lamp.position) * lamp.to_world;
  const double texel = (field.pixel * field.width + field.spacing) / (side - 6),
               step = texel * static_cast<double>(-local.z) / field.distance;
  for (int n = 0; n < field.rows; ++n)
    for (int m = 0; m < field.columns; ++m) {
      const Vec3 center(Vec2(field.center(m, n)), 0), from = lamp.position + lamp.to_world * center;
      if (spots.term(m, n, local, glm::normalize(center - local)) == 0) continue;
      int lit = 0;
      for (int i = -2; i <= 2; ++i)
        for (int j = -2; j <= 2; ++j) {
          const Vec3 through = at.position + lamp.to_world * Vec3(Vec2(step * glm::dvec2(i, j)), 0),
                     direction = glm::normalize(through - from);
          const float plane =
              glm::dot(at.position - from, at.geometric_normal) / glm::dot(direction, at.geometric_normal);
          const Hit first = tracer.closest({from, direction});
          lit += first && first.distance < plane * (1 - 1e-4f) ? 0 : 1;
        }
      if (lit != 0 && lit != 25) return true;
    }
  return false;
}

/// Eq. 13: what a glossy surface mirrors of all terms, cd/m2 at scale 1, where nothing is in their way.
inline Rgb near_glints(const NearFieldLamp& lamp, const Shade& surface, const Vec3& to_eye,
                       const SurfacePoint& at, std::size_t channel = 0) {
  const NearLamp& spots = lamp.field->channel(channel);
  const LightField& field = spots.field();
  const Vec3 x = (at.position - lamp.position) * lamp.to_world;
  Rgb sum;
  for (int row = 0; row < field.rows; ++row)
    for (int column = 0; column < field.columns; ++column) {
      const Vec3 to = Vec3(Vec2(field.center(column, row)), 0) - x;
      const float distance = glm::length(to);
      sum += gloss_of(surface, to_eye, at, lamp.to_world * (to / distance),
                      0.5f * static_cast<float>(field.spacing) / distance) *
             static_cast<float>(spots.term(column, row, x, to / distance));
    }
  return sum;
}

}  // namespace sconce
