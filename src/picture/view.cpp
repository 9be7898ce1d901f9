// SPDX-License-Identifier: Apache-2.0
// Where a package is looked at from.
#include <algorithm>

#include "picture/glint.h"
#include "picture/render.h"

namespace sconce {

View::View(const Package& package) : View(package, ShownScene(package)) {}

View::View(const Package& package, ShownScene shown)
    : package_(&package), shown_(std::move(shown)), tracer_(shown_.scene, shown_.world) {
  find_lamps();
}

void View::place(const ObjectPlaces& places, const ObjectMoves& moves) {
  places.place(moves, shown_.scene, shown_.world);
  tracer_ = Tracer(shown_.scene, shown_.world);
  find_lamps();
}

void View::find_lamps() {
  if (!scene().has_mirrors()) return;
  lamps_ = std::make_unique<const Lamps>(scene(), world());
  near_ = near_lamps(*lamps_);
}

bool View::sees_normal_maps() const {
  return package_->manifest().basis == Basis::sh1 && scene().has_normal_maps();
}

Camera View::camera(std::string_view name, const Progress& progress) const {
  if (const Camera* found = find_camera(scene(), name)) return *found;
  progress.warn("the scene has no camera: looking from a corner at eye height");
  return eye_height_camera();
}

// Of four places well inside the corners the one with the longest free view towards the middle.
Camera View::eye_height_camera() const {
  constexpr float kEyeHeight = 1.6f;  // metres above the lowest floor
  constexpr float kInset = 0.15f;
  const Bounds& b = world().bounds;
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

}  // namespace sconce
