// SPDX-License-Identifier: Apache-2.0
#include "scene/lens.h"

#include <cmath>
#include <optional>

#include "core/error.h"
#include "core/text.h"

namespace sconce {

void PictureParams::check() const {
  constexpr int kMaxSize = 1 << 16;
  if (width < 1 || height < 1 || width > kMaxSize || height > kMaxSize)
    throw UsageError({}, "a picture cannot be " + std::to_string(width) + " x " + std::to_string(height),
                     "1 to " + std::to_string(kMaxSize));
  if (samples < 1) throw UsageError({}, "a picture needs at least one sample per pixel");
}

Lens::Lens(const Camera& camera, const PictureParams& params) : eye_(camera.frame[3]) {
  const auto width = static_cast<float>(params.width), height = static_cast<float>(params.height);
  const float up = std::tan(0.5f * camera.yfov), right = up * width / height;
  // Unit axes: a camera below a scaled node still sees the world unscaled.
  const Vec3 x = 2 * right / width * normalize_or(Vec3(camera.frame[0]), Vec3(0));
  const Vec3 y = -2 * up / height * normalize_or(Vec3(camera.frame[1]), Vec3(0));
  const Vec3 forward = normalize_or(-Vec3(camera.frame[2]), Vec3(0));
  const Vec3 top_left = forward - 0.5f * width * x - 0.5f * height * y;
  const float size = glm::length(eye_) + glm::length(top_left);
  if (!(up > 0) || !std::isfinite(size) || x == Vec3(0) || y == Vec3(0) || forward == Vec3(0))
    throw Error("camera '" + camera.name + "'", "has no usable frame or field of view");
  plane_ = Mat3(x, y, top_left);
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

const Camera* find_camera(const Scene& scene, std::string_view name) {
  if (name.empty()) return scene.cameras.empty() ? nullptr : &scene.cameras.front();
  std::vector<std::string> names;
  for (const Camera& camera : scene.cameras) {
    if (camera.name == name) return &camera;
    names.push_back(camera.name);
  }
  throw UsageError({}, "unknown camera '" + std::string(name) + "'" + did_you_mean(name, names),
                   names.empty() ? "none: the scene has no camera" : join(names, ", "));
}

}  // namespace sconce
