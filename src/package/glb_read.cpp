// SPDX-License-Identifier: Apache-2.0
#include <cstring>

#include "core/error.h"
#include "core/finite.h"
#include "image/io.h"
#include "package/glb.h"
#include "package/json.h"
#include "photometry/formats.h"
#include "photometry/light_field.h"

namespace sconce {

namespace {

constexpr const char* kLights = "KHR_lights_punctual";
constexpr const char* kStrength = "KHR_materials_emissive_strength";
constexpr const char* kTransmission = "KHR_materials_transmission";
constexpr const char* kIes = "EXT_lights_ies";

uint32_t word(std::string_view bytes, std::size_t offset) {
  uint32_t v = 0;
  for (std::size_t i = 0; i < 4; ++i)
    v |= static_cast<uint32_t>(static_cast<unsigned char>(bytes[offset + i])) << (8 * i);
  return v;
}

struct Chunks {
  std::string_view json, bin;
};

Chunks split_chunks(std::string_view bytes, const std::string& where) {
  const auto damaged = [&](const char* what) -> void {
    throw Error(where, std::string("is damaged: ") + what);
  };
  if (bytes.size() < 20 || word(bytes, 0) != 0x46546c67) damaged("no glb header");
  if (word(bytes, 4) != 2) damaged("not glTF version 2");
  if (word(bytes, 8) != bytes.size()) damaged("its length is not the header's");
  Chunks chunks;
  for (std::size_t at = 12; at < bytes.size();) {
    if (bytes.size() - at < 8 || word(bytes, at) > bytes.size() - at - 8)
      damaged("a chunk ends beyond the file");
    const std::string_view body = bytes.substr(at + 8, word(bytes, at));
    if (word(bytes, at + 4) == 0x4e4f534a) chunks.json = body;
    if (word(bytes, at + 4) == 0x004e4942) chunks.bin = body;
    at += 8 + body.size();
  }
  if (chunks.json.empty()) damaged("no JSON chunk");
  return chunks;
}

class Reader {
 public:
  Reader(std::string_view bytes, const std::string& where)
      : where_(where), chunks_(split_chunks(bytes, where)), root_(JsonValue::parse(chunks_.json, where)) {}

  Scene run() {
    const JsonValue top = root_.at("scenes").at(std::size_t{0});
    scene_.name = top.text("name", "");
    each(root_, "textures", [&](const JsonValue& v) { scene_.textures.push_back(texture(v)); });
    each(root_, "materials", [&](const JsonValue& v) { scene_.materials.push_back(material(v)); });
    each(root_, "meshes", [&](const JsonValue& v) { scene_.meshes.push_back(mesh(v)); });
    if (root_.has("extensions") && root_.at("extensions").has(kIes))
      each(root_.at("extensions").at(kIes), "lights", [&](const JsonValue& v) { luminaire(v); });
    each(root_, "nodes", [&](const JsonValue& v) { node(v); });
    if (top.has("extras")) each(top.at("extras"), "sky", [&](const JsonValue& v) { sky(v); });
    return std::move(scene_);
  }

 private:
  template <class F>
  static void each(const JsonValue& parent, const std::string& key, const F& f) {
    if (!parent.has(key)) return;
    const JsonValue list = parent.at(key);
    for (std::size_t i = 0; i < list.size(); ++i) f(list.at(i));
  }

  std::string_view view(const JsonValue& index) const {
    const JsonValue views = root_.at("bufferViews");
    const JsonValue v = views.at(index.index(views.size()));
    const auto size = static_cast<int64_t>(chunks_.bin.size());
    const int64_t offset = v.at("byteOffset").integer(0, size);
    const int64_t length = v.at("byteLength").integer(0, size - offset);
    return chunks_.bin.substr(static_cast<std::size_t>(offset), static_cast<std::size_t>(length));
  }

  template <class T>
  std::vector<T> values(const JsonValue& index, const char* type, int component,
                        std::size_t per_value) const {
    const JsonValue accessors = root_.at("accessors");
    const JsonValue a = accessors.at(index.index(accessors.size()));
    if (a.at("type").text() != type) a.at("type").fail("is '" + a.at("type").text() + "'", type);
    a.at("componentType").integer(component, component);
    const std::string_view bytes = view(a.at("bufferView"));
    const auto most = static_cast<int64_t>(bytes.size() / sizeof(T) * per_value);
    const auto count = static_cast<std::size_t>(a.at("count").integer(0, most));
    if (count % per_value != 0) a.at("count").fail("is no multiple of " + std::to_string(per_value));
    std::vector<T> out(count / per_value);
    if (!out.empty()) std::memcpy(static_cast<void*>(out.data()), bytes.data(), out.size() * sizeof(T));
    return out;
  }

  Texture texture(const JsonValue& v) const {
    Texture out;
    out.name = v.text("name", "");
    const JsonValue samplers = root_.at("samplers");
    const JsonValue sampler = samplers.at(v.at("sampler").index(samplers.size()));
    const auto wrap = [&](const char* key) {
      const int64_t code = sampler.at(key).integer(0, 0xffff);
      return code == 33648   ? Texture::Wrap::mirror
             : code == 33071 ? Texture::Wrap::clamp
                             : Texture::Wrap::repeat;
    };
    out.wrap_u = wrap("wrapS");
    out.wrap_v = wrap("wrapT");
    out.nearest = sampler.at("magFilter").integer(0, 0xffff) == 9728;
    if (!v.has("source")) return out;
    const JsonValue images = root_.at("images");
    const JsonValue image = images.at(v.at("source").index(images.size()));
    const std::string_view bytes = view(image.at("bufferView"));
    out.file.assign(bytes.begin(), bytes.end());
    out.mime = image.at("mimeType").text();
    out.pixels = decode_image8(out.file, where_ + ", texture '" + out.name + "'");
    return out;
  }

  TextureUse texture_use(const JsonValue& parent, const std::string& key) const {
    TextureUse use;
    if (!parent.has(key)) return use;
    const JsonValue v = parent.at(key);
    use.texture = Id<Texture>(v.at("index").index(scene_.textures.size()));
    if (v.has("texCoord")) use.texcoord = static_cast<uint32_t>(v.at("texCoord").integer(0, 255));
    if (!v.has("extensions")) return use;
    const JsonValue transform = v.at("extensions").at("KHR_texture_transform");
    use.offset = transform.at("offset").vec2();
    use.rotation = transform.at("rotation").real();
    use.scale = transform.at("scale").vec2();
    return use;
  }

  Material material(const JsonValue& v) const {
    Material m;
    m.name = v.text("name", "");
    const JsonValue pbr = v.at("pbrMetallicRoughness"), base = pbr.at("baseColorFactor");
    if (base.size() != 4) base.fail("is no colour", "four numbers");
    m.base_color = {base.at(0).real(), base.at(1).real(), base.at(2).real()};
    m.alpha = base.at(3).real();
    m.metallic = pbr.at("metallicFactor").real();
    m.roughness = pbr.at("roughnessFactor").real();
    m.base_color_texture = texture_use(pbr, "baseColorTexture");
    m.metallic_roughness_texture = texture_use(pbr, "metallicRoughnessTexture");
    if (v.has("emissiveFactor")) m.emission = v.at("emissiveFactor").rgb();
    if (v.has("extensions")) {
      const JsonValue extensions = v.at("extensions");
      if (extensions.has(kStrength)) m.emission *= extensions.at(kStrength).at("emissiveStrength").real();
      if (extensions.has(kTransmission)) {
        m.transmission = extensions.at(kTransmission).at("transmissionFactor").real();
        m.transmission_texture = texture_use(extensions.at(kTransmission), "transmissionTexture");
      }
    }
    m.emission_texture = texture_use(v, "emissiveTexture");
    m.normal_texture = texture_use(v, "normalTexture");
    if (v.has("normalTexture")) m.normal_scale = static_cast<float>(v.at("normalTexture").number("scale", 1));
    const std::string alpha = v.text("alphaMode", "OPAQUE");
    m.alpha_mode = alpha == "MASK"    ? Material::Alpha::mask
                   : alpha == "BLEND" ? Material::Alpha::blend
                                      : Material::Alpha::opaque;
    m.alpha_cutoff = static_cast<float>(v.number("alphaCutoff", 0.5));
    m.double_sided = v.flag("doubleSided", false);
    return m;
  }

  Mesh mesh(const JsonValue& v) const {
    Mesh m;
    m.name = v.text("name", "");
    const JsonValue primitive = v.at("primitives").at(std::size_t{0}),
                    attributes = primitive.at("attributes");
    m.material = Id<Material>(primitive.at("material").index(scene_.materials.size()));
    m.positions = values<Vec3>(attributes.at("POSITION"), "VEC3", 5126, 1);
    if (attributes.has("NORMAL")) {
      m.normals = values<Vec3>(attributes.at("NORMAL"), "VEC3", 5126, 1);
      if (m.normals.size() != m.positions.size())
        attributes.at("NORMAL").fail("has another count than POSITION");
    }
    if (attributes.has("TANGENT")) {
      m.tangents = values<glm::vec4>(attributes.at("TANGENT"), "VEC4", 5126, 1);
      if (m.tangents.size() != m.positions.size())
        attributes.at("TANGENT").fail("has another count than POSITION");
    }
    for (std::size_t set = 0; attributes.has("TEXCOORD_" + std::to_string(set)); ++set) {
      const JsonValue uv = attributes.at("TEXCOORD_" + std::to_string(set));
      m.texcoords.push_back(values<Vec2>(uv, "VEC2", 5126, 1));
      if (m.texcoords.back().size() != m.positions.size()) uv.fail("has another count than POSITION");
    }
    const JsonValue indices = primitive.at("indices");
    m.triangles = values<Triangle>(indices, "SCALAR", 5125, 3);
    for (const Triangle& t : m.triangles)
      for (const uint32_t i : t.v)
        if (i >= m.positions.size())
          indices.fail("names vertex " + std::to_string(i) + ", which is not there");
    return m;
  }

  static std::string group_of(const JsonValue& v) {
    return v.has("extras") ? v.at("extras").text("light_group", "") : std::string();
  }

  void node(const JsonValue& v) {
    const std::string name = v.text("name", "");
    const Mat4 matrix = v.has("matrix") ? v.at("matrix").matrix() : Mat4(1.0f);
    if (v.has("mesh")) {
      Instance out;
      out.name = name;
      out.mesh = Id<Mesh>(v.at("mesh").index(scene_.meshes.size()));
      out.transform = matrix;
      out.group_name = group_of(v);
      if (v.has("extras"))
        out.lightmap_scale = static_cast<float>(v.at("extras").number("lightmap_scale", 1));
      scene_.instances.push_back(std::move(out));
    } else if (v.has("camera")) {
      const JsonValue cameras = root_.at("cameras");
      const JsonValue camera = cameras.at(v.at("camera").index(cameras.size())), p = camera.at("perspective");
      scene_.cameras.push_back(
          {camera.text("name", ""), matrix, p.at("yfov").real(), p.at("aspectRatio").real()});
    } else if (v.has("extensions") && v.at("extensions").has(kIes)) {
      const JsonValue use = v.at("extensions").at(kIes);
      Light light;
      light.name = name;
      light.frame = matrix;
      light.group_name = group_of(v);
      light.intensity = use.at("color").rgb() * use.at("multiplier").real();
      LuminaireLight measured{Id<Luminaire>(use.at("light").index(scene_.luminaires.size()))};
      if (v.has("extras")) measured.exact_below = static_cast<float>(v.at("extras").number("exact_below", 0));
      light.shape = measured;
      scene_.lights.push_back(std::move(light));
    } else if (v.has("extensions")) {
      const JsonValue lights = root_.at("extensions").at(kLights).at("lights");
      Light light = punctual(lights.at(v.at("extensions").at(kLights).at("light").index(lights.size())));
      light.frame = matrix;
      light.group_name = group_of(v);
      scene_.lights.push_back(std::move(light));
    }
  }

  void luminaire(const JsonValue& v) {
    const std::string name = v.at("name").text();
    scene_.luminaires.push_back(
        {name, parse_ies(view(v.at("bufferView")), where_ + ", luminaire '" + name + "'")});
    if (v.has("extras") && v.at("extras").has("light_field"))
      scene_.luminaires.back().field = std::make_shared<LightField>(field(v.at("extras").at("light_field")));
  }

  LightField field(const JsonValue& v) {
    const auto count = [&](const char* key, int64_t most) {
      return static_cast<int>(v.at(key).integer(1, most));
    };
    const auto pair = [&](const char* key) {
      return glm::dvec2(v.at(key).at(std::size_t{0}).number(), v.at(key).at(std::size_t{1}).number());
    };
    LightField out;
    const std::optional<NearBasis> basis = basis_named(v.at("basis").text());
    if (!basis) v.at("basis").fail("is '" + v.at("basis").text() + "'", "bell, spline");
    out.basis = *basis;
    out.columns = count("columns", 1000), out.rows = count("rows", 1000);
    out.width = count("width", 1 << 16), out.height = count("height", 1 << 16);
    out.spacing = v.at("spacing").number(), out.distance = v.at("distance").number();
    out.pixel = v.at("pixel").number();
    if (!(out.spacing > 0 && out.distance > 0 && out.pixel > 0))
      v.fail("has a spacing, distance or pixel that is not positive");
    out.first = pair("first"), out.corner = pair("corner");
    const std::string_view bytes = view(v.at("bufferView"));
    const bool grey = v.number("channels", 1) != 3;
    std::vector<float>& values = grey ? out.irradiance : out.color;
    const std::size_t wanted = out.terms() * out.pixels() * (grey ? 1 : 3);
    if (bytes.size() != wanted * sizeof(float))
      v.at("bufferView").fail("does not hold as many values as the light field has");
    values.resize(wanted);
    std::memcpy(values.data(), bytes.data(), bytes.size());
    if (!grey) set_luminance(out);
    return out;
  }

  ProjectorLight projector(const JsonValue& v) const {
    const auto side = [&](const char* key) { return static_cast<int>(v.at(key).integer(1, 1 << 16)); };
    Image slide = Image::rgb(0, 0);
    slide.width = side("width"), slide.height = side("height");
    const std::string_view bytes = view(v.at("bufferView"));
    if (bytes.size() != slide.pixels() * sizeof(Rgb))
      v.at("bufferView").fail("does not hold as many pixels as the slide has");
    slide.data.resize(3 * slide.pixels());
    std::memcpy(slide.data.data(), bytes.data(), bytes.size());
    if (!all_light(slide.data)) v.at("bufferView").fail("has pixels that are negative or no numbers");
    const float yfov = v.at("yfov").real(), aspect = v.at("aspect").real();
    if (!(yfov > 0 && yfov < kPi && aspect > 0))
      v.fail("has a yfov or aspect out of range", "0 < yfov < pi, aspect > 0");
    return {std::make_shared<Image>(std::move(slide)), yfov, aspect};
  }

  Light punctual(const JsonValue& v) const {
    Light light;
    light.name = v.text("name", "");
    light.intensity = v.at("color").rgb() * v.at("intensity").real();
    const auto range = static_cast<float>(v.number("range", 0));
    const std::string type = v.at("type").text();
    if (type == "point") {
      light.shape = PointLight{range};
    } else if (type == "spot") {
      const JsonValue spot = v.at("spot");
      light.shape = SpotLight{spot.at("innerConeAngle").real(), spot.at("outerConeAngle").real(), range};
      if (v.has("extras") && v.at("extras").has("projector"))
        light.shape = projector(v.at("extras").at("projector"));
    } else if (type == "directional") {
      light.shape = SunLight{};
    } else {
      v.at("type").fail("is '" + type + "'", "point, spot, directional");
    }
    return light;
  }

  void sky(const JsonValue& v) {
    Light light;
    light.name = v.at("name").text();
    light.group_name = v.at("light_group").text();
    light.frame = v.at("matrix").matrix();
    light.intensity = Rgb(1);
    light.shape = SkyLight{};
    scene_.lights.push_back(std::move(light));
  }

  std::string where_;
  Chunks chunks_;
  JsonValue root_;
  Scene scene_;
};

}  // namespace

Scene read_glb(std::string_view bytes, const std::string& where) {
  return Reader(bytes, where).run();
}

}  // namespace sconce
