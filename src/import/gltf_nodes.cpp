// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <glm/gtc/quaternion.hpp>

#include "core/error.h"
#include "import/gltf_accessor.h"
#include "import/gltf_luminaires.h"
#include "import/gltf_parts.h"

namespace sconce {

namespace {

constexpr std::string_view kGroupPrefix = "group:";
constexpr float kNoAspect = 16.0f / 9;  // glTF: the viewport's; ours is decided when rendering

Vec3 vector_of(const std::vector<double>& v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

Mat4 local_transform(const GltfSource& source, const tinygltf::Node& node, const std::string& place) {
  if (const auto m = numbers(source, node.matrix, 16, place + ".matrix")) {
    Mat4 out;
    for (int i = 0; i < 16; ++i) out[i / 4][i % 4] = static_cast<float>((*m)[static_cast<std::size_t>(i)]);
    return out;
  }
  Mat4 out(1.0f);
  if (const auto t = numbers(source, node.translation, 3, place + ".translation"))
    out[3] = glm::vec4(vector_of(*t), 1);
  if (const auto r = numbers(source, node.rotation, 4, place + ".rotation")) {
    const glm::dquat q((*r)[3], (*r)[0], (*r)[1], (*r)[2]);
    if (glm::length(q) > 1e-12) out = out * Mat4(glm::mat4_cast(glm::normalize(q)));
  }
  if (const auto s = numbers(source, node.scale, 3, place + ".scale")) {
    const Vec3 scale = vector_of(*s);
    for (int i = 0; i < 3; ++i) out[i] *= scale[i];
  }
  return out;
}

GltfNode enter(const GltfSource& source, const tinygltf::Node& node, const GltfNode& parent,
               const std::string& place) {
  GltfNode out = parent;
  out.name = node.name;
  out.transform = parent.transform * local_transform(source, node, place);
  if (node.name.starts_with(kGroupPrefix)) out.light_group = node.name.substr(kGroupPrefix.size());
  if (const std::string group = extra_string(node.extras, "light_group"); !group.empty())
    out.light_group = group;
  out.light_name = extra_string(node.extras, "light");
  if (node.extras.IsObject()) {
    const double scale = number_of(node.extras, "lightmap_scale", parent.lightmap_scale);
    if (!(scale > 0))
      throw Error(source.at(place + ".extras.lightmap_scale"), "is not positive", "a factor > 0");
    out.lightmap_scale = static_cast<float>(scale);
  }
  return out;
}

/// Where a node's mesh stands in the node: once, or as EXT_mesh_gpu_instancing says.
std::vector<Mat4> copies(const GltfSource& source, const tinygltf::Node& node, const std::string& place) {
  const tinygltf::Value* instancing = extension(node.extensions, "EXT_mesh_gpu_instancing");
  if (instancing == nullptr) return {Mat4(1)};
  const tinygltf::Value& attributes = instancing->Get("attributes");
  std::size_t count = 0;
  const auto read = [&](const char* name, int components) {
    std::vector<float> out;
    if (!attributes.IsObject() || !attributes.Has(name)) return out;
    const std::string here = place + ".EXT_mesh_gpu_instancing." + name;
    const int accessor = static_cast<int>(number_of(attributes, name, -1));
    if (!has_accessor(source, accessor, here)) return out;
    out = read_floats(source, accessor, components, here);
    const std::size_t n = out.size() / static_cast<std::size_t>(components);
    if (count != 0 && n != count)
      throw Error(source.at(here), "has " + std::to_string(n) + " elements",
                  std::to_string(count) + ", as the others have");
    count = n;
    return out;
  };
  const std::vector<float> move = read("TRANSLATION", 3), turn = read("ROTATION", 4),
                           scale = read("SCALE", 3);
  std::vector<Mat4> out(count, Mat4(1));
  for (std::size_t i = 0; i < count; ++i) {
    if (!move.empty()) out[i][3] = {move[3 * i], move[3 * i + 1], move[3 * i + 2], 1};
    if (!turn.empty()) {
      const glm::quat q(turn[4 * i + 3], turn[4 * i], turn[4 * i + 1], turn[4 * i + 2]);
      if (glm::length(q) > 1e-6f) out[i] = out[i] * glm::mat4_cast(glm::normalize(q));
    }
    if (!scale.empty())
      for (int axis = 0; axis < 3; ++axis) out[i][axis] *= scale[3 * i + static_cast<std::size_t>(axis)];
  }
  return out;
}

void add_camera(const GltfSource& source, int index, const GltfNode& node, const std::string& place,
                Scene& scene, const Progress& progress) {
  const tinygltf::Camera& camera = element(source, source.model.cameras, index, place + ".camera");
  const std::string name = !node.name.empty() ? node.name : camera.name;
  if (camera.type != "perspective") {
    progress.warn(source.path.string() + ": camera '" + name + "' is orthographic; left out");
    return;
  }
  Camera out;
  out.name = name;
  out.frame = node.transform;
  out.yfov = static_cast<float>(camera.perspective.yfov);
  out.aspect =
      camera.perspective.aspectRatio > 0 ? static_cast<float>(camera.perspective.aspectRatio) : kNoAspect;
  scene.cameras.push_back(std::move(out));
}

std::vector<int> roots(const GltfSource& source) {
  const tinygltf::Model& model = source.model;
  if (model.defaultScene >= 0) return element(source, model.scenes, model.defaultScene, "scene").nodes;
  if (!model.scenes.empty()) return model.scenes.front().nodes;
  std::vector<bool> child(model.nodes.size(), false);
  for (const tinygltf::Node& node : model.nodes)
    for (const int c : node.children)
      if (c >= 0 && static_cast<std::size_t>(c) < child.size()) child[static_cast<std::size_t>(c)] = true;
  std::vector<int> out;
  for (std::size_t i = 0; i < child.size(); ++i)
    if (!child[i]) out.push_back(static_cast<int>(i));
  return out;
}

}  // namespace

void read_gltf_nodes(const GltfSource& source, const GltfMeshes& meshes, Scene& scene,
                     const Progress& progress) {
  struct Visit {
    int node;
    GltfNode parent;
    std::string place;
  };
  GltfLuminaires luminaires(source, scene, progress);
  std::vector<bool> seen(source.model.nodes.size(), false);
  std::vector<Visit> stack;
  const auto push = [&](const std::vector<int>& nodes, const GltfNode& parent, const std::string& place) {
    for (auto i = nodes.rbegin(); i != nodes.rend(); ++i) stack.push_back({*i, parent, place});
  };
  push(roots(source), {}, "scene");
  while (!stack.empty()) {
    const Visit visit = std::move(stack.back());
    stack.pop_back();
    const tinygltf::Node& node = element(source, source.model.nodes, visit.node, visit.place);
    const std::string place = "nodes[" + std::to_string(visit.node) + "]";
    if (seen[static_cast<std::size_t>(visit.node)])
      throw Error(source.at(place), "is reached twice", "a tree of nodes");
    seen[static_cast<std::size_t>(visit.node)] = true;

    const GltfNode here = enter(source, node, visit.parent, place);
    if (node.mesh >= 0) {
      const std::vector<Id<Mesh>>& parts = element(source, meshes.of, node.mesh, place + ".mesh");
      for (const Mat4& copy : copies(source, node, place))
        for (const Id<Mesh> mesh : parts) {
          Instance instance;
          instance.name = here.name;
          instance.mesh = mesh;
          instance.transform = here.transform * copy;
          instance.group_name = here.light_group;
          instance.light_name = here.light_name;
          instance.lightmap_scale = here.lightmap_scale;
          scene.instances.push_back(std::move(instance));
        }
    }
    if (node.camera >= 0) add_camera(source, node.camera, here, place, scene, progress);
    if (auto measured = luminaires.read(node, here, place)) {
      scene.lights.push_back(std::move(*measured));
    } else if (const tinygltf::Value* light = extension(node.extensions, "KHR_lights_punctual")) {
      if (!light->Has("light") || !light->Get("light").IsInt())
        throw Error(source.at(place), "KHR_lights_punctual without an index `light`");
      scene.lights.push_back(read_gltf_light(source, light->Get("light").Get<int>(), here, place + ".light"));
    }
    push(node.children, here, place + ".children");
  }
}

}  // namespace sconce
