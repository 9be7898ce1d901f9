// SPDX-License-Identifier: Apache-2.0
#include <glm/gtc/type_ptr.hpp>

#include "core/error.h"
#include "mix/settings.h"
#include "runtime/handles.h"

using namespace sconce;

namespace {

std::vector<Rgb> weights_of(const sconce_package* package, const float* weights) {
  std::vector<Rgb> out;
  for (size_t g = 0; g < sconce_package_group_count(package); ++g, weights += 3)
    out.emplace_back(weights[0], weights[1], weights[2]);
  return out;
}

/// @throws Error: there are none, or they are damaged
const ProbeGrid& probes_of(sconce_package* package) {
  if (!package->probes) package->probes = read_probes(package->package);
  if (!package->probes)
    throw Error(package->package.path().string(), "has no probes", "sconce bake --probes 1");
  return *package->probes;
}

float* put(float* out, const Rgb& c) {
  for (const float v : {c.r, c.g, c.b}) *out++ = v;
  return out;
}

}  // namespace

const char* sconce_version(void) {
  return SCONCE_VERSION;
}

sconce_package* sconce_package_open(const char* path, char* message, size_t message_size) {
  sconce_package* opened = nullptr;
  guarded(message, message_size, [&] { opened = new sconce_package{Package::open(path)}; });
  return opened;
}

void sconce_package_close(sconce_package* package) {
  delete package;
}

sconce_atlas sconce_package_atlas(const sconce_package* package) {
  const Manifest& m = package->package.manifest();
  return {m.width, m.height, m.pages, static_cast<int>(m.lightmap_set), m.instance_pages.size()};
}

int sconce_package_page(const sconce_package* package, size_t node) {
  const std::vector<int>& pages = package->package.manifest().instance_pages;
  return node < pages.size() ? pages[node] : -1;
}

size_t sconce_package_group_count(const sconce_package* package) {
  return package->package.manifest().groups.size();
}

int sconce_package_group(const sconce_package* package, size_t index, sconce_group* group) {
  const std::vector<GroupInfo>& groups = package->package.manifest().groups;
  if (index >= groups.size()) return 1;
  const GroupInfo& g = groups[index];
  *group = {g.name.c_str(), g.lumens, g.mean_lux, {g.color.r, g.color.g, g.color.b}, g.infinite ? 1 : 0};
  return 0;
}

int sconce_package_weights(const sconce_package* package, const char* const* settings, size_t count,
                           const char* others, float* weights, char* message, size_t message_size) {
  return guarded(message, message_size, [&] {
    const std::vector<std::string> words(settings, settings + count);
    const MixSpec mix = make_mix(package->package.manifest().groups, words, others == nullptr ? "" : others,
                                 [](const std::string&) {});
    for (const Rgb& w : mix.weights) weights = put(weights, w);
  });
}

int sconce_package_mix(sconce_package* package, const float* weights, char* message, size_t message_size) {
  return guarded(message, message_size, [&] {
    if (!package->mixer) package->mixer = std::make_unique<Mixer>(package->package);
    package->mixed = &package->mixer->mix({weights_of(package, weights)});
  });
}

const float* sconce_package_mixed(const sconce_package* package, int page) {
  if (package->mixed == nullptr || page < 0 || page >= package->package.manifest().pages) return nullptr;
  return (*package->mixed)[static_cast<std::size_t>(page)].data.data();
}

int sconce_package_probes(sconce_package* package, sconce_probes* probes, char* message,
                          size_t message_size) {
  return guarded(message, message_size, [&] {
    const ProbeGrid& grid = probes_of(package);
    *probes = {{grid.origin.x, grid.origin.y, grid.origin.z},
               grid.spacing,
               {grid.size[0], grid.size[1], grid.size[2]}};
  });
}

int sconce_probe_light(sconce_package* package, const float* weights, const float position[3],
                       float light[12], char* message, size_t message_size) {
  return guarded(message, message_size, [&] {
    for (const Rgb& k : probes_of(package).mixed(glm::make_vec3(position), weights_of(package, weights)))
      light = put(light, k);
  });
}

int sconce_probe_irradiance(sconce_package* package, const float* weights, const float position[3],
                            const float normal[3], float rgb[3], char* message, size_t message_size) {
  return guarded(message, message_size, [&] {
    put(rgb, probes_of(package).illuminance(glm::make_vec3(position), glm::make_vec3(normal),
                                            weights_of(package, weights)));
  });
}
