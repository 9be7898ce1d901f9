// SPDX-License-Identifier: Apache-2.0
#include "glb_writer.h"

#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>

namespace sconce::demo {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kLists[] = {"nodes",    "cameras", "meshes",    "materials",
                                  "textures", "images",  "accessors", "bufferViews"};

enum Target { kArrayBuffer = 34962, kElementArrayBuffer = 34963 };
enum Component { kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126 };

/// Shortest decimal that gives the float back, so that the file has no binary noise such as
/// 0.30000001192092896.
Json number(float v) {
  char text[32];
  for (int digits = 1; digits <= 9; ++digits) {
    std::snprintf(text, sizeof text, "%.*g", digits, static_cast<double>(v));
    if (std::strtof(text, nullptr) == v) break;
  }
  return std::strtod(text, nullptr);
}

template <class V>
Json numbers(const V& v) {
  Json out = Json::array();
  for (int k = 0; k < V::length(); ++k) out.push_back(number(v[k]));
  return out;
}

class Writer {
 public:
  explicit Writer(const Scene& scene) : scene_(scene) {
    json_["asset"] = {{"version", "2.0"}, {"generator", "sconce make_bathroom"}};
    json_["extensionsUsed"] = {"KHR_materials_emissive_strength"};
    json_["scene"] = 0;
    json_["scenes"] = {{{"name", scene.name}, {"nodes", Json::array()}}};
    // All keys now: adding one later would move the values that references point to.
    for (const char* key : kLists) json_[key] = Json::array();
  }

  std::string write() {
    for (const Instance& instance : scene_.instances) node(instance);
    for (const Camera& camera : scene_.cameras) node(camera);
    for (const Mesh& m : scene_.meshes) mesh(m);
    for (const Material& m : scene_.materials) material(m);
    for (const Texture& t : scene_.textures) texture(t);
    if (!scene_.textures.empty())
      json_["samplers"] = {{{"magFilter", 9729}, {"minFilter", 9987}, {"wrapS", 10497}, {"wrapT", 10497}}};
    json_["buffers"] = {{{"byteLength", binary_.size()}}};

    for (const char* key : kLists)
      if (json_[key].empty()) json_.erase(key);
    std::string text = json_.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string out = "glTF";
    const auto word = [&](std::size_t v) {
      for (int shift = 0; shift < 32; shift += 8) out.push_back(static_cast<char>(v >> shift & 255));
    };
    word(2), word(12 + 8 + text.size() + 8 + binary_.size());
    word(text.size()), out += "JSON", out += text;
    word(binary_.size()), out.append("BIN\0", 4), out += binary_;
    return out;
  }

 private:
  std::size_t view(const void* data, std::size_t bytes, int target) {
    Json v = {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes}};
    if (target) v["target"] = target;
    binary_.append(static_cast<const char*>(data), bytes);
    binary_.resize((binary_.size() + 3) / 4 * 4, '\0');
    json_["bufferViews"].push_back(v);
    return json_["bufferViews"].size() - 1;
  }

  std::size_t accessor(std::size_t view, int component, std::size_t count, const char* type) {
    json_["accessors"].push_back(
        {{"bufferView", view}, {"componentType", component}, {"count", count}, {"type", type}});
    return json_["accessors"].size() - 1;
  }

  template <class V>
  std::size_t attribute(const std::vector<V>& values, const char* type) {
    return accessor(view(values.data(), values.size() * sizeof(V), kArrayBuffer), kFloat, values.size(),
                    type);
  }

  void mesh(const Mesh& m) {
    Json attributes;
    attributes["POSITION"] = attribute(m.positions, "VEC3");
    Bounds bounds;
    for (const Vec3& p : m.positions) bounds.add(p);
    json_["accessors"].back()["min"] = numbers(bounds.lo);
    json_["accessors"].back()["max"] = numbers(bounds.hi);
    attributes["NORMAL"] = attribute(m.normals, "VEC3");
    for (std::size_t set = 0; set < m.texcoords.size(); ++set)
      attributes["TEXCOORD_" + std::to_string(set)] = attribute(m.texcoords[set], "VEC2");
    std::vector<uint16_t> small;
    std::vector<uint32_t> large;
    for (const Triangle& t : m.triangles)
      for (const uint32_t v : t.v) small.push_back(static_cast<uint16_t>(v)), large.push_back(v);
    const bool fits = m.positions.size() < 65536;
    const std::size_t at = fits ? view(small.data(), small.size() * 2, kElementArrayBuffer)
                                : view(large.data(), large.size() * 4, kElementArrayBuffer);
    const std::size_t indices = accessor(at, fits ? kUnsignedShort : kUnsignedInt, large.size(), "SCALAR");
    json_["meshes"].push_back(
        {{"name", m.name},
         {"primitives",
          {{{"attributes", attributes}, {"indices", indices}, {"material", m.material.value}}}}});
  }

  void material(const Material& m) {
    Json pbr = {
        {"baseColorFactor", {number(m.base_color.r), number(m.base_color.g), number(m.base_color.b), 1}},
        {"metallicFactor", number(m.metallic)},
        {"roughnessFactor", number(m.roughness)}};
    if (m.base_color_texture.texture)
      pbr["baseColorTexture"] = {{"index", m.base_color_texture.texture.value}};
    Json out = {{"name", m.name}, {"pbrMetallicRoughness", pbr}};
    if (m.double_sided) out["doubleSided"] = true;
    if (m.emits()) {
      const Rgb factor = m.emission / m.emission.max();
      out["emissiveFactor"] = {number(factor.r), number(factor.g), number(factor.b)};
      out["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = number(m.emission.max());
    }
    json_["materials"].push_back(out);
  }

  void texture(const Texture& t) {
    const std::size_t at = view(t.file.data(), t.file.size(), 0);
    json_["images"].push_back({{"name", t.name}, {"mimeType", t.mime}, {"bufferView", at}});
    json_["textures"].push_back({{"sampler", 0}, {"source", json_["images"].size() - 1}});
  }

  Json& node(const std::string& name) {
    Json& nodes = json_["nodes"];
    json_["scenes"][0]["nodes"].push_back(nodes.size());
    nodes.push_back({{"name", name}});
    return nodes.back();
  }

  void node(const Instance& instance) {
    Json& out = node(instance.name);
    out["mesh"] = instance.mesh.value;
    if (!instance.group_name.empty()) out["extras"]["light_group"] = instance.group_name;
    if (instance.lightmap_scale != 1) out["extras"]["lightmap_scale"] = number(instance.lightmap_scale);
  }

  void node(const Camera& camera) {
    Json& out = node(camera.name);
    const auto rounded = [](auto v) { return glm::round(v * 65536.0f) / 65536.0f; };
    const glm::quat q = glm::quat_cast(Mat3(camera.frame));
    out["translation"] = numbers(rounded(Vec3(camera.frame[3])));
    out["rotation"] = numbers(rounded(glm::vec4(q.x, q.y, q.z, q.w)));
    out["camera"] = json_["cameras"].size();
    json_["cameras"].push_back(
        {{"name", camera.name},
         {"type", "perspective"},
         {"perspective",
          {{"aspectRatio", number(camera.aspect)}, {"yfov", number(camera.yfov)}, {"znear", 0.01}}}});
  }

  const Scene& scene_;
  Json json_;
  std::string binary_;
};

}  // namespace

std::string write_glb(const Scene& scene) {
  return Writer(scene).write();
}

}  // namespace sconce::demo
