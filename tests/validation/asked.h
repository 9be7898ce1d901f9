// SPDX-License-Identifier: Apache-2.0
// A scene asked for light at points, by the solvers that bake.
#pragma once

#include "gather/lit_scene.h"
#include "scene/shapes.h"
#include "solve/solver.h"

namespace sconce::validation {

inline constexpr double kPiD = 3.14159265358979323846;

/// Frame whose -z points along -y.
inline const Mat4 kDown{glm::vec4(1, 0, 0, 0), glm::vec4(0, 0, -1, 0), glm::vec4(0, 1, 0, 0),
                        glm::vec4(0, 0, 0, 1)};

class Asked : public LitScene {
 public:
  explicit Asked(Scene s) : LitScene(std::move(s), Grouping::one) {}

  /// Lux of the first group at a point. @param bounces  0 = direct only, -1 = all
  Rgb at(const Vec3& p, const Vec3& n, int bounces = 0, int samples = 8192) const {
    BakeParams params;
    params.samples = samples;
    params.bounces = bounces;
    const auto solver =
        find_solver(bounces == 0 ? "path" : "radiosity").prepare({scene, world, tracer, lamps}, params, {});
    std::vector<GroupValue> values(scene.groups.size());
    solver->solve(Footprint::point(7, ReceiverKind::plane, {p, n, n}), values);
    return values[0].illuminance;
  }
  double lux(const Vec3& p, const Vec3& n, int bounces = 0, int samples = 8192) const {
    return static_cast<double>(at(p, n, bounces, samples).g);
  }
};

/// Illuminance of a Lambertian polygon (Lambert; methods.md test 10), front or back alike, clipped to the
/// horizon of n.
double polygon_lux(const std::vector<glm::dvec3>& corners, double luminance, const glm::dvec3& x,
                   const glm::dvec3& n);

inline std::vector<glm::dvec3> rectangle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
  return {p, p + a, p + a + b, p + b};
}

/// A measured lamp that hangs at the origin, nadir towards -y, C0 towards +x.
inline void hang(Scene& scene, const Photometry& lamp) {
  scene.luminaires.push_back({"lamp", lamp});
  Light light;
  light.intensity = Rgb(1);
  light.frame = kDown;
  light.shape = LuminaireLight{Id<Luminaire>(0)};
  scene.lights.push_back(light);
}

inline Id<Material> black(Scene& scene) {
  return add_material(scene, "black", Rgb(0));
}
inline Id<Material> glowing(Scene& scene, double luminance) {
  return add_material(scene, "glow", Rgb(0), Rgb(static_cast<float>(luminance)));
}

}  // namespace sconce::validation
