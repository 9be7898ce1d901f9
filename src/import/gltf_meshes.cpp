// SPDX-License-Identifier: Apache-2.0
#include <numeric>

#include "core/error.h"
#include "import/gltf_accessor.h"
#include "import/gltf_parts.h"

namespace sconce {

namespace {

constexpr float kPlainGrey = 0.8f;  // what has no material; glTF's own default is a black-bodied mirror

std::vector<Vec3> vectors(const std::vector<float>& v) {
  std::vector<Vec3> out(v.size() / 3);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = {v[3 * i], v[3 * i + 1], v[3 * i + 2]};
  return out;
}

std::vector<Vec2> pairs(const std::vector<float>& v) {
  std::vector<Vec2> out(v.size() / 2);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = {v[2 * i], v[2 * i + 1]};
  return out;
}

/// Triangles of a list, strip or fan, wound as glTF says (section 3.7.2.1).
std::vector<Triangle> assemble(int mode, const std::vector<uint32_t>& index) {
  std::vector<Triangle> out;
  if (mode == TINYGLTF_MODE_TRIANGLES) {
    for (std::size_t i = 0; i + 2 < index.size(); i += 3)
      out.push_back({{index[i], index[i + 1], index[i + 2]}});
  } else {
    for (std::size_t i = 0; i + 2 < index.size(); ++i) {
      const std::size_t odd = i % 2;
      if (mode == TINYGLTF_MODE_TRIANGLE_STRIP)
        out.push_back({{index[i], index[i + 1 + odd], index[i + 2 - odd]}});
      else
        out.push_back({{index[i + 1], index[i + 2], index[0]}});
    }
  }
  return out;
}

class MeshReader {
 public:
  MeshReader(const GltfSource& source, Scene& scene, const Progress& progress)
      : source_(source), scene_(scene), progress_(progress) {}

  std::optional<Id<Mesh>> read(const tinygltf::Mesh& mesh, const tinygltf::Primitive& primitive,
                               const std::string& place) {
    const bool draco = extension(primitive.extensions, "KHR_draco_mesh_compression") != nullptr;
    const int mode = draco ? TINYGLTF_MODE_TRIANGLES : primitive.mode;  // decoded streams are lists
    if (mode < 0 || mode > TINYGLTF_MODE_TRIANGLE_FAN)
      throw Error(source_.at(place), "mode " + std::to_string(mode), "0 to 6");
    if (mode < TINYGLTF_MODE_TRIANGLES) return skip(place, "holds points or lines");
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end()) return skip(place, "has no positions");
    for (const auto& [name, accessor] : primitive.attributes)
      if (used(name) && !has_accessor(source_, accessor, place + "." + name))
        return skip(place, "lies in a missing buffer");
    if (primitive.indices >= 0 && !has_accessor(source_, primitive.indices, place + ".indices"))
      return skip(place, "lies in a missing buffer");

    Mesh out;
    out.name = mesh.name;
    out.positions = vectors(read_floats(source_, position->second, 3, place + ".POSITION"));
    read_attributes(primitive, place, out);
    read_triangles(primitive, mode, place, out);
    out.material = material(primitive.material, place);
    scene_.meshes.push_back(std::move(out));
    return Id<Mesh>(scene_.meshes.size() - 1);
  }

 private:
  static bool used(const std::string& name) {
    return name == "POSITION" || name == "NORMAL" || name == "TANGENT" || name.starts_with("TEXCOORD_");
  }

  std::nullopt_t skip(const std::string& place, const char* why) {
    progress_.warn(source_.at(place) + ": " + why + "; left out");
    return std::nullopt;
  }

  void read_attributes(const tinygltf::Primitive& primitive, const std::string& place, Mesh& out) {
    const std::size_t count = out.positions.size();
    const auto check = [&](std::size_t n, const std::string& name) {
      if (n != count)
        throw Error(source_.at(place + "." + name), "has " + std::to_string(n) + " elements",
                    std::to_string(count) + ", as POSITION has");
    };
    if (const auto normal = primitive.attributes.find("NORMAL"); normal != primitive.attributes.end()) {
      out.normals = vectors(read_floats(source_, normal->second, 3, place + ".NORMAL"));
      check(out.normals.size(), "NORMAL");
    }
    if (const auto tangent = primitive.attributes.find("TANGENT"); tangent != primitive.attributes.end()) {
      const std::vector<float> v = read_floats(source_, tangent->second, 4, place + ".TANGENT");
      for (std::size_t i = 0; i + 3 < v.size(); i += 4)
        out.tangents.emplace_back(v[i], v[i + 1], v[i + 2], v[i + 3]);
      check(out.tangents.size(), "TANGENT");
    }
    for (std::size_t left = primitive.attributes.size(), set = 0; left > 0 && set < 64; ++set) {
      const std::string name = "TEXCOORD_" + std::to_string(set);
      const auto found = primitive.attributes.find(name);
      if (found == primitive.attributes.end()) continue;
      out.texcoords.resize(set, std::vector<Vec2>(count, Vec2(0)));  // a set that is skipped is all zero
      out.texcoords.push_back(pairs(read_floats(source_, found->second, 2, place + "." + name)));
      check(out.texcoords.back().size(), name);
      --left;
    }
    if (primitive.attributes.contains("COLOR_0") && !warned_colors_) {
      warned_colors_ = true;
      progress_.warn(source_.path.string() + ": vertex colours (COLOR_0) are ignored");
    }
  }

  void read_triangles(const tinygltf::Primitive& primitive, int mode, const std::string& place, Mesh& out) {
    std::vector<uint32_t> index(out.positions.size());
    if (primitive.indices >= 0)
      index = read_indices(source_, primitive.indices, place + ".indices");
    else
      std::iota(index.begin(), index.end(), 0u);
    for (const uint32_t i : index)
      if (i >= out.positions.size())
        throw Error(source_.at(place + ".indices"), "vertex " + std::to_string(i) + " is out of range",
                    "0 to " + std::to_string(out.positions.size()) + " exclusive");
    out.triangles = assemble(mode, index);
  }

  Id<Material> material(int index, const std::string& place) {
    if (index >= 0) {
      element(source_, source_.model.materials, index, place + ".material");
      return Id<Material>(static_cast<std::size_t>(index));
    }
    if (!plain_) {
      plain_ = Id<Material>(scene_.materials.size());
      Material grey;
      grey.name = "no material";
      grey.base_color = Rgb(kPlainGrey);
      scene_.materials.push_back(grey);
      progress_.warn(source_.at(place) +
                     ": has no material; grey 0.8 is used for this and all others without");
    }
    return plain_;
  }

  const GltfSource& source_;
  Scene& scene_;
  const Progress& progress_;
  Id<Material> plain_;
  bool warned_colors_ = false;
};

}  // namespace

GltfMeshes read_gltf_meshes(const GltfSource& source, Scene& scene, const Progress& progress) {
  GltfMeshes out;
  MeshReader reader(source, scene, progress);
  for (std::size_t m = 0; m < source.model.meshes.size(); ++m) {
    progress.check();
    progress.at("meshes", m, source.model.meshes.size());
    const tinygltf::Mesh& mesh = source.model.meshes[m];
    out.of.emplace_back();
    for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
      const std::string place = "meshes[" + std::to_string(m) + "].primitives[" + std::to_string(p) + "]";
      if (const auto id = reader.read(mesh, mesh.primitives[p], place)) out.of.back().push_back(*id);
    }
  }
  return out;
}

}  // namespace sconce
