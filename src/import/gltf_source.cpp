// SPDX-License-Identifier: Apache-2.0
#include "import/gltf_source.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/files.h"
#include "core/text.h"
#include "import/gltf_container.h"
#include "import/gltf_draco.h"
#include "import/gltf_meshopt.h"
#include "import/luminaires.h"
#include "import/uri.h"

namespace fs = std::filesystem;

namespace sconce {

namespace {

using nlohmann::json;

constexpr int kMaxDepth = 200;

const std::vector<std::string> kUnderstood = {"EXT_lights_ies",
                                              "EXT_mesh_gpu_instancing",
                                              "EXT_meshopt_compression",
                                              "EXT_texture_webp",
                                              "KHR_draco_mesh_compression",
                                              "KHR_lights_punctual",
                                              "KHR_materials_emissive_strength",
                                              "KHR_materials_pbrSpecularGlossiness",
                                              "KHR_materials_transmission",
                                              "KHR_materials_unlit",
                                              "KHR_mesh_quantization",
                                              "KHR_texture_basisu",
                                              "KHR_texture_transform"};

json parse_json(const std::string& text, const std::string& where) {
  const auto limit_depth = [&](int depth, json::parse_event_t, json&) {
    if (depth > kMaxDepth) throw Error(where, "JSON is nested deeper than " + std::to_string(kMaxDepth));
    return true;
  };
  try {
    json root = json::parse(text, limit_depth);
    if (!root.is_object()) throw Error(where, "the JSON is not an object");
    return root;
  } catch (const json::exception& e) {
    throw Error(where, std::string("is no valid JSON: ") + e.what());
  }
}

std::vector<std::string> strings(const json& root, const char* key) {
  std::vector<std::string> out;
  if (root.contains(key) && root.at(key).is_array())
    for (const json& item : root.at(key))
      if (item.is_string()) out.push_back(item.get<std::string>());
  return out;
}

std::vector<std::string> not_understood(const std::vector<std::string>& extensions) {
  std::vector<std::string> out;
  for (const std::string& name : extensions)
    if (std::find(kUnderstood.begin(), kUnderstood.end(), name) == kUnderstood.end()) out.push_back(name);
  return out;
}

void check_version(const json& root, const std::string& where) {
  if (!root.contains("asset") || !root.at("asset").is_object() || !root.at("asset").contains("version") ||
      !root.at("asset").at("version").is_string())
    throw Error(where, "asset.version is missing", "2.0");
  const auto version = root.at("asset").at("version").get<std::string>();
  if (!version.starts_with("2.")) throw Error(where, "glTF version " + version + " is not supported", "2.0");
  const std::string least = root.at("asset").value("minVersion", std::string("2.0"));
  if (least != "2.0") throw Error(where, "needs glTF version " + least + ", which is not supported", "2.0");
}

void check_extensions(const json& root, const std::string& where, const Progress& progress) {
  const auto required = not_understood(strings(root, "extensionsRequired"));
  if (!required.empty())
    throw Error(where, "requires glTF extensions that are not supported: " + join(required, ", "),
                join(kUnderstood, ", "));
  const auto ignored = not_understood(strings(root, "extensionsUsed"));
  if (!ignored.empty()) progress.warn(where + ": glTF extensions ignored: " + join(ignored, ", "));
}

fs::path beside(const fs::path& scene, const std::string& uri) {
  return scene.parent_path() / fs::path(percent_decoded(uri));
}

/// The bytes of one buffer; nothing where it is not there (a warning has said so).
std::optional<Bytes> read_buffer(const json& buffer, std::size_t index, const GltfContainer& container,
                                 const fs::path& path, const Progress& progress) {
  const std::string place = path.string() + ": buffers[" + std::to_string(index) + "]";
  if (!buffer.is_object() || !buffer.contains("byteLength") || !buffer.at("byteLength").is_number_unsigned())
    throw Error(place, "byteLength is missing");
  const auto length = buffer.at("byteLength").get<std::size_t>();
  Bytes bytes;
  if (!buffer.contains("uri")) {
    if (is_meshopt_fallback(buffer)) return std::nullopt;
    if (index != 0 || !container.binary) {
      progress.warn(place + ": has neither a uri nor a binary chunk; what lies in it is left out");
      return std::nullopt;
    }
    bytes.assign(container.binary->begin(), container.binary->end());
  } else {
    const auto uri = buffer.at("uri").get<std::string>();
    if (is_data_uri(uri)) {
      bytes = decode_data_uri(uri, place).bytes;
    } else {
      const fs::path file = beside(path, uri);
      if (has_scheme(uri) || !is_file(file)) {
        progress.warn(path.string() + ": buffer file " + (has_scheme(uri) ? uri : file.string()) +
                      " is missing; what lies in it is left out");
        return std::nullopt;
      }
      const std::string content = read_file(file);
      if (is_lfs_pointer(content)) {
        progress.warn(path.string() + ": buffer file " + file.string() +
                      " is missing (only its Git LFS pointer is there); what lies in it is left out");
        return std::nullopt;
      }
      bytes.assign(content.begin(), content.end());
    }
  }
  if (bytes.size() < length)
    throw Error(place,
                "is cut short: " + std::to_string(bytes.size()) + " bytes of " + std::to_string(length));
  bytes.resize(length);
  return bytes;
}

/// Photometric files that nodes name.
std::vector<std::string> luminaire_files(const json& root) {
  std::vector<std::string> out;
  const json nodes = root.value("nodes", json::array());
  for (const json& node : nodes) {
    if (!node.is_object()) continue;
    if (node.contains("name") && node.at("name").is_string())
      out.push_back(luminaire_of_node_name(node.at("name").get<std::string>()));
    for (const char* at : {"/extras/luminaire", "/extras/luminaire/file"}) {
      const json::json_pointer pointer(at);
      if (node.contains(pointer) && node.at(pointer).is_string())
        out.push_back(node.at(pointer).get<std::string>());
    }
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  std::erase(out, std::string());
  return out;
}

std::vector<GltfImage> read_images(const json& root) {
  std::vector<GltfImage> out;
  if (!root.contains("images")) return out;
  for (const json& image : root.at("images")) {
    GltfImage i;
    i.name = image.value("name", std::string());
    i.mime = image.value("mimeType", std::string());
    i.uri = image.value("uri", std::string());
    i.buffer_view = image.value("bufferView", -1);
    out.push_back(std::move(i));
  }
  return out;
}

/// 1.0 is an integer, too: JSON knows no difference, tinygltf does.
void whole_numbers(json& node) {
  if (node.is_structured()) {
    for (json& child : node) whole_numbers(child);
  } else if (node.is_number_float()) {
    const double v = node.get<double>();
    if (v >= 0 && v <= 0x1p53 && v == std::floor(v)) node = static_cast<uint64_t>(v);
  }
}

/// Where a primitive's indices are, kept from tinygltf: it refuses accessors without a view, which are zeros.
struct KeptIndices {
  std::size_t mesh, primitive;
  int accessor;
};

/// tinygltf drops a primitive that it cannot read without a word, and those after it would take its place.
void check_primitive(const json& primitive, const std::string& place) {
  if (!primitive.is_object() || !primitive.contains("attributes") || !primitive.at("attributes").is_object())
    throw Error(place, "has no attributes");
  for (const auto& [name, accessor] : primitive.at("attributes").items())
    if (!accessor.is_number_integer()) throw Error(place + "." + name, "is no accessor index");
}

/// tinygltf refuses the whole file for a type that it does not know, which glTF leaves to extensions. MAT2 is
/// as good: nothing that is read is one.
void replace_unknown_types(json& root) {
  if (!root.contains("accessors") || !root.at("accessors").is_array()) return;
  for (json& accessor : root.at("accessors")) {
    if (!accessor.is_object() || !accessor.contains("type") || !accessor.at("type").is_string()) continue;
    const auto type = accessor.at("type").get<std::string>();
    static constexpr std::string_view kTypes[] = {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"};
    if (std::find(std::begin(kTypes), std::end(kTypes), type) == std::end(kTypes)) accessor["type"] = "MAT2";
  }
}

/// Leaves to tinygltf what it reads safely and what is of use: no pictures, animations, skins or morph
/// targets.
std::vector<KeptIndices> simplify(json& root, const std::vector<Bytes>& buffers, const std::string& where) {
  std::vector<KeptIndices> kept;
  for (const char* key : {"images", "animations", "skins"}) root.erase(key);
  replace_unknown_types(root);
  json none = json::array();
  json& meshes = root.contains("meshes") ? root.at("meshes") : none;
  if (!meshes.is_array()) throw Error(where, "meshes is no array");
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    const std::string place = where + ": meshes[" + std::to_string(m) + "]";
    if (!meshes.at(m).is_object()) throw Error(place, "is no object");
    if (!meshes.at(m).contains("primitives")) continue;
    json& primitives = meshes.at(m).at("primitives");
    if (!primitives.is_array()) throw Error(place, "primitives is no array");
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      json& primitive = primitives.at(p);
      check_primitive(primitive, place + ".primitives[" + std::to_string(p) + "]");
      primitive.erase("targets");
      if (!primitive.contains("indices") || is_draco(primitive)) continue;
      kept.push_back({m, p, primitive.at("indices").get<int>()});
      primitive.erase("indices");
    }
  }
  for (std::size_t i = 0; i < buffers.size(); ++i)
    root.at("buffers").at(i) = {{"byteLength", buffers[i].size()}, {"uri", "buffer:" + std::to_string(i)}};
  return kept;
}

}  // namespace

bool GltfSource::has_view(int index, const std::string& place) const {
  if (index < 0 || static_cast<std::size_t>(index) >= model.bufferViews.size())
    throw Error(at(place), "bufferView " + std::to_string(index) + " is out of range",
                "0 to " + std::to_string(model.bufferViews.size()) + " exclusive");
  const tinygltf::BufferView& v = model.bufferViews[static_cast<std::size_t>(index)];
  const std::string here = at("bufferViews[" + std::to_string(index) + "]");
  if (v.buffer < 0 || static_cast<std::size_t>(v.buffer) >= model.buffers.size())
    throw Error(here, "buffer " + std::to_string(v.buffer) + " is out of range",
                "0 to " + std::to_string(model.buffers.size()) + " exclusive");
  const auto buffer = static_cast<std::size_t>(v.buffer);
  if (buffer < buffer_missing.size() && buffer_missing[buffer]) return false;
  const std::size_t size = model.buffers[buffer].data.size();
  if (v.byteOffset > size || v.byteLength > size - v.byteOffset)
    throw Error(here, "reaches beyond its buffer of " + std::to_string(size) + " bytes");
  return true;
}

std::span<const unsigned char> GltfSource::view(int index, const std::string& place) const {
  if (!has_view(index, place)) throw Error(at(place), "lies in a buffer that is missing");
  const tinygltf::BufferView& v = model.bufferViews[static_cast<std::size_t>(index)];
  return std::span<const unsigned char>(model.buffers[static_cast<std::size_t>(v.buffer)].data)
      .subspan(v.byteOffset, v.byteLength);
}

GltfSource open_gltf(const fs::path& path, const Progress& progress) {
  const GltfContainer container = open_gltf_container(path);
  const std::string where = path.string();
  json root = parse_json(container.json, where);
  GltfSource out;
  out.path = path;
  std::vector<Bytes> buffers;
  std::vector<KeptIndices> indices;
  try {
    whole_numbers(root);
    check_version(root, where);
    check_extensions(root, where, progress);
    if (root.contains("buffers")) {
      for (const json& buffer : root.at("buffers")) {
        std::optional<Bytes> bytes = read_buffer(buffer, buffers.size(), container, path, progress);
        // tinygltf refuses empty buffers; no view can lie in this byte because the buffer counts as missing.
        out.buffer_missing.push_back(!bytes || bytes->empty());
        buffers.push_back(out.buffer_missing.back() ? Bytes(1, 0) : std::move(*bytes));
        progress.check();
      }
    }
    out.images = read_images(root);
    decode_meshopt(root, buffers, out.buffer_missing, where);
    check_draco(root, buffers, out.buffer_missing, where);
    indices = simplify(root, buffers, where);
  } catch (const json::exception& e) {
    throw Error(where, std::string("is no valid glTF: ") + e.what());
  }
  out.model = parse_gltf_model(root.dump(), buffers, where);
  for (const KeptIndices& k : indices)
    out.model.meshes.at(k.mesh).primitives.at(k.primitive).indices = k.accessor;
  return out;
}

std::vector<fs::path> gltf_files(const fs::path& path) {
  std::vector<fs::path> out;
  const json root = parse_json(open_gltf_container(path).json, path.string());
  const json profiles = root.value("/extensions/EXT_lights_ies/lights"_json_pointer, json::array());
  const json files = {root.value("buffers", json::array()), root.value("images", json::array()), profiles};
  for (const json& list : files) {
    if (!list.is_array()) continue;
    for (const json& item : list) {
      if (!item.is_object() || !item.contains("uri") || !item.at("uri").is_string()) continue;
      const auto uri = item.at("uri").get<std::string>();
      if (is_data_uri(uri) || has_scheme(uri)) continue;
      if (const fs::path file = beside(path, uri); is_file(file)) out.push_back(file);
    }
  }
  for (const std::string& name : luminaire_files(root))
    if (const auto file = find_luminaire_file(path.parent_path(), name)) out.push_back(*file);
  return out;
}

}  // namespace sconce
