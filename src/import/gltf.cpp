// SPDX-License-Identifier: Apache-2.0
#include "core/error.h"
#include "import/gltf_parts.h"
#include "import/import.h"

namespace sconce {

Error gltf_range_error(const GltfSource& source, int index, std::size_t size, const std::string& place) {
  return Error(source.at(place), "index " + std::to_string(index) + " is out of range",
               "0 to " + std::to_string(size) + " exclusive");
}

std::optional<std::vector<double>> numbers(const GltfSource& source, const std::vector<double>& given,
                                           std::size_t n, const std::string& place) {
  if (given.empty()) return std::nullopt;
  if (given.size() != n)
    throw Error(source.at(place), "has " + std::to_string(given.size()) + " numbers", std::to_string(n));
  return given;
}

std::string extra_string(const tinygltf::Value& extras, const char* key) {
  if (!extras.IsObject() || !extras.Has(key) || !extras.Get(key).IsString()) return {};
  return extras.Get(key).Get<std::string>();
}

const tinygltf::Value* extension(const tinygltf::ExtensionMap& extensions, const char* name) {
  const auto found = extensions.find(name);
  return found != extensions.end() && found->second.IsObject() ? &found->second : nullptr;
}

double number_of(const tinygltf::Value& object, const char* key, double otherwise) {
  return object.Has(key) && object.Get(key).IsNumber() ? object.Get(key).GetNumberAsDouble() : otherwise;
}

Scene import_gltf(const std::filesystem::path& path, const Progress& progress) {
  const GltfSource source = open_gltf(path, progress);
  Scene scene;
  scene.name = path.stem().string();
  read_gltf_materials(source, scene, progress);
  const GltfMeshes meshes = read_gltf_meshes(source, scene, progress);
  read_gltf_nodes(source, meshes, scene, progress);
  return scene;
}

}  // namespace sconce
