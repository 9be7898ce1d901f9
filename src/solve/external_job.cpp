// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/files.h"
#include "image/io.h"
#include "package/glb.h"
#include "solve/external.h"

namespace sconce {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

/// The baked scene with only this group's lamps; what emitted for others stays as dark geometry.
Scene only(Scene scene, Id<LightGroup> group) {
  std::vector<Id<Material>> dark(scene.materials.size());
  for (const Instance& instance : scene.instances) {
    if (!scene.emits(instance) || instance.group == group) continue;
    Id<Material>& material = scene.meshes[instance.mesh.value].material;  // one mesh per instance here
    Id<Material>& without = dark[material.value];
    if (!without.valid()) {
      Material copy = scene[material];
      copy.emission = Rgb();
      copy.emission_texture = {};
      scene.materials.push_back(std::move(copy));
      without = Id<Material>(scene.materials.size() - 1);
    }
    material = without;
  }
  std::erase_if(scene.lights, [&](const Light& light) { return light.group != group; });
  return scene;
}

Json numbers(const Rgb& c) {
  return {c.r, c.g, c.b};
}
Json numbers(const Mat4& m) {
  Json out = Json::array();
  for (int i = 0; i < 16; ++i) out.push_back(m[i / 4][i % 4]);
  return out;
}

/// glTF knows no sky, so it travels beside it.
Json write_skies(const Scene& scene, const fs::path& folder) {
  Json skies = Json::array();
  for (const Light& light : scene.lights) {
    const auto* sky = std::get_if<SkyLight>(&light.shape);
    if (sky == nullptr) continue;
    Json entry = {
        {"radiance", numbers(light.intensity)}, {"image", nullptr}, {"frame", numbers(light.frame)}};
    if (!sky->image.data.empty()) {
      const fs::path file = folder / fmt::format("sky.{}.exr", skies.size());
      write_exr(file, sky->image, PixelType::full);
      entry["image"] = file.string();
    }
    skies.push_back(std::move(entry));
  }
  return skies;
}

}  // namespace

ExternalJob write_external_job(const SolveContext& context, const BakeParams& params, Id<LightGroup> group,
                               const fs::path& folder) {
  ExternalJob job{fs::absolute(folder), {}, {}};
  std::error_code ec;
  fs::remove_all(job.folder, ec);
  fs::create_directories(job.folder, ec);
  if (ec) throw Error(job.folder.string(), "cannot be made: " + ec.message());
  job.file = job.folder / "job.json";
  for (int p = 0; p < context.atlas->pages; ++p)
    job.outputs.push_back(job.folder / fmt::format("page.{}.exr", p));

  BakedScene baked = make_baked_scene(context.scene, context.world, *context.atlas);
  Json instances = Json::array();
  for (std::size_t i = 0; i < baked.pages.size(); ++i)
    instances.push_back({{"node", i}, {"page", baked.pages[i]}, {"twin_of", nullptr}});
  for (std::size_t i = 0; i < baked.twins.size(); ++i)
    if (baked.twins[i].valid()) instances[baked.twins[i].value]["twin_of"] = i;
  const Scene scene = only(std::move(baked.scene), group);
  const fs::path glb = job.folder / "scene.glb";
  write_file(glb, write_glb(scene, "sconce"));

  Json outputs = Json::array();
  for (const fs::path& file : job.outputs) outputs.push_back(file.string());
  const Json json = {{"version", 1},
                     {"group", context.scene[group].name},
                     {"scene", glb.string()},
                     {"sky", write_skies(scene, job.folder)},
                     {"lightmap_set", baked.lightmap_set},
                     {"width", context.atlas->width},
                     {"height", context.atlas->height},
                     {"pages", context.atlas->pages},
                     {"instances", std::move(instances)},
                     {"samples", params.samples},
                     {"bounces", params.bounces},
                     {"seed", params.seed},
                     {"unit", "lux"},
                     {"outputs", std::move(outputs)}};
  write_file(job.file, json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  return job;
}

}  // namespace sconce
