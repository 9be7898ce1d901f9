// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "asked.h"
#include "rows.h"

namespace sconce::validation {

double polygon_lux(const std::vector<glm::dvec3>& corners, double luminance, const glm::dvec3& x,
                   const glm::dvec3& n) {
  std::vector<glm::dvec3> clipped;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec3 a = corners[i] - x, b = corners[(i + 1) % corners.size()] - x;
    const double da = glm::dot(a, n), db = glm::dot(b, n);
    if (da >= 0) clipped.push_back(a);
    if ((da > 0) != (db > 0) && da != db) clipped.push_back(a + (b - a) * (da / (da - db)));
  }
  double sum = 0;
  for (std::size_t i = 0; i < clipped.size(); ++i) {
    const glm::dvec3 a = glm::normalize(clipped[i]), b = glm::normalize(clipped[(i + 1) % clipped.size()]),
                     edge = glm::cross(a, b);
    if (const double length = glm::length(edge); length > 1e-12)
      sum += std::atan2(length, glm::dot(a, b)) * glm::dot(edge / length, n);
  }
  return std::abs(luminance * sum / 2);
}

Section direct_light(const std::filesystem::path&) {
  Section out{"Direct light",
              "Closed forms (analytic tests 9 to 12), at points, 8192 samples of the "
              "path solver.",
              {}};
  const auto add = [&](std::string what, double reference, double ours, double allowed = 0.005) {
    out.rows.push_back({std::move(what), reference, ours, allowed});
  };
  {
    Scene scene;
    add_disk(scene, "lamp", glowing(scene, 50), Vec3(0, 2, 0), Vec3(0, -1, 0), 0.75f, 256);
    const Asked asked(std::move(scene));
    for (const double r : {0.0, 0.5, 1.5, 4.0}) {
      const double s = 4 + r * r + 0.5625;
      add(fmt::format("disk of 0.75 m and 50 cd/m², 2 m below, {:g} m aside, lx", r),
          kPiD * 25 * (1 - (4 + r * r - 0.5625) / std::sqrt(s * s - 2.25 * r * r)),
          asked.lux(Vec3(static_cast<float>(r), 0, 0), Vec3(0, 1, 0)));
    }
  }
  {
    Scene scene;
    add_quad(scene, "lamp", glowing(scene, 40), Vec3(-0.5f, 2, -0.25f), Vec3(1, 0, 0), Vec3(0, 0, 0.5f));
    const auto corners = rectangle({-0.5, 2, -0.25}, {1, 0, 0}, {0, 0, 0.5});
    const Asked asked(std::move(scene));
    add("rectangle 1 x 0.5 m, 40 cd/m², 2 m below its centre, lx",
        polygon_lux(corners, 40, {0, 0, 0}, {0, 1, 0}), asked.lux(Vec3(0), Vec3(0, 1, 0)));
    add("the same, 1.5 m aside and upright, lx", polygon_lux(corners, 40, {1.5, 0.5, 0.2}, {-1, 0, 0}),
        asked.lux(Vec3(1.5f, 0.5f, 0.2f), Vec3(-1, 0, 0)));
    add("the same, cut by the receiver's horizon, lx", polygon_lux(corners, 40, {0.2, 1.5, 0}, {1, 0, 0}),
        asked.lux(Vec3(0.2f, 1.5f, 0), Vec3(1, 0, 0)));
  }
  {
    Scene scene;
    add_sphere(scene, "lamp", glowing(scene, 30), Vec3(0, 3, 0), 0.5f, 96, false);
    const Asked asked(std::move(scene));
    constexpr int kMany = 65536;  // half of the sphere's points face away
    add("sphere of 0.5 m and 30 cd/m² at 3 m, lx", kPiD * 30 * 0.25 / 9,
        asked.lux(Vec3(0), Vec3(0, 1, 0), 0, kMany));
    add("the same, receiver turned by 60 degrees, lx", kPiD * 30 * 0.25 / 9 * 0.5,
        asked.lux(Vec3(0), Vec3(std::sqrt(0.75f), 0.5f, 0), 0, kMany));
  }
  {
    Scene scene;
    add_quad(scene, "lamp", glowing(scene, 40), Vec3(-1, 2, -1), Vec3(2, 0, 0), Vec3(0, 0, 2));
    add_quad(scene, "wall", black(scene), Vec3(0, 1, -20), Vec3(0, 0, 40), Vec3(20, 0, 0));
    const Asked asked(std::move(scene));
    // From (0, 0, 0) the half-plane y = 1, x > 0 hides x > 0 of the lamp.
    add("square lamp half hidden by a half-plane, lx",
        polygon_lux(rectangle({-1, 2, -1}, {1, 0, 0}, {0, 0, 2}), 40, {0, 0, 0}, {0, 1, 0}),
        asked.lux(Vec3(0), Vec3(0, 1, 0)));
  }
  {
    Scene scene;
    add_quad(scene, "floor", black(scene), Vec3(-9, -1, -9), Vec3(0, 0, 18), Vec3(18, 0, 0));
    Light light;
    light.intensity = Rgb(100);
    light.frame[3] = glm::vec4(0, 1.5f, 0, 1);
    scene.lights.push_back(light);
    const Asked asked(std::move(scene));
    for (const double x : {0.0, 0.7, 3.0})
      add(fmt::format("point of 100 cd at 1.5 m, {:g} m aside, lx", x), 150 / std::pow(x * x + 2.25, 1.5),
          asked.lux(Vec3(static_cast<float>(x), 0, 0), Vec3(0, 1, 0)), 1e-6);
  }
  return out;
}

}  // namespace sconce::validation
