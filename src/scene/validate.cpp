// SPDX-License-Identifier: Apache-2.0
#include "scene/validate.h"

#include <algorithm>
#include <set>

namespace sconce {

namespace {

constexpr float kBrightAlbedo = 0.95f;   // above it light hardly ever ends, and no real paint reaches it
constexpr float kSmallScene = 0.1f;      // metres across: probably not in metres
constexpr float kLargeScene = 10000.0f;  // likewise

bool finite(float v) {
  return std::isfinite(v);
}
bool finite(const Vec2& v) {
  return finite(v.x) && finite(v.y);
}
bool finite(const Vec3& v) {
  return finite(v.x) && finite(v.y) && finite(v.z);
}
bool finite(const Rgb& c) {
  return finite(c.r) && finite(c.g) && finite(c.b);
}
bool finite(const Mat4& m) {
  for (int i = 0; i < 4; ++i)
    if (!finite(Vec3(m[i]))) return false;
  return true;
}

std::string quoted(const std::string& name) {
  return "'" + name + "'";
}

template <class T>
void check_id(Id<T> id, std::size_t size, const std::string& where) {
  if (id.value >= size)
    throw Error(where, "index " + std::to_string(id.value) + " is out of range",
                "0 to " + std::to_string(size) + " exclusive");
}

class Validator {
 public:
  Validator(Scene& scene, const Progress& progress) : scene_(scene), progress_(progress) {}

  void run() {
    for (Material& material : scene_.materials) check(material);
    for (Mesh& mesh : scene_.meshes) check(mesh);
    check_instances();
    check_texcoords();
    std::erase_if(scene_.lights, [&](Light& light) { return !check(light); });
    std::erase_if(scene_.cameras, [&](const Camera& camera) { return !check(camera); });
    check_size();
    check_albedos();
  }

 private:
  void warn(const std::string& line) const { progress_.warn(scene_.name + ": " + line); }

  /// Colours are finite and not negative.
  void mend(Rgb& color, const std::string& what) {
    if (finite(color) && color.r >= 0 && color.g >= 0 && color.b >= 0) return;
    for (float* c : {&color.r, &color.g, &color.b}) *c = finite(*c) ? std::max(0.0f, *c) : 0.0f;
    warn(what + " is negative or not a number; 0 is used there");
  }

  void check(Material& m) {
    const std::string what = "material " + quoted(m.name);
    for (TextureUse* use : {&m.base_color_texture, &m.metallic_roughness_texture, &m.emission_texture,
                            &m.normal_texture, &m.transmission_texture}) {
      if (use->texture)
        check_id(use->texture, scene_.textures.size(), scene_.name + ": " + what + ": texture");
      if (!finite(use->offset) || !finite(use->scale) || !finite(use->rotation)) {
        use->offset = Vec2(0), use->scale = Vec2(1), use->rotation = 0;
        warn(what + " has a texture transform that is not a number; it is ignored");
      }
    }
    if (!finite(m.normal_scale)) m.normal_scale = 1;
    mend(m.base_color, what + ": base colour");
    mend(m.emission, what + ": emission");
    const auto clamp = [&](float& v, const char* name) {
      if (v >= 0 && v <= 1) return;
      v = finite(v) ? std::clamp(v, 0.0f, 1.0f) : 0.0f;
      warn(what + ": " + name + " is outside of 0 to 1; clamped");
    };
    clamp(m.metallic, "metallic");
    clamp(m.roughness, "roughness");
    clamp(m.alpha, "alpha");
    clamp(m.transmission, "transmission");
    if (!(m.alpha_cutoff >= 0)) m.alpha_cutoff = 0.5f;
    if (m.base_color.max() > 1) {
      warn(what + " reflects more than it gets; base colour clamped to 1");
      for (float* c : {&m.base_color.r, &m.base_color.g, &m.base_color.b}) *c = std::min(*c, 1.0f);
    }
    if (!m.base_color_texture.texture && !m.emits() && !scene_.passes(m) &&
        m.base_color.max() > kBrightAlbedo)
      bright_.push_back(quoted(m.name));
  }

  void check(Mesh& mesh) {
    const std::string where = scene_.name + ": mesh " + quoted(mesh.name);
    check_id(mesh.material, scene_.materials.size(), where + ": material");
    const std::size_t count = mesh.positions.size();
    if (!mesh.normals.empty() && mesh.normals.size() != count)
      throw Error(
          where, std::to_string(mesh.normals.size()) + " normals for " + std::to_string(count) + " vertices");
    if (!mesh.tangents.empty() && mesh.tangents.size() != count)
      throw Error(where, std::to_string(mesh.tangents.size()) + " tangents for " + std::to_string(count) +
                             " vertices");
    for (const auto& set : mesh.texcoords)
      if (!set.empty() && set.size() != count)
        throw Error(where, std::to_string(set.size()) + " texture coordinates for " + std::to_string(count) +
                               " vertices");
    for (const Triangle& t : mesh.triangles)
      for (const uint32_t v : t.v)
        if (v >= count)
          throw Error(where, "vertex " + std::to_string(v) + " is out of range",
                      "0 to " + std::to_string(count) + " exclusive");

    const std::size_t before = mesh.triangles.size();
    std::erase_if(mesh.triangles, [&](const Triangle& t) {
      return std::any_of(t.v.begin(), t.v.end(), [&](uint32_t v) { return !finite(mesh.positions[v]); });
    });
    for (Vec3& p : mesh.positions)
      if (!finite(p)) p = Vec3(0);
    for (Vec3& n : mesh.normals)
      if (!finite(n)) n = Vec3(0);
    for (glm::vec4& t : mesh.tangents)
      if (!finite(Vec3(t)) || !finite(t.w)) t = glm::vec4(0);
    for (auto& set : mesh.texcoords)
      for (Vec2& uv : set)
        if (!finite(uv)) uv = Vec2(0);
    if (mesh.triangles.size() < before)
      warn("mesh " + quoted(mesh.name) + ": " + std::to_string(before - mesh.triangles.size()) +
           " triangles with positions that are not numbers are left out");
  }

  void check_instances() {
    std::erase_if(scene_.instances, [&](Instance& instance) {
      const std::string what = "instance " + quoted(instance.name);
      check_id(instance.mesh, scene_.meshes.size(), scene_.name + ": " + what + ": mesh");
      if (!finite(instance.transform)) {
        warn(what + " has a transform that is not a number; left out");
        return true;
      }
      if (!(instance.lightmap_scale > 0) || !finite(instance.lightmap_scale)) instance.lightmap_scale = 1;
      return false;
    });
  }

  void check_texcoords() {
    std::set<std::pair<uint32_t, uint32_t>> told;  // material, set
    for (const Instance& instance : scene_.instances) {
      const Mesh& mesh = scene_[instance.mesh];
      const Material& m = scene_[mesh.material];
      for (const TextureUse* use : {&m.base_color_texture, &m.metallic_roughness_texture, &m.emission_texture,
                                    &m.normal_texture, &m.transmission_texture}) {
        if (!use->texture ||
            (use->texcoord < mesh.texcoords.size() && !mesh.texcoords[use->texcoord].empty()))
          continue;
        if (told.insert({mesh.material.value, use->texcoord}).second)
          warn("mesh " + quoted(mesh.name) + " lacks texture coordinates " + std::to_string(use->texcoord) +
               " that material " + quoted(m.name) + " asks for; 0, 0 is used");
      }
    }
  }

  bool check(Light& light) {
    const std::string what = "light " + quoted(light.name);
    if (!finite(light.frame)) {
      warn(what + " stands at a place that is not a number; left out");
      return false;
    }
    mend(light.intensity, what + ": intensity");
    if (auto* spot = std::get_if<SpotLight>(&light.shape)) {
      const bool fits =
          spot->inner >= 0 && spot->inner <= spot->outer && spot->outer > 0 && spot->outer <= kPi;
      if (!fits) {
        warn(what + ": cone angles are out of range; clamped");
        spot->outer = spot->outer > 0 ? std::min(spot->outer, kPi) : kPi / 4;
        spot->inner = spot->inner >= 0 ? std::min(spot->inner, spot->outer) : 0.0f;
      }
    }
    if (const auto* measured = std::get_if<LuminaireLight>(&light.shape))
      check_id(measured->luminaire, scene_.luminaires.size(), scene_.name + ": " + what + ": luminaire");
    if (const auto* projector = std::get_if<ProjectorLight>(&light.shape)) {
      const bool fits = projector->slide && projector->slide->pixels() > 0 && projector->yfov > 0 &&
                        projector->yfov < kPi && projector->aspect > 0 && finite(projector->aspect);
      if (!fits) {
        warn(what + ": a projector without slide, or with a field of view or aspect out of range; left out");
        return false;
      }
    }
    if (auto* sky = std::get_if<SkyLight>(&light.shape)) {
      bool bad = false;
      for (float& v : sky->image.data)
        if (!finite(v) || v < 0) v = 0, bad = true;
      if (bad) warn(what + ": pixels that are negative or not numbers count as 0");
    }
    return true;
  }

  bool check(const Camera& camera) {
    const bool fits = finite(camera.frame) && camera.yfov > 0 && camera.yfov < kPi && camera.aspect > 0 &&
                      finite(camera.aspect);
    if (!fits)
      warn("camera " + quoted(camera.name) + " has a field of view, aspect or place out of range; left out");
    return fits;
  }

  void check_size() {
    Bounds bounds;
    for (const Instance& instance : scene_.instances) {
      const Mesh& mesh = scene_[instance.mesh];
      Bounds box;
      for (const Triangle& t : mesh.triangles)
        for (const uint32_t v : t.v) box.add(mesh.positions[v]);
      if (box.empty()) continue;
      for (int corner = 0; corner < 8; ++corner) {
        const Vec3 p((corner & 1) != 0 ? box.hi.x : box.lo.x, (corner & 2) != 0 ? box.hi.y : box.lo.y,
                     (corner & 4) != 0 ? box.hi.z : box.lo.z);
        bounds.add(Vec3(instance.transform * glm::vec4(p, 1)));
      }
    }
    if (bounds.empty()) return;
    const float size = bounds.diagonal();
    if (size < kSmallScene || size > kLargeScene)
      warn("the scene is " + std::to_string(size) + " m across; is its unit the metre?");
  }

  void check_albedos() {
    if (!bright_.empty()) {
      std::string names;
      for (std::size_t i = 0; i < std::min<std::size_t>(bright_.size(), 4); ++i)
        names += (i == 0 ? "" : ", ") + bright_[i];
      if (bright_.size() > 4) names += " and " + std::to_string(bright_.size() - 4) + " more";
      warn("materials with an albedo above 0.95, which nothing in a house has: " + names);
    }
  }

  Scene& scene_;
  const Progress& progress_;
  std::vector<std::string> bright_;
};

}  // namespace

void validate(Scene& scene, const Progress& progress) {
  Validator(scene, progress).run();
}

}  // namespace sconce
