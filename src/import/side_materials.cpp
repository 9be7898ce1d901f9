// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <map>

#include "core/text.h"
#include "import/side_parts.h"
#include "scene/world.h"

namespace sconce {

namespace {

/// Area-weighted sum of the emission texture over what the material covers, m2; both sides where both emit.
Rgb emitting_area(const Scene& scene, Id<Material> id) {
  constexpr int kSteps = 4;  // 16 points per triangle where a texture varies
  const Material& m = scene[id];
  double sum[3] = {0, 0, 0};
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene[instance.mesh];
    if (mesh.material != id) continue;
    const auto at = [&](uint32_t v) { return Vec3(instance.transform * glm::vec4(mesh.positions[v], 1)); };
    for (const Triangle& t : mesh.triangles) {
      const Vec3 p = at(t.v[0]);
      const double area = 0.5 * static_cast<double>(glm::length(glm::cross(at(t.v[1]) - p, at(t.v[2]) - p)));
      if (!std::isfinite(area)) continue;
      Rgb mean(1);
      const uint32_t set = m.emission_texture.texcoord;
      if (m.emission_texture.texture && set < mesh.texcoords.size() && !mesh.texcoords[set].empty()) {
        mean = Rgb(0);
        const auto& uv = mesh.texcoords[set];
        for (int i = 0; i < kSteps * kSteps; ++i) {
          float a = (static_cast<float>(i % kSteps) + 0.5f) / kSteps,
                b = (static_cast<float>(i / kSteps) + 0.5f) / kSteps;
          if (a + b > 1) a = 1 - a, b = 1 - b;
          mean += sample_texture(scene, m.emission_texture,
                                 (1 - a - b) * uv[t.v[0]] + a * uv[t.v[1]] + b * uv[t.v[2]], true)
                      .rgb;
        }
        mean *= 1.0f / (kSteps * kSteps);
      }
      sum[0] += area * static_cast<double>(mean.r), sum[1] += area * static_cast<double>(mean.g),
          sum[2] += area * static_cast<double>(mean.b);
    }
  }
  const Rgb area(static_cast<float>(sum[0]), static_cast<float>(sum[1]), static_cast<float>(sum[2]));
  return m.double_sided ? area * 2.0f : area;
}

/// Gives the matched instances materials of their own, so that others with the same material stay as they
/// are.
std::vector<Id<Material>> own_materials(Scene& scene, const std::vector<std::size_t>& instances) {
  std::map<Id<Mesh>, Id<Mesh>> meshes;
  std::map<Id<Material>, Id<Material>> materials;
  for (const std::size_t i : instances) {
    const Id<Mesh> old = scene.instances[i].mesh;
    if (!meshes.contains(old)) {
      Mesh copy = scene[old];
      if (!materials.contains(copy.material)) {
        materials[copy.material] = Id<Material>(scene.materials.size());
        scene.materials.push_back(Material(scene[copy.material]));
      }
      copy.material = materials[copy.material];
      meshes[old] = Id<Mesh>(scene.meshes.size());
      scene.meshes.push_back(std::move(copy));
    }
    scene.instances[i].mesh = meshes[old];
  }
  std::vector<Id<Material>> out;
  for (const auto& [old, own] : materials) out.push_back(own);
  return out;
}

/// Materials that an [[emission]] entry means, and the instances that wear them.
struct Emitters {
  std::vector<Id<Material>> materials;
  std::vector<std::size_t> instances;
};

Emitters emitters(const SideContext& context, const SideTable& table) {
  Scene& scene = context.scene;
  const auto material = table.text("material"), node = table.text("node");
  if (!material && !node) table.fail({}, "names nothing", "material = \"glob\" or node = \"glob\"");
  Emitters out;
  if (material)
    for (const std::size_t i : matching(context, table, "material", *material, material_names(scene)))
      out.materials.emplace_back(i);
  const auto wears = [&](std::size_t i) {
    const Id<Material> id = scene[scene.instances[i].mesh].material;
    return std::find(out.materials.begin(), out.materials.end(), id) != out.materials.end();
  };
  if (node) {
    for (const std::size_t i : matching(context, table, "node", *node, node_names(scene)))
      if (!material || wears(i)) out.instances.push_back(i);
    out.materials = own_materials(scene, out.instances);
  } else {
    for (std::size_t i = 0; i < scene.instances.size(); ++i)
      if (wears(i)) out.instances.push_back(i);
  }
  return out;
}

}  // namespace

void apply_material(const SideContext& context, const SideNode& node) {
  const SideTable table(context.path.string(), "[[material]]", node,
                        {"match", "base_color", "metallic", "roughness", "transmission", "double_sided"});
  const auto glob = table.text("match");
  if (!glob) table.fail({}, "names no material", "match = \"glob\"");
  const auto base = table.color("base_color");
  if (base && base->max() > 1) table.fail("base_color", "reflects more than it gets", "0 to 1");
  const auto share = [&](const char* key) {
    const auto value = table.not_negative(key);
    if (value && *value > 1) table.fail(key, "is out of range", "0 to 1");
    return value;
  };
  const auto metallic = share("metallic"), roughness = share("roughness"),
             transmission = share("transmission");
  for (const std::size_t i : matching(context, table, "match", *glob, material_names(context.scene))) {
    Material& m = context.scene.materials[i];
    if (base) m.base_color = *base;
    if (metallic) m.metallic = static_cast<float>(*metallic);
    if (roughness) m.roughness = static_cast<float>(*roughness);
    if (transmission) m.transmission = static_cast<float>(*transmission);
    if (const auto sides = table.flag("double_sided")) m.double_sided = *sides;
  }
}

void apply_emission(const SideContext& context, const SideNode& node) {
  const SideTable table(context.path.string(), "[[emission]]", node,
                        {"material", "node", "luminance", "radiance", "lumens", "color", "kelvin", "group"});
  if (table.has("luminance") + table.has("radiance") + table.has("lumens") > 1)
    table.fail("lumens", "stands beside luminance", "one of luminance (also called radiance), lumens");
  const auto level = table.has("radiance") ? table.not_negative("radiance") : table.not_negative("luminance");
  const auto lumens = table.not_negative("lumens");
  const auto color = table.lamp_color();
  const auto group = table.text("group");
  if (!level && !lumens && !color && !group)
    table.fail({}, "says nothing", "luminance in cd/m2, lumens, color, kelvin, group");

  Scene& scene = context.scene;
  const Emitters on = emitters(context, table);
  float flux_of_one = 0;  // lumens of all of them together at 1 cd/m2
  std::vector<Rgb> tones;
  for (const Id<Material> id : on.materials) {
    const Material& m = scene[id];
    const float before = luminance(m.emission);
    if (!level && !lumens && color && before <= 0)
      context.progress.warn(table.where() + ": material '" + m.name +
                            "' does not shine, so it cannot be given a colour");
    tones.push_back(color ? *color : before > 0 ? m.emission / before : Rgb(1));
    if (lumens) flux_of_one += kPi * luminance(emitting_area(scene, id) * tones.back());
  }
  if (lumens && *lumens > 0 && !on.materials.empty() && !(flux_of_one > 0))
    table.fail("lumens", "cannot be spread: what it names has no area");
  for (std::size_t i = 0; i < on.materials.size(); ++i) {
    Material& m = scene.materials[on.materials[i].value];
    float strength = luminance(m.emission);
    if (level) strength = static_cast<float>(*level);
    if (lumens) strength = *lumens > 0 ? static_cast<float>(*lumens) / flux_of_one : 0.0f;
    m.emission = tones[i] * strength;
  }
  if (group)
    for (const std::size_t i : on.instances) scene.instances[i].group_name = *group;
}

void apply_group(const SideContext& context, const std::string& name, const SideNode& node) {
  const SideTable table(context.path.string(), "[group." + name + "]", node,
                        {"nodes", "lights", "materials"});
  if (name == "all" || name.empty()) table.fail({}, "has a reserved name", "any name but all");
  Scene& scene = context.scene;
  for (const std::string& glob : table.list("nodes"))
    for (const std::size_t i : matching(context, table, "nodes", glob, node_names(scene)))
      scene.instances[i].group_name = name;
  for (const std::string& glob : table.list("lights"))
    for (const std::size_t i : matching(context, table, "lights", glob, light_names(scene)))
      scene.lights[i].group_name = name;
  for (const std::string& glob : table.list("materials")) {
    for (const std::size_t m : matching(context, table, "materials", glob, material_names(scene)))
      for (Instance& instance : scene.instances)
        if (scene[instance.mesh].material == Id<Material>(m)) instance.group_name = name;
  }
}

}  // namespace sconce
