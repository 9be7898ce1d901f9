// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "asked.h"
#include "rows.h"

namespace sconce::validation {

Section between_surfaces(const std::filesystem::path&) {
  Section out{
      "Interreflection", "Closed forms (analytic tests 1 to 3), by the solver `radiosity`, all bounces.", {}};
  const auto add = [&](std::string what, double reference, double ours, double allowed = 0.01) {
    out.rows.push_back({std::move(what), reference, ours, allowed});
  };
  for (const double rho : {0.2, 0.5, 0.8}) {
    Scene scene;
    add_box(scene, "walls", add_material(scene, "glow", Rgb(static_cast<float>(rho)), Rgb(10)),
            Vec3(-1, -2, -3), Vec3(2, 1, 2), true);
    add(fmt::format("furnace of 10 cd/m², reflectance {:g}, lx", rho), 10 * kPiD / (1 - rho),
        Asked(std::move(scene)).lux(Vec3(0.3f, -2, 0.4f), Vec3(0, 1, 0), -1));
  }
  for (const double rho : {0.3, 0.6, 0.9}) {
    Scene scene;
    add_sphere(scene, "shell", add_material(scene, "white", Rgb(static_cast<float>(rho))), Vec3(0), 2, 96,
               true);
    Light light;
    light.intensity = Rgb(100);
    scene.lights.push_back(light);
    add(fmt::format("sphere of 2 m, 100 cd in its centre, reflectance {:g}, lx", rho), 25 / (1 - rho),
        Asked(std::move(scene)).lux(Vec3(0, -1.999f, 0), Vec3(0, 1, 0), -1));
  }
  {
    Scene scene;
    add_quad(scene, "low", add_material(scene, "low", Rgb(0.5f), Rgb(10)), Vec3(-100, 0, -100),
             Vec3(0, 0, 200), Vec3(200, 0, 0));
    add_quad(scene, "high", add_material(scene, "high", Rgb(0.8f), Rgb(4)), Vec3(-100, 1, -100),
             Vec3(200, 0, 0), Vec3(0, 0, 200));
    // B2 = (4 + 0.8 x 10) / (1 - 0.4) arrives below.
    add("parallel plates of 10 and 4 cd/m², reflectances 0.5 and 0.8, on the lower, lx", kPiD * 12 / 0.6,
        Asked(std::move(scene)).lux(Vec3(0.2f, 0, 0.1f), Vec3(0, 1, 0), -1), 0.01);
  }
  return out;
}

}  // namespace sconce::validation
