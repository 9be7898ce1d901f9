// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "import/gltf_parts.h"
#include "import/gltf_textures.h"

namespace sconce {

namespace {

constexpr const char* kTransform = "KHR_texture_transform";

Rgb color(const std::vector<double>& v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

Vec2 pair_of(const tinygltf::Value& object, const char* key, Vec2 otherwise) {
  if (!object.Has(key) || object.Get(key).ArrayLen() != 2) return otherwise;
  const tinygltf::Value &x = object.Get(key).Get(0), &y = object.Get(key).Get(1);
  if (!x.IsNumber() || !y.IsNumber()) return otherwise;
  return {static_cast<float>(x.GetNumberAsDouble()), static_cast<float>(y.GetNumberAsDouble())};
}

TextureUse texture_use(GltfTextures& textures, int index, double texcoord, const tinygltf::Value* transform,
                       const std::string& place) {
  TextureUse use;
  if (index < 0) return use;
  use.texture = textures.load(index, place);
  if (transform != nullptr) {
    use.offset = pair_of(*transform, "offset", use.offset);
    use.scale = pair_of(*transform, "scale", use.scale);
    use.rotation = static_cast<float>(number_of(*transform, "rotation", 0));
    texcoord = number_of(*transform, "texCoord", texcoord);
  }
  use.texcoord = static_cast<uint32_t>(std::clamp(texcoord, 0.0, 1e6));
  return use;
}

TextureUse texture_use(GltfTextures& textures, const tinygltf::TextureInfo& info, const std::string& place) {
  return texture_use(textures, info.index, info.texCoord, extension(info.extensions, kTransform), place);
}

/// A textureInfo within an extension.
TextureUse extension_texture(const tinygltf::Value& info, GltfTextures& textures, const std::string& place) {
  if (!info.IsObject()) return {};
  const tinygltf::Value& extensions = info.Get("extensions");
  const bool moved = extensions.Has(kTransform) && extensions.Get(kTransform).IsObject();
  return texture_use(textures, static_cast<int>(number_of(info, "index", -1)), number_of(info, "texCoord", 0),
                     moved ? &extensions.Get(kTransform) : nullptr, place);
}

/// KHR_materials_pbrSpecularGlossiness: its diffuse part.
void read_diffuse(const tinygltf::Value& e, GltfTextures& textures, const std::string& place, Material& out) {
  out.metallic = 0, out.roughness = 1;
  out.metallic_roughness_texture = {};
  out.base_color = Rgb(1);
  if (e.Has("diffuseFactor") && e.Get("diffuseFactor").ArrayLen() == 4) {
    const auto at = [&](int i) {
      return static_cast<float>(e.Get("diffuseFactor").Get(i).GetNumberAsDouble());
    };
    out.base_color = {at(0), at(1), at(2)};
    out.alpha = at(3);
  }
  if (!e.Has("diffuseTexture") || !e.Get("diffuseTexture").IsObject()) return;
  out.base_color_texture = extension_texture(e.Get("diffuseTexture"), textures, place);
  if (!out.base_color_texture.texture) out.base_color *= kMissingTextureGrey;
}

/// KHR_materials_transmission.
void read_transmission(const tinygltf::Value& e, GltfTextures& textures, const std::string& place,
                       Material& out) {
  out.transmission = static_cast<float>(number_of(e, "transmissionFactor", 0));
  if (out.transmission > 0 && e.Has("transmissionTexture"))
    out.transmission_texture = extension_texture(e.Get("transmissionTexture"), textures, place);
}

Material read_material(const GltfSource& source, const tinygltf::Material& m, GltfTextures& textures,
                       const std::string& place) {
  Material out;
  out.name = m.name;
  const tinygltf::PbrMetallicRoughness& pbr = m.pbrMetallicRoughness;
  if (const auto base = numbers(source, pbr.baseColorFactor, 4, place + ".baseColorFactor")) {
    out.base_color = color(*base);
    out.alpha = static_cast<float>(base->at(3));
  }
  out.metallic = static_cast<float>(pbr.metallicFactor);
  out.roughness = static_cast<float>(pbr.roughnessFactor);
  out.base_color_texture = texture_use(textures, pbr.baseColorTexture, place + ".baseColorTexture");
  if (pbr.baseColorTexture.index >= 0 && !out.base_color_texture.texture)
    out.base_color *= kMissingTextureGrey;
  out.metallic_roughness_texture =
      texture_use(textures, pbr.metallicRoughnessTexture, place + ".metallicRoughness");
  if (const tinygltf::Value* e = extension(m.extensions, "KHR_materials_pbrSpecularGlossiness"))
    read_diffuse(*e, textures, place + ".diffuseTexture", out);
  if (const tinygltf::Value* e = extension(m.extensions, "KHR_materials_transmission"))
    read_transmission(*e, textures, place + ".transmissionTexture", out);

  if (const auto emission = numbers(source, m.emissiveFactor, 3, place + ".emissiveFactor"))
    out.emission = color(*emission);
  if (const tinygltf::Value* e = extension(m.extensions, "KHR_materials_emissive_strength"))
    out.emission *= static_cast<float>(number_of(*e, "emissiveStrength", 1));
  if (out.emits())
    out.emission_texture = texture_use(textures, m.emissiveTexture, place + ".emissiveTexture");

  const tinygltf::NormalTextureInfo& normal = m.normalTexture;
  out.normal_texture = texture_use(textures, normal.index, normal.texCoord,
                                   extension(normal.extensions, kTransform), place + ".normalTexture");
  out.normal_scale = static_cast<float>(normal.scale);

  if (m.alphaMode == "MASK") {
    out.alpha_mode = Material::Alpha::mask;
  } else if (m.alphaMode == "BLEND") {
    out.alpha_mode = Material::Alpha::blend;
  }
  out.alpha_cutoff = static_cast<float>(m.alphaCutoff);
  out.double_sided = m.doubleSided;
  if (extension(m.extensions, "KHR_materials_unlit") != nullptr)
    out.metallic = 0, out.roughness = 1, out.metallic_roughness_texture = {};  // its colour is all it says
  return out;
}

}  // namespace

void read_gltf_materials(const GltfSource& source, Scene& scene, const Progress& progress) {
  GltfTextures textures(source, scene, progress);
  for (std::size_t i = 0; i < source.model.materials.size(); ++i) {
    progress.check();
    progress.at("materials", i, source.model.materials.size());
    const std::string place = "materials[" + std::to_string(i) + "]";
    scene.materials.push_back(read_material(source, source.model.materials[i], textures, place));
  }
}

}  // namespace sconce
