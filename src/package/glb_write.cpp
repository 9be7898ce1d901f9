// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <set>

#include "core/error.h"
#include "core/finite.h"
#include "image/io.h"
#include "package/glb.h"
#include "photometry/formats.h"
#include "photometry/light_field.h"

namespace sconce {

using Json = nlohmann::ordered_json;

namespace {

constexpr const char* kLights = "KHR_lights_punctual";
constexpr const char* kIes = "EXT_lights_ies";
constexpr const char* kStrength = "KHR_materials_emissive_strength";
constexpr const char* kTransmission = "KHR_materials_transmission";
constexpr const char* kTransform = "KHR_texture_transform";

// glTF wants colours in [0,1] beside a strength. A power of two as strength loses no bit.
struct Split {
  Rgb color;
  float strength;
};
Split split_strength(const Rgb& c) {
  const float most = c.max();
  if (!(most > 1)) return {c, 1};
  int exponent = 0;
  std::frexp(most, &exponent);
  const float strength = std::ldexp(1.0f, exponent);
  return {c * std::ldexp(1.0f, -exponent), strength};
}

Json array(const Rgb& c) {
  return {c.r, c.g, c.b};
}
Json array(const Vec2& v) {
  return {v.x, v.y};
}
Json array(const Vec3& v) {
  return {v.x, v.y, v.z};
}
Json array(const Mat4& m) {
  Json out = Json::array();
  for (int i = 0; i < 16; ++i) out.push_back(m[i / 4][i % 4]);
  return out;
}

[[noreturn]] void refuse(const std::string& what) {
  throw Error("scene.glb", what + " holds a value that is infinite or not a number");
}

/// JSON would write null there.
void check_finite(const Json& json, const std::string& key) {
  if (json.is_number_float() && !std::isfinite(json.get<double>())) refuse(key);
  if (json.is_structured())
    for (const auto& [name, value] : json.items()) check_finite(value, key + "/" + name);
}

class Writer {
 public:
  Writer(const Scene& scene, const std::string& generator) : scene_(scene) {
    root_["asset"] = {{"version", "2.0"}, {"generator", generator}};
    root_["scene"] = 0;
    root_["scenes"].push_back(Json::object({{"name", scene.name}}));
  }

  std::string run() {
    for (const Texture& texture : scene_.textures) add(texture);
    for (const Material& material : scene_.materials) add(material);
    for (const Mesh& mesh : scene_.meshes) add(mesh);
    for (const Instance& instance : scene_.instances) add(instance);
    for (const Luminaire& luminaire : scene_.luminaires) add(luminaire);
    for (const Light& light : scene_.lights) add(light);
    for (const Camera& camera : scene_.cameras) add(camera);
    Json& top = root_["scenes"][0];
    if (root_.contains("nodes")) {
      top["nodes"] = Json::array();
      for (std::size_t i = 0; i < root_["nodes"].size(); ++i) top["nodes"].push_back(i);
    }
    return container();
  }

 private:
  std::string group_name(Id<LightGroup> group, const std::string& asked) const {
    return group.valid() ? scene_[group].name : asked;
  }

  std::size_t add_view(const void* data, std::size_t size, int target) {
    while (bin_.size() % 4 != 0) bin_ += '\0';
    Json view = {{"buffer", 0}, {"byteOffset", bin_.size()}, {"byteLength", size}};
    if (target != 0) view["target"] = target;
    bin_.append(static_cast<const char*>(data), size);
    root_["bufferViews"].push_back(std::move(view));
    return root_["bufferViews"].size() - 1;
  }

  template <class T>
  std::size_t add_attribute(const std::vector<T>& values, const char* type, const Mesh& mesh) {
    if (first_not_finite({&values.data()->x, values.size() * sizeof(T) / sizeof(float)}))
      refuse("mesh '" + mesh.name + "'");
    const std::size_t view = add_view(values.data(), values.size() * sizeof(T), 34962);
    root_["accessors"].push_back(
        {{"bufferView", view}, {"componentType", 5126}, {"count", values.size()}, {"type", type}});
    return root_["accessors"].size() - 1;
  }

  void add(const Texture& texture) {
    const auto wrap = [](Texture::Wrap w) {
      return w == Texture::Wrap::repeat ? 10497 : w == Texture::Wrap::mirror ? 33648 : 33071;
    };
    const int filter = texture.nearest ? 9728 : 9729;
    root_["samplers"].push_back(
        {{"magFilter", filter}, {"wrapS", wrap(texture.wrap_u)}, {"wrapT", wrap(texture.wrap_v)}});
    Json entry = {{"name", texture.name}, {"sampler", root_["samplers"].size() - 1}};
    if (!texture.pixels.data.empty()) {
      const bool encoded = !texture.file.empty();
      const std::vector<unsigned char> file = encoded ? texture.file : encode_png(texture.pixels);
      root_["images"].push_back({{"name", texture.name},
                                 {"mimeType", encoded ? texture.mime : "image/png"},
                                 {"bufferView", add_view(file.data(), file.size(), 0)}});
      entry["source"] = root_["images"].size() - 1;
    }
    root_["textures"].push_back(std::move(entry));
  }

  Json texture_use(const TextureUse& use) {
    Json out = Json::object({{"index", use.texture.value}});
    if (use.texcoord != 0) out["texCoord"] = use.texcoord;
    if (use.offset != Vec2(0) || use.scale != Vec2(1) || use.rotation != 0) {
      extensions_.insert(kTransform);
      out["extensions"][kTransform] = {
          {"offset", array(use.offset)}, {"rotation", use.rotation}, {"scale", array(use.scale)}};
    }
    return out;
  }

  void add(const Material& m) {
    Json pbr = {{"baseColorFactor", {m.base_color.r, m.base_color.g, m.base_color.b, m.alpha}},
                {"metallicFactor", m.metallic},
                {"roughnessFactor", m.roughness}};
    if (m.base_color_texture.texture) pbr["baseColorTexture"] = texture_use(m.base_color_texture);
    if (m.metallic_roughness_texture.texture)
      pbr["metallicRoughnessTexture"] = texture_use(m.metallic_roughness_texture);
    Json out = {{"name", m.name}, {"pbrMetallicRoughness", std::move(pbr)}};
    if (m.emits()) {
      const Split emission = split_strength(m.emission);
      out["emissiveFactor"] = array(emission.color);
      if (emission.strength != 1) {
        extensions_.insert(kStrength);
        out["extensions"][kStrength] = Json::object({{"emissiveStrength", emission.strength}});
      }
    }
    if (m.emission_texture.texture) out["emissiveTexture"] = texture_use(m.emission_texture);
    if (m.normal_texture.texture) {
      out["normalTexture"] = texture_use(m.normal_texture);
      if (m.normal_scale != 1) out["normalTexture"]["scale"] = m.normal_scale;
    }
    if (m.alpha_mode == Material::Alpha::mask) {
      out["alphaMode"] = "MASK";
      out["alphaCutoff"] = m.alpha_cutoff;
    } else if (m.alpha_mode == Material::Alpha::blend) {
      out["alphaMode"] = "BLEND";
    }
    if (m.transmission > 0) {
      extensions_.insert(kTransmission);
      Json& transmission = out["extensions"][kTransmission];
      transmission = Json::object({{"transmissionFactor", m.transmission}});
      if (m.transmission_texture.texture)
        transmission["transmissionTexture"] = texture_use(m.transmission_texture);
    }
    if (m.double_sided) out["doubleSided"] = true;
    root_["materials"].push_back(std::move(out));
  }

  void add(const Mesh& mesh) {
    if (mesh.triangles.empty() || mesh.positions.empty())
      throw Error("mesh '" + mesh.name + "'", "has no triangles");
    if (!mesh.material) throw Error("mesh '" + mesh.name + "'", "has no material");
    Json attributes;
    attributes["POSITION"] = add_attribute(mesh.positions, "VEC3", mesh);
    Bounds bounds;
    for (const Vec3& p : mesh.positions) bounds.add(p);
    Json& accessor = root_["accessors"].back();
    accessor["min"] = array(bounds.lo);
    accessor["max"] = array(bounds.hi);
    if (!mesh.normals.empty()) attributes["NORMAL"] = add_attribute(mesh.normals, "VEC3", mesh);
    if (!mesh.tangents.empty()) attributes["TANGENT"] = add_attribute(mesh.tangents, "VEC4", mesh);
    for (std::size_t set = 0; set < mesh.texcoords.size(); ++set) {
      // glTF numbers its sets without holes: one that this mesh lacks is written as zeros.
      std::vector<Vec2> uvs = mesh.texcoords[set];
      uvs.resize(mesh.positions.size(), Vec2(0));
      attributes["TEXCOORD_" + std::to_string(set)] = add_attribute(uvs, "VEC2", mesh);
    }
    static_assert(sizeof(Triangle) == 12);
    const std::size_t view = add_view(mesh.triangles.data(), mesh.triangles.size() * sizeof(Triangle), 34963);
    root_["accessors"].push_back({{"bufferView", view},
                                  {"componentType", 5125},
                                  {"count", mesh.triangles.size() * 3},
                                  {"type", "SCALAR"}});
    Json primitive = {{"attributes", std::move(attributes)},
                      {"indices", root_["accessors"].size() - 1},
                      {"material", mesh.material.value}};
    root_["meshes"].push_back({{"name", mesh.name}, {"primitives", Json::array({std::move(primitive)})}});
  }

  Json node(const std::string& name, const Mat4& transform) const {
    Json out = Json::object({{"name", name}});
    if (transform != Mat4(1.0f)) out["matrix"] = array(transform);
    return out;
  }

  void add(const Instance& instance) {
    Json out = node(instance.name, instance.transform);
    out["mesh"] = instance.mesh.value;
    const std::string group = group_name(instance.group, instance.group_name);
    if (!group.empty()) out["extras"]["light_group"] = group;
    if (instance.lightmap_scale != 1) out["extras"]["lightmap_scale"] = instance.lightmap_scale;
    root_["nodes"].push_back(std::move(out));
  }

  /// As LM-63, whatever it came from: numbers are exact in it. What it loses by tilt is in its lights'
  /// intensity.
  void add(const Luminaire& luminaire) {
    Photometry photometry = luminaire.photometry;
    photometry.tilt = {};
    const std::string text = write_ies(photometry);
    extensions_.insert(kIes);
    root_["extensions"][kIes]["lights"].push_back({{"name", luminaire.name},
                                                   {"bufferView", add_view(text.data(), text.size(), 0)},
                                                   {"mimeType", "application/x-ies-lm-63"}});
    if (luminaire.field)
      root_["extensions"][kIes]["lights"].back()["extras"]["light_field"] = field(*luminaire.field);
  }

  Json field(const LightField& f) {
    const std::vector<float>& values = f.is_grey() ? f.irradiance : f.color;
    if (first_not_finite(values)) refuse("a light field");
    return {{"basis", name_of(f.basis)},
            {"columns", f.columns},
            {"rows", f.rows},
            {"spacing", f.spacing},
            {"first", {f.first.x, f.first.y}},
            {"distance", f.distance},
            {"width", f.width},
            {"height", f.height},
            {"corner", {f.corner.x, f.corner.y}},
            {"pixel", f.pixel},
            {"channels", f.is_grey() ? 1 : 3},
            {"bufferView", add_view(values.data(), values.size() * sizeof(float), 0)}};
  }

  void add(const Light& light) {
    const std::string group = group_name(light.group, light.group_name);
    if (std::holds_alternative<SkyLight>(light.shape)) {
      root_["scenes"][0]["extras"]["sky"].push_back(
          {{"name", light.name}, {"light_group", group}, {"matrix", array(light.frame)}});
      return;
    }
    const Split intensity = split_strength(light.intensity);
    if (const auto* measured = std::get_if<LuminaireLight>(&light.shape)) {
      Json placed = node(light.name, light.frame);
      placed["extensions"][kIes] = {{"light", measured->luminaire.value},
                                    {"multiplier", intensity.strength},
                                    {"color", array(intensity.color)}};
      if (!group.empty()) placed["extras"]["light_group"] = group;
      if (scene_[measured->luminaire].field) placed["extras"]["exact_below"] = measured->exact_below;
      root_["nodes"].push_back(std::move(placed));
      return;
    }
    Json out = {{"name", light.name}, {"color", array(intensity.color)}, {"intensity", intensity.strength}};
    if (const auto* point = std::get_if<PointLight>(&light.shape)) {
      out["type"] = "point";
      if (point->range > 0) out["range"] = point->range;
    } else if (const auto* spot = std::get_if<SpotLight>(&light.shape)) {
      out["type"] = "spot";
      out["spot"] = {{"innerConeAngle", spot->inner}, {"outerConeAngle", spot->outer}};
      if (spot->range > 0) out["range"] = spot->range;
    } else if (const auto* projector = std::get_if<ProjectorLight>(&light.shape)) {
      add_projector(*projector, out);
    } else {
      out["type"] = "directional";
    }
    extensions_.insert(kLights);
    Json& list = root_["extensions"][kLights]["lights"];
    list.push_back(std::move(out));
    Json placed = node(light.name, light.frame);
    placed["extensions"][kLights] = Json::object({{"light", list.size() - 1}});
    if (!group.empty()) placed["extras"]["light_group"] = group;
    root_["nodes"].push_back(std::move(placed));
  }

  /// To others a spot that holds the picture.
  void add_projector(const ProjectorLight& p, Json& out) {
    const Image& slide = *p.slide;
    if (first_not_finite(slide.data)) refuse("a projector's slide");
    const float half = std::tan(0.5f * p.yfov);
    out["type"] = "spot";
    out["spot"] = {{"innerConeAngle", 0.0f},
                   {"outerConeAngle", std::atan(half * std::hypot(1.0f, p.aspect))}};
    out["extras"]["projector"] = {
        {"yfov", p.yfov},
        {"aspect", p.aspect},
        {"width", slide.width},
        {"height", slide.height},
        {"bufferView", add_view(slide.data.data(), slide.data.size() * sizeof(float), 0)}};
  }

  void add(const Camera& camera) {
    constexpr double kNear = 0.01;
    root_["cameras"].push_back(
        {{"name", camera.name},
         {"type", "perspective"},
         {"perspective", {{"yfov", camera.yfov}, {"aspectRatio", camera.aspect}, {"znear", kNear}}}});
    Json placed = node(camera.name, camera.frame);
    placed["camera"] = root_["cameras"].size() - 1;
    root_["nodes"].push_back(std::move(placed));
  }

  std::string container() {
    while (bin_.size() % 4 != 0) bin_ += '\0';
    if (!bin_.empty()) root_["buffers"].push_back(Json::object({{"byteLength", bin_.size()}}));
    if (!extensions_.empty()) root_["extensionsUsed"] = extensions_;
    check_finite(root_, "");
    std::string text = root_.dump(-1, ' ', false, Json::error_handler_t::replace);
    while (text.size() % 4 != 0) text += ' ';
    const std::size_t total = 12 + 8 + text.size() + 8 + bin_.size();
    if (total > UINT32_MAX) throw Error("scene.glb", "would be larger than 4 GiB");
    std::string out;
    out.reserve(total);
    const auto word = [&](std::size_t v) {
      for (int shift = 0; shift < 32; shift += 8) out += static_cast<char>((v >> shift) & 255);
    };
    word(0x46546c67);
    word(2);
    word(total);
    word(text.size());
    word(0x4e4f534a);
    out += text;
    word(bin_.size());
    word(0x004e4942);
    out += bin_;
    return out;
  }

  const Scene& scene_;
  Json root_;
  std::set<std::string> extensions_;
  std::string bin_;
};

}  // namespace

std::string write_glb(const Scene& scene, const std::string& generator) {
  return Writer(scene, generator).run();
}

}  // namespace sconce
