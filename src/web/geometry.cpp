// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstring>
#include <unordered_map>

#include "gpu/surface_vertices.h"
#include "image/io.h"
#include "image/webp.h"
#include "web/parts.h"

namespace sconce::web {

namespace {

using gpu::SurfaceVertex;

/// Lightmap places as 16-bit fractions, page + 1.
std::array<uint16_t, 3> lightmap_code(const Vec3& place) {
  const auto code = [](float v) {
    return static_cast<uint16_t>(std::lround(std::clamp(v, 0.0f, 1.0f) * 65535));
  };
  if (place.z < 0) return {0, 0, 0};
  return {code(place.x), code(place.y), static_cast<uint16_t>(place.z + 1)};
}

template <std::size_t N>
using Codes = std::array<int16_t, N>;

/// Components of unit vectors, in 1/32767.
template <std::size_t N, class V>
Codes<N> codes_of(const V& v) {
  Codes<N> out;
  for (std::size_t i = 0; i < N; ++i)
    out[i] = static_cast<int16_t>(std::lround(32767 * std::clamp(v[static_cast<int>(i)], -1.0f, 1.0f)));
  return out;
}

/// A corner of a triangle; the rest is zero unless normal maps are shown.
struct Vertex {
  SurfaceVertex surface;
  Vec2 normal_place{0};
  Codes<3> normal{}, face{};  ///< the face's where there is no normal
  Codes<4> tangent{};         ///< see map_tangents()
};
static_assert(sizeof(Vertex) == sizeof(SurfaceVertex) + sizeof(Vec2) + 10 * sizeof(int16_t));

Vertex bent_vertex(const ShownScene& shown, std::size_t triangle, std::size_t corner,
                   const glm::vec4& tangent) {
  const World& world = shown.world;
  const Vec3 &normal = world.normals[world.triangles[triangle].v[corner]],
             &face = world.face_normals[triangle];
  const Vec3 along(tangent);
  const float length = glm::length(along);
  const Vec3 unit = length > 0 ? along / length : Vec3(0);
  return {gpu::surface_vertex(shown, triangle, corner),
          gpu::place_in(shown.scene[world.materials[triangle]].normal_texture, world, triangle, corner),
          codes_of<3>(normal == Vec3(0) ? face : normal), codes_of<3>(face),
          codes_of<4>(glm::vec4(unit, tangent.w < 0 ? -1.0f : 1.0f))};
}

struct Streams {
  std::vector<Vec3> positions;
  std::vector<Vec2> base, metallic, emission, normal;
  std::vector<Codes<3>> normals, faces;
  std::vector<Codes<4>> tangents;
  std::vector<std::array<uint16_t, 3>> front, back;
  std::vector<uint32_t> indices;
};

/// Equal vertices once.
class VertexPool {
 public:
  explicit VertexPool(Streams& out) : out_(out) {}
  void add(const Vertex& vertex) {
    const SurfaceVertex& v = vertex.surface;
    std::string key(reinterpret_cast<const char*>(&vertex), sizeof vertex);
    const auto [at, is_new] = seen_.try_emplace(std::move(key), static_cast<uint32_t>(out_.positions.size()));
    out_.indices.push_back(at->second);
    if (!is_new) return;
    out_.positions.push_back(v.position);
    out_.base.push_back(v.base);
    out_.metallic.push_back(v.metallic);
    out_.emission.push_back(v.emission);
    out_.front.push_back(lightmap_code(v.front));
    out_.back.push_back(lightmap_code(v.back));
    out_.normal.push_back(vertex.normal_place);
    out_.normals.push_back(vertex.normal);
    out_.faces.push_back(vertex.face);
    out_.tangents.push_back(vertex.tangent);
  }

 private:
  Streams& out_;
  std::unordered_map<std::string, uint32_t> seen_;
};

/// As it was stored, or without loss as WebP, which often takes half of a PNG's bytes. @return and its ending
std::pair<std::vector<unsigned char>, std::string> picture_file(const Texture& texture) {
  if (texture.mime == "image/webp" && !texture.file.empty()) return {texture.file, "webp"};
  if (texture.mime == "image/jpeg" && !texture.file.empty()) return {texture.file, "jpg"};
  const std::vector<unsigned char> png = texture.file.empty() ? encode_png(texture.pixels) : texture.file;
  const std::vector<unsigned char> webp = encode_webp(texture.pixels);
  if (!webp.empty() && webp.size() < png.size()) return {webp, "webp"};
  return {png, "png"};
}

}  // namespace

Json write_geometry(SiteFiles& files, const ShownScene& shown, bool normal_maps) {
  Streams streams;
  VertexPool pool(streams);
  Json batches = Json::array();
  for (const gpu::SurfaceBatch& batch : gpu::surface_batches(shown)) {
    batches.push_back({{"material", batch.material.value},
                       {"group", json_of(batch.group)},
                       {"first", streams.indices.size()},
                       {"count", 3 * batch.triangles.size()}});
    for (const uint32_t t : batch.triangles) {
      const auto tangents =
          normal_maps ? map_tangents(shown.scene, shown.world, t) : std::array<glm::vec4, 3>{};
      for (std::size_t k = 0; k < 3; ++k)
        pool.add(normal_maps ? bent_vertex(shown, t, k, tangents[k])
                             : Vertex{gpu::surface_vertex(shown, t, k)});
    }
  }
  const auto used = [&](TextureUse Material::*slot) {
    return std::any_of(shown.scene.materials.begin(), shown.scene.materials.end(),
                       [&](const Material& m) { return (m.*slot).texture.valid(); });
  };
  const Bounds& bounds = shown.world.bounds;
  Json out = {{"vertices", streams.positions.size()},
              {"bounds", {{bounds.lo.x, bounds.lo.y, bounds.lo.z}, {bounds.hi.x, bounds.hi.y, bounds.hi.z}}},
              {"batches", std::move(batches)}};
  Json& parts = out["streams"];
  parts["indices"] = files.write_packed("indices.bin", streams.indices);
  parts["positions"] = files.write_packed("positions.bin", streams.positions);
  parts["front"] = files.write_packed("front.bin", streams.front);
  const bool backs =
      std::any_of(streams.back.begin(), streams.back.end(), [](const auto& b) { return b[2] != 0; });
  if (backs) parts["back"] = files.write_packed("back.bin", streams.back);
  if (used(&Material::base_color_texture)) parts["base"] = files.write_packed("base.bin", streams.base);
  if (used(&Material::metallic_roughness_texture))
    parts["metallic"] = files.write_packed("metallic.bin", streams.metallic);
  if (used(&Material::emission_texture))
    parts["emission"] = files.write_packed("emission.bin", streams.emission);
  if (normal_maps) {
    parts["normal"] = files.write_packed("normal.bin", streams.normal);
    parts["normals"] = files.write_packed("normals.bin", streams.normals);
    parts["faces"] = files.write_packed("faces.bin", streams.faces);
    parts["tangents"] = files.write_packed("tangents.bin", streams.tangents);
  }
  return out;
}

Json write_materials(const Scene& scene, bool normal_maps) {
  Json out = Json::array();
  for (const Material& m : scene.materials)
    out.push_back({{"name", m.name},
                   {"baseColor", json_of(m.base_color)},
                   {"alpha", m.alpha},
                   {"alphaCutoff", m.alpha_mode == Material::Alpha::mask ? m.alpha_cutoff : -1.0f},
                   {"metallic", m.metallic},
                   {"emission", json_of(m.emission)},
                   {"doubleSided", m.double_sided},
                   {"blends", scene.passes(m) && m.alpha_mode == Material::Alpha::blend},
                   {"transmission", scene.passes(m) ? m.transmission * (1 - m.metallic) : 0.0f},
                   {"baseMap", json_of(m.base_color_texture.texture)},
                   {"metallicMap", json_of(m.metallic_roughness_texture.texture)},
                   {"emissionMap", json_of(m.emits() ? m.emission_texture.texture : Id<Texture>())},
                   {"normalMap", json_of(normal_maps ? m.normal_texture.texture : Id<Texture>())},
                   {"normalScale", m.normal_scale}});
  return out;
}

Json write_textures(SiteFiles& files, const Scene& scene, bool normal_maps) {
  constexpr const char* kWrap[] = {"repeat", "mirror", "clamp"};
  std::vector<bool> used(scene.textures.size(), false);
  for (const Material& m : scene.materials) {
    for (const TextureUse& use : {m.base_color_texture, m.metallic_roughness_texture, m.emission_texture})
      if (use.texture) used[use.texture.value] = true;
    if (normal_maps && m.normal_texture.texture) used[m.normal_texture.texture.value] = true;
  }
  Json out = Json::array();
  for (std::size_t i = 0; i < scene.textures.size(); ++i) {
    const Texture& texture = scene.textures[i];
    Json entry = Json::object();
    if (used[i] && !texture.pixels.data.empty()) {
      const auto [file, extension] = picture_file(texture);
      entry = files.write("texture-" + std::to_string(i) + "." + extension,
                          [&] { return std::string(file.begin(), file.end()); });
      entry["wrap"] = {kWrap[static_cast<std::size_t>(texture.wrap_u)],
                       kWrap[static_cast<std::size_t>(texture.wrap_v)]};
      entry["nearest"] = texture.nearest;
    }
    out.push_back(std::move(entry));
  }
  return out;
}

Json write_skies(SiteFiles& files, const Scene& scene) {
  Json out = Json::array();
  for (const Light& light : scene.lights) {
    const auto* sky = std::get_if<SkyLight>(&light.shape);
    if (sky == nullptr) continue;
    Image image = sky->image;
    if (image.data.empty()) {
      image = Image::rgb(1, 1);
      image.data = {1, 1, 1};
    }
    const EncodedImage codes = encode(image, find_encoding("rgbe8"));
    Json entry = files.write_packed("sky-" + std::to_string(out.size()) + ".bin", codes.data, 4);
    entry["width"] = image.width;
    entry["height"] = image.height;
    entry["group"] = json_of(light.group);
    entry["scale"] = json_of(light.intensity);
    Json& axes = entry["axes"];  // of its frame in the world: x, y, z
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) axes.push_back(light.frame[i][k]);
    out.push_back(std::move(entry));
  }
  return out;
}

}  // namespace sconce::web
