// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <mutex>

#include "import/import.h"
#include "info.h"
#include "light/lamp.h"
#include "scene/groups.h"
#include "table.h"

namespace sconce::app {

namespace {

using Json = nlohmann::ordered_json;

std::size_t instanced_triangles(const Scene& scene) {
  std::size_t count = 0;
  for (const Instance& instance : scene.instances) count += scene[instance.mesh].triangles.size();
  return count;
}

void add_groups(const Scene& scene, const World& world, InfoReport& report) {
  const Lamps lamps(scene, world);
  const std::vector<GroupFlux> fluxes = group_flux(scene, lamps);
  Table table({{"GROUP"}, {"LUMENS", Table::Align::right}, {"COLOUR"}, {"LAMPS", Table::Align::right}, {""}});
  Json& groups = report.json["groups"] = Json::array();
  for (std::size_t g = 0; g < scene.groups.size(); ++g) {
    const GroupFlux& flux = fluxes[g];
    table.add({scene.groups[g].name, flux.infinite ? "-" : grouped(flux.lumens, flux.lumens < 100 ? 1 : 0),
               hex_color(flux.color), std::to_string(flux.lamps.size()), some_names(flux.lamps)});
    groups.push_back({{"name", scene.groups[g].name},
                      {"lumens", flux.infinite ? Json() : Json(flux.lumens)},
                      {"color", json_of(flux.color)},
                      {"color_spread", flux.spread},
                      {"lamps", flux.lamps}});
  }
  report.text += fmt::format("light groups  {}\n", scene.groups.size());
  if (!scene.groups.empty()) report.text += table.text();
}

void add_cameras(const Scene& scene, InfoReport& report) {
  Json& cameras = report.json["cameras"] = Json::array();
  std::vector<std::string> names;
  for (const Camera& camera : scene.cameras) {
    names.push_back(camera.name);
    cameras.push_back({{"name", camera.name},
                       {"position", json_of(Vec3(camera.frame[3]))},
                       {"fov_degrees", glm::degrees(camera.yfov)},
                       {"aspect", camera.aspect}});
  }
  report.text += fmt::format("cameras       {}\n", names.empty() ? "none" : some_names(names, 8));
}

void add_options(const std::filesystem::path& scene_path, InfoReport& report) {
  Json& options = report.json["options"] = Json::object();
  Table table({{"OPTION"}, {"VALUE"}, {"FROM"}});
  for (const auto& [name, option] : bake_options(scene_path)) {
    table.add({name, option.value, option.source});
    options[name] = {{"value", option.value}, {"source", option.source}};
  }
  report.text += "options of bake\n" + table.text();
}

}  // namespace

InfoReport scene_info(const std::filesystem::path& path, const std::string& groups, bool options,
                      const Progress& progress) {
  const Grouping grouping = parse_grouping(groups);
  std::vector<std::string> warnings;
  std::mutex mutex;
  Progress noting = progress;
  noting.warning = [&](const std::string& line) {
    const std::lock_guard lock(mutex);
    warnings.push_back(line);
    progress.warn(line);
  };
  Scene scene = import_scene(path, noting);
  assign_groups(scene, grouping);
  World world;
  if (instanced_triangles(scene) > 0)
    world = make_world(scene);
  else
    noting.warn(path.string() + ": the scene has no triangles, so there is nothing to bake");

  InfoReport report;
  const Bounds& box = world.bounds;
  report.json = {{"kind", "scene"},
                 {"file", path.string()},
                 {"meshes", scene.meshes.size()},
                 {"instances", scene.instances.size()},
                 {"triangles", instanced_triangles(scene)},
                 {"materials", scene.materials.size()},
                 {"textures", scene.textures.size()}};
  if (!box.empty()) report.json["bounds"] = {{"min", json_of(box.lo)}, {"max", json_of(box.hi)}};
  const auto mapped = std::count_if(scene.materials.begin(), scene.materials.end(),
                                    [](const Material& m) { return m.normal_texture.texture.valid(); });
  report.json["normal_maps"] = mapped;
  report.text = fmt::format("scene         {}\n", path.filename().string());
  report.text += fmt::format("geometry      {} triangles in {} instances of {} meshes\n",
                             grouped(static_cast<double>(instanced_triangles(scene))), scene.instances.size(),
                             scene.meshes.size());
  report.text +=
      fmt::format("surfaces      {} materials, {} textures\n", scene.materials.size(), scene.textures.size());
  if (mapped > 0)
    report.text += fmt::format("normal maps   of {} materials; `bake --basis sh1` makes them seen\n", mapped);
  if (!box.empty())
    report.text += fmt::format("size          {:.2f} x {:.2f} x {:.2f} m, from ({:.2f}, {:.2f}, {:.2f})\n",
                               box.hi.x - box.lo.x, box.hi.y - box.lo.y, box.hi.z - box.lo.z, box.lo.x,
                               box.lo.y, box.lo.z);
  add_cameras(scene, report);
  add_groups(scene, world, report);
  if (options) add_options(path, report);
  report.json["warnings"] = warnings;
  return report;
}

}  // namespace sconce::app
