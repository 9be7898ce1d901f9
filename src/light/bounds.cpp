// SPDX-License-Identifier: Apache-2.0
#include "light/bounds.h"

#include "light/luminaire.h"
#include "light/near_field.h"

namespace sconce {

LampBounds make_bounds(std::span<const Lamp> lamps, float scene_radius2) {
  constexpr float kLargest = 100;    // importance at which a lamp is near enough
  constexpr float kNowhere = 1e18f;  // radius of lamps that are looked at apart: passes every test below
  LampBounds b;
  for (uint32_t i = 0; i < lamps.size(); ++i) {
    Vec3 center(0), axis(0);
    float radius = 0, plane = 0, range2 = 1e38f;
    std::visit(Overload{[&](const PunctualLamp& l) {
                          center = l.position;
                          if (l.range > 0) range2 = l.range * l.range;
                          if (l.cos_outer > -1) b.cones.push_back({i, l.axis, l.cos_outer});
                        },
                        [&](const SunLamp& l) {
                          radius = kNowhere;
                          b.suns.push_back({i, l.direction});
                        },
                        [&](const SkyLamp&) {
                          radius = kNowhere;
                          b.everywhere.push_back(i);
                        },
                        [&](const MeshLamp& l) {
                          center = l.center;
                          radius = l.radius;
                          axis = l.axis;
                          plane = l.plane;
                        },
                        [&](const LuminaireLamp& l) {
                          center = l.position;
                          radius = l.table->opening.radius();
                          if (!dark_above(*l.table)) return;
                          axis = -l.to_world[2];
                          plane = glm::dot(axis, center) - radius;
                        },
                        [&](const ProjectorLamp& l) {
                          center = l.position;
                          b.cones.push_back({i, -l.to_world[2], 1 / std::sqrt(1 + glm::dot(l.half, l.half))});
                        },
                        [&](const NearFieldLamp& l) {
                          center = l.position + l.to_world * l.field->center();
                          radius = l.field->radius();
                          axis = -l.to_world[2];
                          plane = glm::dot(axis, center);
                        }},
               lamps[i].shape);
    b.x.push_back(center.x), b.y.push_back(center.y), b.z.push_back(center.z);
    b.radius.push_back(radius);
    b.axis_x.push_back(axis.x), b.axis_y.push_back(axis.y), b.axis_z.push_back(axis.z);
    b.plane.push_back(plane);
    b.range2.push_back(range2);
    b.least2.push_back(std::max(radius * radius, scene_radius2 / kLargest));
  }
  return b;
}

void Lamps::importances(const Vec3& x, const Vec3& n, std::span<float> out) const {
  const LampBounds& b = bounds_;
  const std::size_t count = out.size();
  const float below = n == Vec3(0) ? -1.0f : 0.0f;  // without a normal there is no horizon
  for (std::size_t i = 0; i < count; ++i) {
    const float tx = b.x[i] - x.x, ty = b.y[i] - x.y, tz = b.z[i] - x.z;
    const float height = tx * n.x + ty * n.y + tz * n.z;
    const float ahead = b.axis_x[i] * x.x + b.axis_y[i] * x.y + b.axis_z[i] * x.z;
    const float d2 = tx * tx + ty * ty + tz * tz;
    const float importance = scene_radius2_ / std::max(d2, b.least2[i]);
    const bool lit = (height > below - b.radius[i]) & (ahead >= b.plane[i]) & (d2 < b.range2[i]);
    out[i] = lit ? importance : 0.0f;
  }
  for (const auto& [i, axis, cosine] : b.cones) {
    const Vec3 from = x - Vec3(b.x[i], b.y[i], b.z[i]);
    if (glm::dot(from, axis) <= cosine * glm::length(from)) out[i] = 0;
  }
  for (const auto& [i, direction] : b.suns) out[i] = glm::dot(direction, n) > below ? 1.0f : 0.0f;
  for (const uint32_t i : b.everywhere) out[i] = 1;
}

}  // namespace sconce
