// SPDX-License-Identifier: Apache-2.0
#include "import/gltf_draco.h"

#include <draco/compression/decode.h>

#include <map>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "import/gltf_accessor.h"

namespace sconce {

namespace {

using nlohmann::json;

constexpr const char* kDraco = "KHR_draco_mesh_compression";

const json& element(const json& root, const char* array, const json& index, const std::string& place) {
  static const json none = json::array();
  const json& all = root.contains(array) ? root.at(array) : none;
  if (!index.is_number_unsigned() || index.get<std::size_t>() >= all.size())
    throw Error(place, std::string("index ") + index.dump() + " into " + array + " is out of range",
                "0 to " + std::to_string(all.size()) + " exclusive");
  return all.at(index.get<std::size_t>());
}

int component_bytes(const json& accessor) {
  return sconce::component_bytes(accessor.value("componentType", 0));
}

void check_stream(const json& root, const json& primitive, const char* data, std::size_t size,
                  const std::string& place) {
  draco::DecoderBuffer buffer;
  buffer.Init(data, size);
  draco::Decoder decoder;
  auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok())
    throw Error(place, std::string("Draco stream is damaged: ") + decoded.status().error_msg());
  const draco::Mesh& mesh = *decoded.value();
  if (mesh.num_faces() == 0 || mesh.num_points() == 0) throw Error(place, "Draco stream holds no triangles");
  if (primitive.contains("indices")) {
    const json& accessor = element(root, "accessors", primitive.at("indices"), place + ".indices");
    if (component_bytes(accessor) == 0)
      throw Error(place + ".indices", "componentType is not allowed for indices");
  }
  const json& attributes = primitive.at("extensions").at(kDraco).at("attributes");
  for (const auto& [name, id] : attributes.items()) {
    const std::string here = place + ".attributes." + name;
    if (!primitive.at("attributes").contains(name)) throw Error(here, "is compressed but is no attribute");
    const json& accessor = element(root, "accessors", primitive.at("attributes").at(name), here);
    const draco::PointAttribute* attribute =
        id.is_number_unsigned() ? mesh.GetAttributeByUniqueId(id.get<uint32_t>()) : nullptr;
    if (attribute == nullptr) throw Error(here, "Draco stream has no attribute " + id.dump());
    const bool fits = attribute->num_components() <= 4 && attribute->byte_offset() == 0 &&
                      attribute->byte_stride() == attribute->num_components() * component_bytes(accessor);
    if (!fits) throw Error(here, "Draco attribute differs in type from its accessor");
  }
}

}  // namespace

bool is_draco(const json& primitive) {
  return primitive.contains("extensions") && primitive.at("extensions").contains(kDraco);
}

void check_draco(json& root, const std::vector<Bytes>& buffers, const std::vector<bool>& missing,
                 const std::string& where) {
  if (!root.contains("meshes")) return;
  std::size_t m = 0;
  for (json& mesh : root.at("meshes")) {
    const std::string mesh_place = where + ": meshes[" + std::to_string(m++) + "]";
    if (!mesh.contains("primitives")) continue;
    std::size_t p = 0;
    for (json& primitive : mesh.at("primitives")) {
      const std::string place = mesh_place + ".primitives[" + std::to_string(p++) + "]";
      if (!is_draco(primitive)) continue;
      const json& draco = primitive.at("extensions").at(kDraco);
      if (!primitive.contains("attributes") || !draco.contains("attributes") || !draco.contains("bufferView"))
        throw Error(place, "Draco compression without attributes or bufferView");
      const json& view = element(root, "bufferViews", draco.at("bufferView"), place + "." + kDraco);
      const json& buffer_index = view.at("buffer");
      element(root, "buffers", buffer_index, place + "." + kDraco);
      const auto index = buffer_index.get<std::size_t>();
      if (missing[index]) {
        primitive["attributes"] = json::object();
        primitive.erase("indices");
        primitive.erase("extensions");
        continue;
      }
      const auto offset = view.value("byteOffset", std::size_t{0}),
                 length = view.value("byteLength", std::size_t{0});
      const Bytes& bytes = buffers[index];
      if (offset > bytes.size() || length > bytes.size() - offset)
        throw Error(place + "." + kDraco, "compressed data reaches beyond its buffer");
      check_stream(root, primitive, reinterpret_cast<const char*>(bytes.data()) + offset, length, place);
    }
  }
}

}  // namespace sconce
