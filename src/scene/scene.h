// SPDX-License-Identifier: Apache-2.0
// The scene as plain data: vectors and typed ids, a value. Whatever is computed from it lives outside.
// Units: metres; lamps in cd (point, spot), lux (sun), cd/m2 (emission, sky); colours linear Rec. 709.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/id.h"
#include "core/rgb.h"
#include "core/vec.h"
#include "image/image.h"
#include "photometry/photometry.h"

namespace sconce {

struct LightField;

struct Texture {
  std::string name;
  Image8 pixels;  ///< as stored (sRGB or data), RGBA or RGB
  std::vector<unsigned char>
      file;          ///< the encoded file, kept so that it can be written out unchanged; may be empty
  std::string mime;  ///< "image/png" or "image/jpeg"; empty when `file` is
  enum class Wrap : uint8_t { repeat, mirror, clamp } wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
  bool nearest = false;  ///< magnification filter
};

/// A texture in a material's slot: uv' = offset + rotate(rotation) * (scale * uv), KHR_texture_transform.
struct TextureUse {
  Id<Texture> texture;
  uint32_t texcoord = 0;  ///< which texture-coordinate set of the mesh
  Vec2 offset{0}, scale{1};
  float rotation = 0;  ///< radians, counter-clockwise

  Vec2 transform(Vec2 uv) const;
};

struct Material {
  std::string name;
  Rgb base_color{1.0f};
  float alpha = 1;
  TextureUse base_color_texture;
  float metallic = 0, roughness = 1;
  TextureUse metallic_roughness_texture;  ///< metallic in blue, roughness in green
  Rgb emission;                           ///< cd/m2, strength already multiplied in
  TextureUse emission_texture;
  TextureUse normal_texture;  ///< in tangent space, x right, y up, z out, stored as (n + 1) / 2
  float normal_scale = 1;     ///< of x and y
  enum class Alpha : uint8_t { opaque, mask, blend } alpha_mode = Alpha::opaque;
  float alpha_cutoff = 0.5f;
  float transmission = 0;  ///< share of the light on the surface that goes straight through, in base colour
  TextureUse transmission_texture;  ///< in red
  bool double_sided = false;

  bool emits() const { return !emission.is_black(); }
  /// Dielectrics no rougher than this show what they mirror; metals always do.
  static constexpr float kGlossy = 0.4f;
  bool mirrors() const {
    return metallic > 0 || roughness <= kGlossy || metallic_roughness_texture.texture.valid();
  }
};

struct Triangle {
  std::array<uint32_t, 3> v;
};

/// Triangles of one material. Faces wind counter-clockwise seen from the front.
struct Mesh {
  std::string name;
  Id<Material> material;
  std::vector<Vec3> positions;
  std::vector<Vec3> normals;                 ///< empty = face normals
  std::vector<glm::vec4> tangents;           ///< empty = by texture coordinates; w = sign of the bitangent
  std::vector<std::vector<Vec2>> texcoords;  ///< set -> vertex
  std::vector<Triangle> triangles;
};

struct LightGroup {
  std::string name;
};

/// A mesh placed in the world.
struct Instance {
  std::string name;  ///< the node's
  Id<Mesh> mesh;
  Mat4 transform{1.0f};      ///< to world
  std::string group_name;    ///< group asked for by the file ("" = none); see scene/groups.h
  Id<LightGroup> group;      ///< assigned by assign_groups(); meaningful where the material emits
  float lightmap_scale = 1;  ///< extras.lightmap_scale: multiplies texel density
  std::string light_name;    ///< extras.light: what this single lamp is called ("" = by its node)
};

struct PointLight {
  float range = 0;  ///< KHR_lights_punctual cut-off in metres, 0 = infinite
};
struct SpotLight {
  float inner = 0, outer = kPi / 4;  ///< half angles, radians
  float range = 0;
};
struct SunLight {};
/// A slide thrown along -z, its rows downwards from +y; Light::intensity is that of the axis where the slide
/// is 1.
struct ProjectorLight {
  std::shared_ptr<const Image> slide;  ///< RGB, linear; row 0 on top
  float yfov = 0.7f;                   ///< radians, vertical
  float aspect = 1;                    ///< width / height of what is thrown
};
/// Light from infinity all around: constant, or a lat-long image (row 0 = up, centre column = -z, contract:
/// docs/formats).
struct SkyLight {
  Image image;  ///< RGB; empty = constant 1
};

/// A measured lamp as its maker's file describes it; lights share it.
struct Luminaire {
  std::string name;  ///< file name
  Photometry photometry;
  /// What lights in place of the table where the lamp was measured from near; of the same flux. Null: from
  /// far only.
  std::shared_ptr<const LightField> field = nullptr;
};
/// A measured lamp in its place: nadir along -z of the frame, C0 along +x. Its intensity is the table's times
/// Light::intensity; its opening spreads it over an area. A light field's sampling plane is the frame's z =
/// 0.
struct LuminaireLight {
  Id<Luminaire> luminaire;
  float exact_below = 0.1f;  ///< light fields: error that their approximation may have by its bound
};

/// A light that is no mesh. Points along -z of its frame. Emissive meshes are area lights by their material.
struct Light {
  std::string name;
  Mat4 frame{1.0f};
  Rgb intensity;  ///< colour x strength: cd (point, spot, projector), lux (sun), cd/m2 factor (sky), factor
                  ///< (luminaire)
  std::variant<PointLight, SpotLight, SunLight, SkyLight, LuminaireLight, ProjectorLight> shape;
  std::string group_name;
  Id<LightGroup> group;
  std::string light_name;  ///< extras.light, as for instances
};

struct Camera {
  std::string name;
  Mat4 frame{1.0f};          ///< looks along -z, y up
  float yfov = 0.8f;         ///< radians, vertical
  float aspect = 16.0f / 9;  ///< width / height
};

struct Scene {
  std::string name;
  std::vector<Texture> textures;
  std::vector<Material> materials;
  std::vector<Mesh> meshes;
  std::vector<Instance> instances;
  std::vector<Luminaire> luminaires;
  std::vector<Light> lights;
  std::vector<LightGroup> groups;  ///< filled by assign_groups()
  std::vector<Camera> cameras;

  template <class T>
  static const T& get(const std::vector<T>& v, Id<T> id) {
    return v.at(id.value);
  }
  const Texture& operator[](Id<Texture> id) const { return get(textures, id); }
  const Material& operator[](Id<Material> id) const { return get(materials, id); }
  const Mesh& operator[](Id<Mesh> id) const { return get(meshes, id); }
  const Instance& operator[](Id<Instance> id) const { return get(instances, id); }
  const Luminaire& operator[](Id<Luminaire> id) const { return get(luminaires, id); }
  const Light& operator[](Id<Light> id) const { return get(lights, id); }
  const LightGroup& operator[](Id<LightGroup> id) const { return get(groups, id); }
  const Camera& operator[](Id<Camera> id) const { return get(cameras, id); }

  bool has_normal_maps() const {
    return std::any_of(materials.begin(), materials.end(),
                       [](const Material& m) { return m.normal_texture.texture.valid(); });
  }
  bool has_mirrors() const {
    return std::any_of(materials.begin(), materials.end(), [](const Material& m) { return m.mirrors(); });
  }
  /// Whether light may pass straight through: blends with some alpha below 1, or transmits. Lamps do not.
  bool passes(const Material& m) const {
    const auto holes = [&](const TextureUse& use) {
      return use.texture.valid() && (*this)[use.texture].pixels.channels % 2 == 0;
    };
    return !m.emits() && (m.transmission > 0 || (m.alpha_mode == Material::Alpha::blend &&
                                                 (m.alpha < 1 || holes(m.base_color_texture))));
  }
  bool has_panes() const {
    return std::any_of(materials.begin(), materials.end(), [this](const Material& m) { return passes(m); });
  }
  bool emits(const Instance& instance) const { return (*this)[(*this)[instance.mesh].material].emits(); }
};

}  // namespace sconce
