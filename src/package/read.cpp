// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <optional>

#include "core/error.h"
#include "core/files.h"
#include "core/hash.h"
#include "core/parallel.h"
#include "encode/choice.h"
#include "image/io.h"
#include "package/glb.h"
#include "package/layer_file.h"
#include "package/manifest.h"

namespace fs = std::filesystem;

namespace sconce {

namespace {

/// A file that the manifest lists.
struct Listed {
  fs::path path;
  std::string hash;
  std::optional<uint64_t> bytes;
};

std::vector<Listed> listed_files(const fs::path& folder, const Manifest& m) {
  std::vector<Listed> files;
  for (const LayerInfo& layer : m.layers)
    files.push_back({folder / kLayerFolder / layer.file, layer.hash, layer.bytes});
  for (const LayerInfo& layer : m.raw)
    files.push_back({folder / kRawFolder / layer.file, layer.hash, layer.bytes});
  for (const auto& [name, hash] : m.hashes) files.push_back({folder / name, hash, std::nullopt});
  return files;
}

void check_presence(const Listed& file) {
  std::error_code ec;
  if (!fs::is_regular_file(file.path, ec)) throw Error(file.path.string(), "is missing from the package");
  const uint64_t bytes = fs::file_size(file.path, ec);
  if (file.bytes && bytes != *file.bytes)
    throw Error(file.path.string(), "is damaged: it has " + std::to_string(bytes) +
                                        " bytes, the manifest says " + std::to_string(*file.bytes));
}

void check_listed(const Manifest& m, const std::string& where) {
  std::vector<std::string> needed{"scene.glb"};
  for (int page = 0; page < m.pages; ++page) needed.push_back(page_file("receivers", page));
  for (const std::string& name : needed)
    if (m.hashes.count(name) == 0) throw Error(where, "files." + name + " is missing");
  for (const auto* layers : {&m.layers, &m.raw})
    for (const LayerInfo& layer : *layers) {
      EncodingChoice choice;
      try {
        choice = parse_encoding(layer.encoding);
      } catch (const UsageError& e) {
        throw Error(where, "layer " + layer.file + ": " + e.what());
      }
      if (m.basis != Basis::flat && !signed_encoding(choice))
        throw Error(where, "layer " + layer.file + " has the encoding " + layer.encoding +
                               ", which cannot hold the basis " + std::string(basis_row(m.basis).name));
      if (choice.luminance != (layer.channel >= 0))
        throw Error(where, "layer " + layer.file + " has the encoding " + layer.encoding +
                               (choice.luminance ? " and no channel" : " and a channel"));
    }
}

Id<LightGroup> find_group(const Manifest& m, const std::string& name) {
  for (std::size_t g = 0; g < m.groups.size(); ++g)
    if (m.groups[g].name == name) return Id<LightGroup>(g);
  return {};
}

// What glTF cannot know: that the tables of the manifest fit this geometry.
void check_scene(const Scene& scene, const Manifest& m, const std::string& where) {
  if (scene.instances.size() != m.instance_pages.size())
    throw Error(where, "has " + std::to_string(scene.instances.size()) + " mesh nodes, the manifest has " +
                           std::to_string(m.instance_pages.size()));
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    const Mesh& mesh = scene[instance.mesh];
    if (m.instance_pages[i] >= 0 && mesh.texcoords.size() <= m.lightmap_set)
      throw Error(where, "mesh '" + mesh.name + "' lacks the lightmap coordinates TEXCOORD_" +
                             std::to_string(m.lightmap_set));
    if (m.instance_twins[i] >= 0) {
      const Instance& twin = scene.instances[static_cast<std::size_t>(m.instance_twins[i])];
      if (scene[twin.mesh].triangles.size() != mesh.triangles.size())
        throw Error(where, "mesh '" + mesh.name + "' and its twin differ in triangles");
    }
    if (scene.emits(instance) && !instance.group_name.empty() && !instance.group)
      throw Error(where, "'" + instance.name + "' is in the light group '" + instance.group_name +
                             "', which the manifest lacks");
  }
}

}  // namespace

Package Package::open(const fs::path& path, bool check_hashes) {
  std::error_code ec;
  if (!fs::exists(path, ec)) throw Error(path.string(), "no such package");
  const fs::path file = path / kManifestFile;
  if (!fs::is_directory(path, ec) || !fs::is_regular_file(file, ec))
    throw NotMyFormat(path.string(), "is no sconce package", "a folder that holds manifest.json");
  Package package;
  package.path_ = path;
  package.manifest_ = parse_manifest(read_file(file), file.string());
  check_listed(package.manifest_, file.string());
  const std::vector<Listed> files = listed_files(path, package.manifest_);
  for (const Listed& listed : files) check_presence(listed);
  if (check_hashes)
    parallel_for(files.size(), 1, [&](std::size_t i) {
      if (hash_file(files[i].path) != files[i].hash)
        throw Error(files[i].path.string(), "is damaged: its content is not what the manifest says");
    });
  return package;
}

Package Package::undenoised() const {
  if (manifest_.raw.empty())
    throw Error(path_.string(), "holds no raw layers: it was baked without the denoiser");
  Package package = *this;
  package.raw_ = true;
  return package;
}

std::filesystem::path Package::layer_folder() const {
  return path_ / (raw_ ? kRawFolder : kLayerFolder);
}

EncodedImage Package::encoded(const LayerInfo& layer) const {
  const std::vector<std::string> names = layer_names(manifest_.groups, layer.coefficient);
  const std::string& name = names[layer.group];
  LayerShape shape{
      parse_encoding(layer.encoding).encoding, manifest_.width, manifest_.height, {}, {1, 1, 1, 1}};
  if (layer.channel < 0) {
    shape.channels = {name + ".R", name + ".G", name + ".B"};
    shape.gain.fill(static_cast<float>(layer.gain));
  } else {
    for (const LayerInfo& other : layer_files()) {
      if (other.file != layer.file) continue;
      const auto c = static_cast<std::size_t>(other.channel);
      shape.channels.resize(std::max(shape.channels.size(), c + 1));
      shape.channels[c] = names[other.group] + ".Y";
      shape.gain[c] = static_cast<float>(other.gain);
    }
  }
  return read_layer_file(layer_folder() / layer.file, shape);
}

std::vector<LayerTexture> Package::textures(std::size_t coefficient) const {
  std::vector<LayerTexture> textures;
  std::map<std::string, std::size_t> by_file;  // of page 0
  for (std::size_t g = 0; g < manifest_.groups.size(); ++g) {
    const LayerInfo& first = layer_info(g, 0, coefficient);
    const auto [known, added] = by_file.emplace(first.file, textures.size());
    if (added) textures.push_back({parse_encoding(first.encoding), {}, {}, coefficient});
    LayerTexture& texture = textures[known->second];
    texture.gain.resize(static_cast<std::size_t>(manifest_.pages), {1, 1, 1, 1});
    const auto channel = static_cast<std::size_t>(std::max(0, first.channel));
    texture.groups.resize(std::max(texture.groups.size(), channel + 1));
    texture.groups[channel] = g;
    for (int page = 0; page < manifest_.pages; ++page) {
      const LayerInfo& layer = layer_info(g, page, coefficient);
      if (layer.encoding != first.encoding || layer.channel != first.channel)
        throw Error(path_.string(), "group '" + manifest_.groups[g].name + "' is encoded otherwise on page " +
                                        std::to_string(page));
      std::array<float, 4>& gain = texture.gain[static_cast<std::size_t>(page)];
      if (first.channel < 0)
        gain.fill(static_cast<float>(layer.gain));
      else
        gain[channel] = static_cast<float>(layer.gain);
    }
  }
  return textures;
}

const LayerInfo& Package::layer_info(std::size_t group, int page, std::size_t coefficient) const {
  for (const LayerInfo& layer : layer_files())
    if (layer.group == group && layer.page == page && layer.coefficient == coefficient) return layer;
  throw Error(path_.string(), "has no layer " + std::to_string(group) + " on page " + std::to_string(page));
}

Image Package::layer(std::size_t group, int page, std::size_t coefficient) const {
  const LayerInfo& info = layer_info(group, page, coefficient);
  Image image = decode(encoded(info));
  if (info.channel >= 0)
    image = unpack_luminance(image, static_cast<std::size_t>(info.channel), manifest_.groups[group].color);
  image.channels = {"R", "G", "B"};
  image.text["sconce:unit"] = "lux";
  return image;
}

Image Package::receivers(int page) const {
  return page_image(page_file("receivers", page), {"albedo.R", "albedo.G", "albedo.B", "weight"});
}

Image Package::noise(int page) const {
  return page_image(page_file(raw_ ? "raw-noise" : "noise", page), layer_names(manifest_.groups));
}

Image Package::page_image(const std::string& name, const std::vector<std::string>& channels) const {
  const fs::path file = path_ / name;
  return pick_channels(read_exr(file), channels, manifest_.width, manifest_.height, file);
}

std::string Package::layout() const {
  const std::string name(kLayoutFile);
  if (manifest_.hashes.count(name) == 0) throw Error(path_.string(), "has no " + name);
  return read_file(path_ / name);
}

Scene Package::scene() const {
  const std::string where = (path_ / "scene.glb").string();
  Scene scene = read_glb(read_file(where), where);
  for (const GroupInfo& group : manifest_.groups) scene.groups.push_back({group.name});
  for (Instance& instance : scene.instances) instance.group = find_group(manifest_, instance.group_name);
  std::size_t skies = 0;
  for (Light& light : scene.lights) {
    light.group = find_group(manifest_, light.group_name);
    if (auto* sky = std::get_if<SkyLight>(&light.shape)) {
      const fs::path file = path_ / sky_file(skies++);
      sky->image = read_exr(file);
      if (sky->image.channels != std::vector<std::string>{"R", "G", "B"})
        throw Error(file.string(), "does not hold the channels R, G, B");
    }
  }
  check_scene(scene, manifest_, where);
  return scene;
}

}  // namespace sconce
