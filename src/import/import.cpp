// SPDX-License-Identifier: Apache-2.0
#include "import/import.h"

#include "core/error.h"
#include "core/text.h"
#include "import/assimp_materials.h"
#include "import/gltf_source.h"
#include "import/mtl.h"
#include "import/side_parts.h"
#include "scene/validate.h"

namespace fs = std::filesystem;

namespace sconce {

namespace {

struct Format {
  const char* name;
  Scene (*read)(const fs::path&, const Progress&);
  std::vector<fs::path> (*files)(const fs::path&);  ///< that it names and that are there
};

constexpr Format kFormats[] = {
    {"glTF 2.0 (.gltf, .glb)", import_gltf, gltf_files},
    {"OBJ (.obj)", import_obj, obj_files},
    {"3DS, FBX, COLLADA, PLY, STL (.3ds, .fbx, .dae, .ply, .stl)", import_assimp, assimp_files},
    {"L3D (.l3d, structure.xml)", import_l3d, l3d_files},
    {"Blender (.blend)", import_blend, [](const fs::path&) { return std::vector<fs::path>(); }},
};

Scene read_any(const fs::path& path, const Progress& progress) {
  std::vector<std::string> names;
  for (const Format& format : kFormats) {
    try {
      return format.read(path, progress);
    } catch (const NotMyFormat&) {
      names.emplace_back(format.name);
    }
  }
  throw Error(path.string(), "is in no format that can be read", join(names, ", "));
}

std::vector<fs::path> files_of_any(const fs::path& path) {
  for (const Format& format : kFormats) {
    try {
      return format.files(path);
    } catch (const NotMyFormat&) {
    }
  }
  return {};
}

}  // namespace

std::span<const std::string_view> scene_endings() {
  static constexpr std::string_view kEndings[] = {".glb", ".gltf", ".obj", ".fbx", ".dae",
                                                  ".3ds", ".ply",  ".stl", ".l3d", ".blend"};
  return kEndings;
}

std::optional<fs::path> side_file_of(const fs::path& scene) {
  fs::path side = scene;
  side.replace_extension(".toml");
  std::error_code ec;
  if (side == scene || !fs::is_regular_file(side, ec)) return std::nullopt;
  return side;
}

Scene import_scene(const fs::path& path, const Progress& progress) {
  Scene scene = read_any(path, progress);
  if (const auto side = side_file_of(path)) apply_side_file(*side, scene, progress);
  add_default_sky(scene, progress);
  validate(scene, progress);
  return scene;
}

std::vector<fs::path> scene_files(const fs::path& path) {
  std::vector<fs::path> out = files_of_any(path);
  const auto side = side_file_of(path);
  if (!side) return out;
  out.push_back(*side);
  const SideNode root = parse_side_file(*side);
  const auto add_file = [&](const SideNode* table) {
    const SideNode* file = table != nullptr ? table->find("file") : nullptr;
    const auto* name = file != nullptr ? std::get_if<std::string>(&file->value) : nullptr;
    std::error_code ec;
    if (name != nullptr && fs::is_regular_file(side->parent_path() / *name, ec))
      out.push_back(side->parent_path() / *name);
  };
  add_file(root.find("sky"));
  for (const char* key : {"light", "luminaire"})
    for (const SideNode* table : side_tables(root, key)) add_file(table);
  return out;
}

}  // namespace sconce
