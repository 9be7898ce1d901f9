// SPDX-License-Identifier: Apache-2.0
#include "mix/settings.h"
#include "runtime/handles.h"

using namespace sconce;

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
    for (const Rgb& w : mix.weights)
      for (const float c : {w.r, w.g, w.b}) *weights++ = c;
  });
}

int sconce_package_mix(sconce_package* package, const float* weights, char* message, size_t message_size) {
  return guarded(message, message_size, [&] {
    MixSpec mix;
    for (std::size_t g = 0; g < sconce_package_group_count(package); ++g, weights += 3)
      mix.weights.emplace_back(weights[0], weights[1], weights[2]);
    if (!package->mixer) package->mixer = std::make_unique<Mixer>(package->package);
    package->mixed = &package->mixer->mix(mix);
  });
}

const float* sconce_package_mixed(const sconce_package* package, int page) {
  if (package->mixed == nullptr || page < 0 || page >= package->package.manifest().pages) return nullptr;
  return (*package->mixed)[static_cast<std::size_t>(page)].data.data();
}
