// SPDX-License-Identifier: Apache-2.0
#include "solve/inputs.h"

#include "core/hash.h"
#include "photometry/light_field.h"

namespace sconce {

namespace {

template <class T>
void add(ContentHash& hash, const std::vector<T>& values) {
  hash.span(std::span<const T>(values));
}

void add(ContentHash& hash, const Scene& scene, const TextureUse& use) {
  hash.value(use.texture.valid());
  if (!use.texture.valid()) return;
  const Texture& texture = scene[use.texture];
  hash.value(use.texcoord).value(use.offset).value(use.scale).value(use.rotation);
  hash.value(texture.wrap_u).value(texture.wrap_v).value(texture.nearest);
  hash.value(texture.pixels.width).value(texture.pixels.height).value(texture.pixels.channels);
  add(hash, texture.pixels.data);
}

/// All of a material but its name and its light.
std::string surface(const Scene& scene, const Material& m) {
  ContentHash hash;
  hash.value(m.base_color).value(m.alpha).value(m.metallic).value(m.roughness);
  hash.value(m.transmission);
  hash.value(m.alpha_mode).value(m.alpha_cutoff).value(m.double_sided);
  add(hash, scene, m.base_color_texture);
  add(hash, scene, m.metallic_roughness_texture);
  add(hash, scene, m.transmission_texture);
  return hash.hex();
}

void add_surroundings(ContentHash& hash, const Scene& scene, const World& world) {
  add(hash, world.positions);
  add(hash, world.normals);
  for (const std::vector<Vec2>& set : world.texcoords) add(hash, set);
  add(hash, world.triangles);
  std::vector<std::string> surfaces;
  for (const Material& material : scene.materials) surfaces.push_back(surface(scene, material));
  // By content, not by number: a material that nothing uses may come and go.
  for (std::size_t t = 0; t < world.size();) {
    std::size_t end = t + 1;
    while (end < world.size() && world.materials[end] == world.materials[t] &&
           world.instances[end] == world.instances[t])
      ++end;
    hash.value(end - t).text(surfaces[world.materials[t].value]);
    hash.value(scene[world.instances[t]].lightmap_scale);
    t = end;
  }
  for (const Camera& camera : scene.cameras) hash.value(camera.frame).value(camera.yfov).value(camera.aspect);
}

void add(ContentHash& hash, const Photometry& p) {
  hash.value(p.type).value(p.opening.shape).value(p.opening.axis).value(p.opening.size);
  add(hash, p.azimuths);
  add(hash, p.polars);
  add(hash, p.candela);
}

void add(ContentHash& hash, const LightField& f) {
  hash.value(f.basis).value(f.columns).value(f.rows).value(f.spacing).value(f.first).value(f.distance);
  hash.value(f.width).value(f.height).value(f.corner).value(f.pixel);
  add(hash, f.irradiance);
  add(hash, f.color);
}

void add_lamp(ContentHash& hash, const Scene& scene, const Light& light) {
  hash.value(light.shape.index()).value(light.frame).value(light.intensity);
  if (const auto* point = std::get_if<PointLight>(&light.shape)) hash.value(point->range);
  if (const auto* spot = std::get_if<SpotLight>(&light.shape))
    hash.value(spot->inner).value(spot->outer).value(spot->range);
  if (const auto* sky = std::get_if<SkyLight>(&light.shape)) {
    hash.value(sky->image.width).value(sky->image.height);
    add(hash, sky->image.data);
  }
  if (const auto* projector = std::get_if<ProjectorLight>(&light.shape)) {
    hash.value(projector->yfov).value(projector->aspect).value(projector->slide->width);
    add(hash, projector->slide->data);
  }
  if (const auto* measured = std::get_if<LuminaireLight>(&light.shape)) {
    const Luminaire& luminaire = scene[measured->luminaire];
    add(hash, luminaire.photometry);
    if (luminaire.field) add(hash.value(measured->exact_below), *luminaire.field);
  }
}

}  // namespace

std::vector<std::string> layer_inputs(const Scene& scene, const World& world, std::string_view how) {
  ContentHash surroundings;
  add_surroundings(surroundings, scene, world);
  std::vector<ContentHash> groups(scene.groups.size());
  for (ContentHash& hash : groups) hash.text(how).text(surroundings.hex());
  for (const Light& light : scene.lights) add_lamp(groups[light.group.value], scene, light);
  for (std::size_t t = 0; t < world.size();) {
    std::size_t end = t + 1;
    while (end < world.size() && world.instances[end] == world.instances[t]) ++end;
    const Material& material = scene[world.materials[t]];
    if (material.emits()) {
      ContentHash& hash = groups[scene[world.instances[t]].group.value];
      hash.value(t).value(end).value(material.emission);
      add(hash, scene, material.emission_texture);
    }
    t = end;
  }
  std::vector<std::string> result;
  for (const ContentHash& hash : groups) result.push_back(hash.hex());
  return result;
}

}  // namespace sconce
