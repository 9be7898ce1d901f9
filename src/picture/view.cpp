// SPDX-License-Identifier: Apache-2.0
// The package's geometry made ready: twins leave the scene and become the backs of the triangles they share.
#include <limits>
#include <optional>

#include "core/error.h"
#include "core/text.h"
#include "picture/render.h"

namespace sconce {

Scene View::load(const Package& package, std::vector<Placement>* placements) {
  const Manifest& m = package.manifest();
  Scene scene = package.scene();
  std::vector<bool> is_twin(scene.instances.size(), false);
  std::vector<Instance> shown;
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    if (is_twin[i]) continue;  // the lower node of a pair is its front
    Placement placement;
    placement.page = m.instance_pages[i];
    if (const int twin = m.instance_twins[i]; twin > static_cast<int>(i)) {
      const auto t = static_cast<std::size_t>(twin);
      is_twin[t] = true;
      placement.twin = scene.instances[t].mesh;
      placement.twin_page = m.instance_pages[t];
    }
    placements->push_back(placement);
    shown.push_back(std::move(scene.instances[i]));
  }
  scene.instances = std::move(shown);
  return scene;
}

View::View(const Package& package)
    : package_(&package),
      scene_(load(package, &placements_)),
      world_(make_world(scene_)),
      tracer_(scene_, world_) {
  front_.reserve(world_.size());
  back_.reserve(world_.size());
  for (std::size_t t = 0; t < world_.size(); ++t) {
    front_.push_back(front_side(t));
    back_.push_back(back_side(t));
  }
}

View::Side View::front_side(std::size_t triangle) const {
  Side side;
  side.page = placements_[world_.instances[triangle].value].page;
  if (side.page < 0) return side;
  const std::vector<Vec2>& uvs = world_.texcoords[package_->manifest().lightmap_set];
  for (std::size_t k = 0; k < 3; ++k) side.uv[k] = uvs[world_.triangles[triangle].v[k]];
  return side;
}

// A twin has the triangles of its front in the same order, but winds them the other way: corners are told by
// position.
View::Side View::back_side(std::size_t triangle) const {
  const Placement& placement = placements_[world_.instances[triangle].value];
  Side side;
  side.page = placement.twin_page;
  if (side.page < 0) return side;
  const Mesh& twin = scene_[placement.twin];
  const std::vector<Vec2>& uvs = twin.texcoords[package_->manifest().lightmap_set];
  const Mat4& transform = scene_[world_.instances[triangle]].transform;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 corner = world_.positions[world_.triangles[triangle].v[k]];
    float nearest = std::numeric_limits<float>::infinity();
    for (const uint32_t v : twin.triangles[world_.source_triangles[triangle]].v) {
      const Vec3 d = Vec3(transform * glm::vec4(twin.positions[v], 1.0f)) - corner;
      if (glm::dot(d, d) >= nearest) continue;
      nearest = glm::dot(d, d);
      side.uv[k] = uvs[v];
    }
  }
  return side;
}

Camera View::camera(std::string_view name, const Progress& progress) const {
  if (name.empty() && scene_.cameras.empty()) {
    progress.warn("the scene has no camera: looking from a corner at eye height");
    return eye_height_camera();
  }
  if (name.empty()) return scene_.cameras.front();
  std::vector<std::string> names;
  for (const Camera& camera : scene_.cameras) {
    if (camera.name == name) return camera;
    names.push_back(camera.name);
  }
  const std::optional<std::string> nearest = nearest_name(name, names);
  throw UsageError(
      {},
      "unknown camera '" + std::string(name) + "'" + (nearest ? "; did you mean '" + *nearest + "'?" : ""),
      names.empty() ? "none: the scene has no camera" : join(names, ", "));
}

// Of four places well inside the corners the one with the longest free view towards the middle.
Camera View::eye_height_camera() const {
  constexpr float kEyeHeight = 1.6f;  // metres above the lowest floor
  constexpr float kInset = 0.15f;
  const Bounds& b = world_.bounds;
  const Vec3 size = b.hi - b.lo, middle = b.center();
  const float y = b.lo.y + std::min(kEyeHeight, 0.6f * size.y);
  Vec3 best_eye(0), best_direction(0, 0, -1);
  float best_distance = -1;
  for (int corner = 0; corner < 4; ++corner) {
    const float sx = (corner & 1) != 0 ? kInset : 1 - kInset, sz = (corner & 2) != 0 ? kInset : 1 - kInset;
    const Vec3 eye(b.lo.x + sx * size.x, y, b.lo.z + sz * size.z);
    const Vec3 direction = normalize_or(middle - eye, Vec3(0, 0, -1));
    const Hit hit = tracer_.closest({eye, direction});
    const float distance = !hit ? glm::length(size) : hit.back ? 0.0f : hit.distance;
    if (distance <= best_distance) continue;
    best_distance = distance;
    best_eye = eye;
    best_direction = direction;
  }
  return look_at(best_eye, best_eye + best_direction);
}

Camera look_at(const Vec3& eye, const Vec3& target) {
  const Vec3 back = normalize_or(eye - target, Vec3(0));
  if (back == Vec3(0)) throw UsageError({}, "the camera's eye and target are one point");
  const Vec3 up = std::abs(back.y) > 0.9999f ? Vec3(0, 0, back.y > 0 ? -1.0f : 1.0f) : Vec3(0, 1, 0);
  const Vec3 right = glm::normalize(glm::cross(up, back));
  Camera camera;
  camera.name = "eye";
  camera.frame[0] = glm::vec4(right, 0);
  camera.frame[1] = glm::vec4(glm::cross(back, right), 0);
  camera.frame[2] = glm::vec4(back, 0);
  camera.frame[3] = glm::vec4(eye, 1);
  return camera;
}

}  // namespace sconce
