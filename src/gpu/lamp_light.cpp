// SPDX-License-Identifier: Apache-2.0
#include "gpu/lamp_light.h"

namespace sconce::gpu {

namespace {

Rgb rgb_of(const Rgbx& v) {
  return {v[0], v[1], v[2]};
}

}  // namespace

LampLight::LampLight(const Context& context, const Geometry& geometry, const Bounds& bounds, LampShader lamp)
    : context_(&context), direct_(context, geometry, bounds, {std::move(lamp)}) {}

std::vector<Rgbx> LampLight::exitance(std::span<const OperatorPoint> points, uint32_t per_slot) {
  std::vector<Rgbx> out(points.size() / per_slot);
  if (out.empty()) return out;
  const auto slots = static_cast<uint32_t>(out.size());
  const Buffer places(*context_, points, "points that a lamp lights");
  const Buffer light(*context_, slots * sizeof(Rgbx), nullptr, "light of a lamp");
  direct_.light_cloud(places, slots, per_slot, light);
  light.read(slots * sizeof(Rgbx), out.data());
  return out;
}

std::vector<Rgb> LampLight::at(std::span<const SurfacePoint> points) {
  std::vector<OperatorPoint> places;
  for (const SurfacePoint& p : points)
    places.push_back({{p.position.x, p.position.y, p.position.z},
                      pack_normal(p.shading_normal),
                      pack_normal(p.geometric_normal),
                      pack_albedo(Rgb(1))});
  std::vector<Rgb> out;
  for (const Rgbx& light : exitance(places, 1)) out.push_back(rgb_of(light));
  return out;
}

std::vector<Rgb> LampLight::on_receivers(const Operator& op, const FoldedBounces& bounces) {
  std::vector<OperatorPoint> receivers(op.receivers.begin(), op.receivers.end());
  for (OperatorPoint& receiver : receivers) receiver.albedo = pack_albedo(Rgb(1));
  const std::vector<Rgbx> seen = exitance(receivers, 1);
  std::vector<Rgbx> cloud = exitance(op.lit, op.points_per_slot);
  std::vector<Rgb> light(seen.size());
  bounces.indirect(cloud, light);
  for (std::size_t i = 0; i < light.size(); ++i) light[i] += rgb_of(seen[i]);
  return light;
}

Mishap LampLight::mishap() const {
  const auto reports = direct_.mishaps();
  return reports.empty() ? Mishap() : reports.front().cloud;
}

}  // namespace sconce::gpu
