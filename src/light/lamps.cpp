// SPDX-License-Identifier: Apache-2.0
#include <map>

#include "light/bounds.h"
#include "light/lamp.h"
#include "light/luminaire.h"
#include "light/mesh_lamp.h"
#include "light/near_field.h"
#include "light/projector.h"
#include "light/punctual.h"
#include "light/sky.h"

namespace sconce {

namespace {

/// Light fields made ready so far, by luminaire.
using NearFields = std::map<uint32_t, std::shared_ptr<const NearField>>;

Lamp make_measured(const Scene& scene, const Light& light, const LuminaireLight& measured,
                   NearFields& known) {
  const Luminaire& luminaire = scene[measured.luminaire];
  if (!luminaire.field) return make_luminaire(light, luminaire.photometry);
  auto& field = known[measured.luminaire.value];
  if (!field) field = std::make_shared<NearField>(*luminaire.field);
  return make_near_field(light, field, measured.exact_below);
}

Lamp make_lamp(const Scene& scene, const Light& light, NearFields& fields) {
  return std::visit(Overload{[&](const PointLight& p) {
                               return make_punctual(light, light.intensity, p.range, 0, 0, false);
                             },
                             [&](const SpotLight& s) {
                               return make_punctual(light, light.intensity, s.range, s.inner, s.outer, true);
                             },
                             [&](const SunLight&) { return make_sun(light); },
                             [&](const SkyLight& s) { return make_sky(light, s); },
                             [&](const LuminaireLight& l) { return make_measured(scene, light, l, fields); },
                             [&](const ProjectorLight& p) { return make_projector(light, p); }},
                    light.shape);
}

}  // namespace

Lamps::Lamps(const Scene& scene, const World& world) : scene_(&scene), world_(&world) {
  const float radius = std::max(1e-6f, 0.5f * world.bounds.diagonal());
  scene_radius2_ = radius * radius;
  NearFields fields;
  for (const Light& light : scene.lights) {
    if (std::holds_alternative<SkyLight>(light.shape)) skies_.push_back(static_cast<uint32_t>(lamps_.size()));
    lamps_.push_back(make_lamp(scene, light, fields));
  }
  for (uint32_t t = 0; t < world.size();) {
    uint32_t end = t + 1;
    while (end < world.size() && world.instances[end] == world.instances[t]) ++end;
    if (scene[world.materials[t]].emits()) {
      lamp_of_.resize(world.size(), -1);
      std::fill(lamp_of_.begin() + t, lamp_of_.begin() + end, static_cast<int>(lamps_.size()));
      lamps_.push_back(make_mesh_lamp(scene, world, world.instances[t], t, end - t));
    }
    t = end;
  }
  bounds_ = make_bounds(lamps_, scene_radius2_);
}

bool Lamps::sample_other(std::size_t i, const Vec3& x, Vec2 u, LightSample& out) const {
  return std::visit(
      Overload{[&](const PunctualLamp& l) { return sconce::sample(l, x, out); },
               [&](const SunLamp& l) { return sconce::sample(l, out); },
               [&](const SkyLamp& l) { return sconce::sample(l, u, out); },
               [&](const LuminaireLamp& l) { return sconce::sample(l, x, u, out); },
               [&](const NearFieldLamp& l) { return sconce::sample(l, x, u, out); },
               [&](const ProjectorLamp& l) { return sconce::sample(l, x, out); },
               [&](const MeshLamp& l) { return sconce::sample(l, *scene_, *world_, x, u, out); }},
      lamps_[i].shape);
}

EmittedLight Lamps::emit(std::size_t i, Vec2 where, Vec2 whither) const {
  const Vec3 center = world_->bounds.center();
  const float radius = 1.001f * std::sqrt(scene_radius2_);  // so that the disk touches nothing
  return std::visit(
      Overload{[&](const PunctualLamp& l) { return sconce::emit(l, whither); },
               [&](const SunLamp& l) { return sconce::emit(l, center, radius, where); },
               [&](const SkyLamp& l) { return sconce::emit(l, center, radius, where, whither); },
               [&](const MeshLamp& l) { return sconce::emit(l, *scene_, *world_, where, whither); },
               [&](const LuminaireLamp& l) { return sconce::emit(l, where, whither); },
               [&](const ProjectorLamp& l) { return sconce::emit(l, whither); },
               [&](const NearFieldLamp& l) { return sconce::emit(l, where, whither); }},
      lamps_[i].shape);
}

float Lamps::reach(std::size_t i, float distance) const {
  const auto* lamp = std::get_if<PunctualLamp>(&lamps_[i].shape);
  return lamp != nullptr ? range_window(*lamp, distance) : 1.0f;
}

Rgb Lamps::emission(uint32_t triangle, Vec2 barycentric, bool back) const {
  const int lamp = lamp_of(triangle);
  if (lamp < 0 || (back && !std::get<MeshLamp>(lamps_[static_cast<std::size_t>(lamp)].shape).two_sided))
    return {};
  return emission_at(*scene_, *world_, triangle, barycentric);
}

float Lamps::pdf(uint32_t triangle, Vec2 barycentric, float distance, const Vec3& direction) const {
  const auto& lamp = std::get<MeshLamp>(lamps_[static_cast<std::size_t>(lamp_of(triangle))].shape);
  return sconce::pdf(lamp, *world_, triangle, barycentric, distance, direction);
}

Rgb Lamps::sky_radiance(std::size_t i, const Vec3& direction) const {
  return radiance(std::get<SkyLamp>(lamps_[i].shape), direction);
}

float Lamps::sky_pdf(std::size_t i, const Vec3& direction) const {
  return sconce::pdf(std::get<SkyLamp>(lamps_[i].shape), direction);
}

std::vector<GroupFlux> group_flux(const Scene& scene, const Lamps& lamps) {
  std::vector<GroupFlux> groups(scene.groups.size());
  std::vector<Rgb> sums(groups.size());
  for (const Lamp& lamp : lamps.all()) {
    if (!lamp.group.valid()) continue;
    GroupFlux& group = groups[lamp.group.value];
    group.lamps.push_back(lamp.name);
    group.infinite |= lamp.infinite;
    group.lumens += static_cast<double>(luminance(lamp.flux));
    sums[lamp.group.value] += lamp.flux;
  }
  const auto unit = [](const Rgb& c) { return luminance(c) > 0 ? c / luminance(c) : Rgb(1.0f); };
  for (std::size_t g = 0; g < groups.size(); ++g) {
    groups[g].color = unit(sums[g]);
    if (groups[g].infinite) groups[g].lumens = 0;
  }
  for (const Lamp& lamp : lamps.all()) {
    if (!lamp.group.valid() || luminance(lamp.flux) <= 0) continue;
    GroupFlux& group = groups[lamp.group.value];
    const Rgb d = unit(lamp.flux) - group.color;
    group.spread =
        std::max(group.spread, static_cast<double>(std::max({std::abs(d.r), std::abs(d.g), std::abs(d.b)})));
  }
  for (GroupFlux& group : groups)
    if (group.spread < 1e-5) group.spread = 0;  // float rounding of equal lamps
  return groups;
}

}  // namespace sconce
