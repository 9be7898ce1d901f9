// SPDX-License-Identifier: Apache-2.0
#include "session/to_scene.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "core/error.h"
#include "core/files.h"
#include "image/io.h"
#include "package/glb.h"

namespace fs = std::filesystem;

namespace sconce {

namespace {

constexpr const char* kHead = "# Written by sconce export --scene.\n";

/// Copies of what several groups share: the first of them takes the thing itself.
template <class T>
class Variants {
 public:
  explicit Variants(std::vector<T>& things) : things_(&things), originals_(things) {}
  struct Variant {
    Id<T> id;
    bool fresh;  ///< nobody has asked for it before
  };
  Variant of(Id<T> id, Id<LightGroup> group) {
    if (const auto known = made_.find({id.value, group.value}); known != made_.end())
      return {known->second, false};
    const bool first = taken_.insert(id.value).second;
    if (!first) things_->push_back(originals_[id.value]);
    const Id<T> own = first ? id : Id<T>(static_cast<uint32_t>(things_->size() - 1));
    made_.emplace(std::pair{id.value, group.value}, own);
    return {own, true};
  }

 private:
  std::vector<T>* things_;
  std::vector<T> originals_;
  std::map<std::pair<uint32_t, uint32_t>, Id<T>> made_;
  std::set<uint32_t> taken_;
};

/// `rest` is no name that a scene may give.
template <class T>
void unname_rest(T& thing, const Scene& scene) {
  if (thing.group && scene[thing.group].name == "rest") thing.group = {}, thing.group_name.clear();
}

}  // namespace

Scene relit_scene(Scene scene, const MixSpec& mix) {
  Variants<Mesh> meshes(scene.meshes);
  Variants<Material> materials(scene.materials);
  for (Instance& instance : scene.instances) {
    if (!instance.group || !scene.emits(instance)) continue;
    const auto mesh = meshes.of(instance.mesh, instance.group);
    instance.mesh = mesh.id;
    if (mesh.fresh) {
      const auto material = materials.of(scene[mesh.id].material, instance.group);
      scene.meshes[mesh.id.value].material = material.id;
      if (material.fresh) scene.materials[material.id.value].emission *= mix.weights.at(instance.group.value);
    }
  }
  for (Light& light : scene.lights)
    if (light.group) light.intensity *= mix.weights.at(light.group.value);
  std::erase_if(scene.lights, [](const Light& light) { return light.intensity.is_black(); });
  for (Instance& instance : scene.instances) unname_rest(instance, scene);
  for (Light& light : scene.lights) unname_rest(light, scene);
  return scene;
}

SceneFiles write_scene(const fs::path& glb, Scene scene, const std::string& generator) {
  const fs::path side = fs::path(glb).replace_extension(".toml"),
                 picture = fs::path(glb).replace_extension(".sky.exr");
  if (fs::exists(side) && !read_file(side).starts_with(kHead))
    throw Error(side.string(), "is a side file of somebody's own, so it is left alone",
                "another name for the scene");
  SceneFiles out;
  for (const Luminaire& luminaire : scene.luminaires)
    if (luminaire.field)
      out.warnings.push_back("luminaire '" + luminaire.name +
                             "' lights as from far: glTF holds no light field");
  std::string text = kHead;
  std::optional<Beside> sky;
  for (const Light& light : scene.lights) {
    const auto* shape = std::get_if<SkyLight>(&light.shape);
    if (shape == nullptr) continue;
    Image radiance = shape->image;
    for (std::size_t i = 0; i < radiance.data.size(); ++i) radiance.data[i] *= (&light.intensity.r)[i % 3];
    sky.emplace(picture);
    sky->fill([&](const fs::path& path) { write_exr(path, radiance, PixelType::full); });
    out.files.push_back(picture);
    const Vec3 z(light.frame[2]);
    const std::string group = light.group ? scene[light.group].name : "sky";
    text += fmt::format("\n[sky]\nfile = {}\nrotate = {}\ngroup = {}\n",
                        nlohmann::json(picture.filename().string()).dump(),
                        glm::degrees(std::atan2(z.x, z.z)), nlohmann::json(group).dump());
  }
  std::erase_if(scene.lights, [](const Light& l) { return std::holds_alternative<SkyLight>(l.shape); });
  // All is written before the first is put in place.
  Beside beside(glb);
  beside.fill([&](const fs::path& path) { write_file(path, write_glb(scene, generator)); });
  write_file(side, text);
  if (sky) sky->commit();
  beside.commit();
  out.files.insert(out.files.begin(), {glb, side});
  return out;
}

std::string shader_left_out(const std::string& lamp) {
  return "lamp '" + lamp + "' is left out: glTF holds no light shaders";
}

}  // namespace sconce
