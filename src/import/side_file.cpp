// SPDX-License-Identifier: Apache-2.0
#include "core/error.h"
#include "core/text.h"
#include "import/import.h"
#include "import/side_parts.h"

namespace sconce {

namespace {

template <class Named>
std::vector<std::string> names_of(const std::vector<Named>& all) {
  std::vector<std::string> out;
  out.reserve(all.size());
  for (const Named& item : all) out.push_back(item.name);
  return out;
}

using Apply = void (*)(const SideContext&, const SideNode&);

void for_each_table(const SideContext& context, const SideNode& root, std::string_view key, Apply apply) {
  for (const SideNode* node : side_tables(root, key)) apply(context, *node);
}

}  // namespace

std::vector<const SideNode*> side_tables(const SideNode& root, std::string_view key) {
  const SideNode* node = root.find(key);
  if (node == nullptr) return {};
  std::vector<const SideNode*> tables;
  if (const auto* array = std::get_if<SideNode::Array>(&node->value))
    for (const SideNode& item : *array) tables.push_back(&item);
  else
    tables.push_back(node);
  return tables;
}

std::vector<std::string> node_names(const Scene& scene) {
  return names_of(scene.instances);
}
std::vector<std::string> light_names(const Scene& scene) {
  return names_of(scene.lights);
}
std::vector<std::string> material_names(const Scene& scene) {
  return names_of(scene.materials);
}

std::vector<std::size_t> matching(const SideContext& context, const SideTable& table, std::string_view key,
                                  const std::string& glob, std::span<const std::string> names) {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (glob_match(glob, names[i])) out.push_back(i);
  if (out.empty()) {
    context.progress.warn(table.where(key) + ": '" + glob + "' matches nothing" + did_you_mean(glob, names));
  }
  return out;
}

Mat4 looking(const Vec3& position, const Vec3& direction, const Vec3& up) {
  const Vec3 z = -normalize_or(direction, Vec3(0, 0, -1));
  const Vec3 x = normalize_or(glm::cross(up, z), Frame(z).x);
  Mat4 out(1.0f);
  out[0] = glm::vec4(x, 0);
  out[1] = glm::vec4(glm::cross(z, x), 0);
  out[2] = glm::vec4(z, 0);
  out[3] = glm::vec4(position, 1);
  return out;
}

void apply_side_file(const std::filesystem::path& path, Scene& scene, const Progress& progress) {
  const SideNode root = parse_side_file(path);
  const SideTable file(path.string(), "the side file", root,
                       {"scene", "light", "luminaire", "group", "emission", "camera", "sun", "sky",
                        "material", "plane", "options"});
  const SideContext context{path, scene, progress};
  if (const SideNode* whole = root.find("scene")) apply_scene(context, *whole);
  // Groups come last: they also name lamps that this file adds.
  for_each_table(context, root, "material", apply_material);
  for_each_table(context, root, "emission", apply_emission);
  for_each_table(context, root, "light", apply_light);
  for_each_table(context, root, "luminaire", apply_luminaire);
  std::optional<Vec3> sun;
  if (const SideNode* table = root.find("sun")) sun = apply_sun(context, *table);
  if (const SideNode* sky = root.find("sky")) apply_sky(context, *sky, sun);
  for_each_table(context, root, "camera", apply_camera);
  if (const SideNode* groups = root.find("group")) {
    const auto* tables = std::get_if<SideNode::Table>(&groups->value);
    if (tables == nullptr) file.fail("group", "is no table of groups", "[group.NAME]");
    for (const auto& [name, node] : *tables) apply_group(context, name, node);
  }
  if (const SideNode* options = root.find("options");
      options && !std::holds_alternative<SideNode::Table>(options->value))
    file.fail("options", "is no table", "[options]");
}

}  // namespace sconce
