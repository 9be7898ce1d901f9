// SPDX-License-Identifier: Apache-2.0
// The parts of glTF that become parts of a Scene. Each fills its own vectors; gltf.cpp calls them in order.
#pragma once

#include <optional>
#include <vector>

#include "import/gltf_source.h"
#include "scene/scene.h"

namespace sconce {

Error gltf_range_error(const GltfSource& source, int index, std::size_t size, const std::string& place);

/// Index-checked element of one of the model's vectors. @throws Error naming place and range
template <class T>
const T& element(const GltfSource& source, const std::vector<T>& all, int index, const std::string& place) {
  if (index < 0 || static_cast<std::size_t>(index) >= all.size())
    throw gltf_range_error(source, index, all.size(), place);
  return all[static_cast<std::size_t>(index)];
}

/// Scene.materials, index by index; the textures that their slots use, decoded; samplers.
void read_gltf_materials(const GltfSource& source, Scene& scene, const Progress& progress);

/// The primitives of every glTF mesh as Scene meshes; what holds no triangles has none.
struct GltfMeshes {
  std::vector<std::vector<Id<Mesh>>> of;  ///< per glTF mesh
};
GltfMeshes read_gltf_meshes(const GltfSource& source, Scene& scene, const Progress& progress);

/// A node as its instances, lamps and cameras see it; `light_group` and `lightmap_scale` come down from its
/// ancestors.
struct GltfNode {
  std::string name;
  Mat4 transform{1.0f};
  std::string light_group, light_name;
  float lightmap_scale = 1;
};

/// Walks the scene's node tree: instances, cameras and lamps in file order. @throws Error on cycles and bad
/// indices
void read_gltf_nodes(const GltfSource& source, const GltfMeshes& meshes, Scene& scene,
                     const Progress& progress);

/// Position and direction without the node's scale: KHR_lights_punctual says that scale does not touch lamps.
Mat4 rigid(const Mat4& node);

/// KHR_lights_punctual lamp `index` at a node.
Light read_gltf_light(const GltfSource& source, int index, const GltfNode& node, const std::string& place);

/// Numbers of a JSON array of exactly n, or nothing where the array is absent. @throws Error on another
/// length
std::optional<std::vector<double>> numbers(const GltfSource& source, const std::vector<double>& given,
                                           std::size_t n, const std::string& place);

/// A string of `extras`, "" where absent.
std::string extra_string(const tinygltf::Value& extras, const char* key);

/// An extension's value, or nothing.
const tinygltf::Value* extension(const tinygltf::ExtensionMap& extensions, const char* name);

/// A number in an extension object, or `otherwise`.
double number_of(const tinygltf::Value& object, const char* key, double otherwise);

}  // namespace sconce
