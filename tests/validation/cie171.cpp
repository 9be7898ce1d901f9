// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "asked.h"
#include "core/sobol.h"
#include "photometry/formats.h"
#include "rows.h"

namespace sconce::validation {

namespace {

constexpr double kLuminance = 1000;  // cd/m2, of lit patches

/// A patch on the floor that reflects `rho` of a sun straight above: no sun reaches what looks along or up at
/// nothing.
Scene lit_patch(double size, float rho) {
  Scene scene;
  const auto s = static_cast<float>(size);
  add_quad(scene, "patch", add_material(scene, "grey", Rgb(rho)), Vec3(-s / 2, 0, -s / 2), Vec3(0, 0, s),
           Vec3(s, 0, 0));
  Light sun;
  sun.intensity = Rgb(static_cast<float>(kLuminance * kPiD / static_cast<double>(rho)));
  sun.frame = kDown;
  sun.shape = SunLight{};
  scene.lights.push_back(sun);
  return scene;
}

/// Flux that lands on the walls of a cube of 4 m around a lamp: mean illuminance x area.
double flux_on_walls(const Asked& room) {
  constexpr uint32_t kPoints = 1024;
  BakeParams params;
  params.samples = 8, params.bounces = 0;
  const auto solver =
      find_solver("path").prepare({room.scene, room.world, room.tracer, room.lamps}, params, {});
  std::vector<GroupValue> values(room.scene.groups.size());
  double sum = 0;
  for (std::size_t t = 0; t < room.world.size(); ++t)
    for (uint32_t i = 0; i < kPoints; ++i) {
      const Vec2 u = sobol_pair(i, 0, static_cast<uint32_t>(t));
      const float root = std::sqrt(u.x);
      const Vec3 p = room.world.position(t, Vec2(root * (1 - u.y), root * u.y)),
                 n = room.world.face_normals[t];
      solver->solve(Footprint::point(i, ReceiverKind::plane, {p, n, n}), values);
      sum += static_cast<double>(values[0].illuminance.g * room.world.area(t)) / kPoints;
    }
  return sum;
}

}  // namespace

Section cie_171(const std::filesystem::path& data) {
  Section out{"CIE 171:2006",
              "The cases of its section 5 that rest on closed forms, on geometry of our own; the references "
              "are the forms themselves, since the "
              "report's tables are not free to print. Its known errata (I. Ashdown) so do not matter here: "
              "table 19 of case 5.7, computed "
              "for another geometry, is replaced by the visible polygon. Left out: 5.5, 5.10 and 5.12 "
              "(glazing: sconce passes light "
              "through glass unrefracted or not at all), 5.13 and 5.14 (CIE general skies), section 4 "
              "(measured rooms whose data is not free).",
              {}};
  const auto add = [&](std::string what, double reference, double ours, double allowed = 0.01) {
    out.rows.push_back({std::move(what), reference, ours, allowed});
  };
  const std::filesystem::path lamp_file = data / "photometry/ldt/eulumdat-py/sample4.ldt";
  Photometry lamp = read_photometry(lamp_file);
  lamp.opening = {};
  const auto hung = [&](float rho) {
    Scene scene;
    add_box(scene, "room", add_material(scene, "walls", Rgb(rho)), Vec3(-2), Vec3(2), true);
    hang(scene, lamp);
    return Asked(std::move(scene));
  };
  {
    const Asked room = hung(0);
    for (const auto& [x, z] :
         {std::pair(0.5, 0.0), std::pair(1.0, -1.0), std::pair(1.5, -0.5), std::pair(-1.5, 1.8)}) {
      const double d2 = x * x + z * z + 4;
      const double gamma = std::acos(2 / std::sqrt(d2)) * 180 / kPiD,
                   azimuth = std::atan2(-z, x) * 180 / kPiD;
      add(fmt::format("5.2 point lamp from a file, floor 2 m below at ({:g}, {:g}), lx", x, z),
          intensity_at(lamp, azimuth < 0 ? azimuth + 360 : azimuth, gamma) * 2 / std::pow(d2, 1.5),
          room.lux(Vec3(static_cast<float>(x), -2, static_cast<float>(z)), Vec3(0, 1, 0)), 1e-4);
    }
    add("5.4 flux on all walls of the room, lm", flux(lamp), flux_on_walls(room), 0.005);
  }
  {
    Scene scene;
    add_quad(scene, "lamp", glowing(scene, kLuminance), Vec3(-0.5f, 3, -0.5f), Vec3(1, 0, 0), Vec3(0, 0, 1));
    const auto corners = rectangle({-0.5, 3, -0.5}, {1, 0, 0}, {0, 0, 1});
    const Asked asked(std::move(scene));
    for (const double x : {0.0, 1.0, 1.9})
      add(fmt::format("5.3 area lamp 1 x 1 m, floor 3 m below, {:g} m aside, lx", x),
          polygon_lux(corners, kLuminance, {x, 0, 0}, {0, 1, 0}),
          asked.lux(Vec3(static_cast<float>(x), 0, 0), Vec3(0, 1, 0)));
    for (const double y : {0.5, 2.0})
      add(fmt::format("5.3 the same, wall 2 m aside at a height of {:g} m, lx", y),
          polygon_lux(corners, kLuminance, {-2, y, 0}, {1, 0, 0}),
          asked.lux(Vec3(-2, static_cast<float>(y), 0), Vec3(1, 0, 0)));
  }
  for (const double size : {0.5, 4.0}) {
    const auto corners = rectangle({-size / 2, 0, -size / 2}, {size, 0, 0}, {0, 0, size});
    const Asked asked(lit_patch(size, 0.8f));
    for (const double y : {0.5, 2.0})
      add(fmt::format("5.6 wall at the edge of a lit patch of {:g} m, {:g} m up, lx", size, y),
          polygon_lux(corners, kLuminance, {-size / 2 - 0.01, y, 0}, {1, 0, 0}),
          asked.lux(Vec3(static_cast<float>(-size / 2 - 0.01), static_cast<float>(y), 0), Vec3(1, 0, 0), -1,
                    1 << 20));
    add(fmt::format("5.6 ceiling 3 m above it, 1 m aside, lx"),
        polygon_lux(corners, kLuminance, {1, 3, 0}, {0, -1, 0}),
        asked.lux(Vec3(1, 3, 0), Vec3(0, -1, 0), -1, 1 << 20));
  }
  {
    Scene scene = lit_patch(4, 0.8f);
    // An upright sheet from floor to ceiling across the patch: the sun passes along it.
    add_quad(scene, "sheet", add_material(scene, "black", Rgb(0), Rgb(0), true), Vec3(0, 0.001f, -20),
             Vec3(0, 0, 40), Vec3(0, 20, 0));
    const Asked asked(std::move(scene));
    const auto seen = rectangle({-2, 0, -2}, {2, 0, 0}, {0, 0, 4});
    for (const double y : {0.5, 2.0})
      add(fmt::format("5.7 wall, half of the patch behind a sheet, {:g} m up, lx", y),
          polygon_lux(seen, kLuminance, {-2.01, y, 0.5}, {1, 0, 0}),
          asked.lux(Vec3(-2.01f, static_cast<float>(y), 0.5f), Vec3(1, 0, 0), -1));
    for (const double x : {-1.5, -0.5})
      add(fmt::format("5.7 ceiling 3 m above at {:g} m, lx", x),
          polygon_lux(seen, kLuminance, {x, 3, 0.5}, {0, -1, 0}),
          asked.lux(Vec3(static_cast<float>(x), 3, 0.5f), Vec3(0, -1, 0), -1));
  }
  for (const double rho : {0.3, 0.5, 0.8, 0.9}) {
    // An isotropic lamp of 10,000 lm in a cube of 4 m: by conservation the mean is (lm / 96 m2) / (1 - rho).
    Scene scene;
    add_box(scene, "room", add_material(scene, "walls", Rgb(static_cast<float>(rho))), Vec3(-2), Vec3(2),
            true);
    Light light;
    light.intensity = Rgb(static_cast<float>(10000 / (4 * kPiD)));
    scene.lights.push_back(light);
    const Asked room(std::move(scene));
    // By symmetry a wall's eighth stands for all: 6 x 6 midpoints of a quarter.
    double sum = 0;
    BakeParams params;
    params.samples = 1024;
    const auto solver =
        find_solver("radiosity").prepare({room.scene, room.world, room.tracer, room.lamps}, params, {});
    std::vector<GroupValue> values(room.scene.groups.size());
    for (int i = 0; i < 36; ++i) {
      const Vec3 p((static_cast<float>(i % 6) + 0.5f) / 3, -2, (static_cast<float>(i / 6) + 0.5f) / 3),
          n(0, 1, 0);
      solver->solve(Footprint::point(static_cast<uint32_t>(i), ReceiverKind::plane, {p, n, n}), values);
      sum += static_cast<double>(values[0].illuminance.g) / 36;
    }
    add(fmt::format("5.8 mean of a closed cube, 10,000 lm, reflectance {:g}, lx", rho),
        10000 / 96.0 / (1 - rho), sum);
  }
  {
    // A black room of 4 x 4 x 3 m with an opening of 1 x 1 m, a uniform sky outside.
    const auto sky_room = [&](bool roof) {
      Scene scene;
      const auto m = add_material(scene, "black", Rgb(0), Rgb(0), true);
      add_quad(scene, "floor", m, Vec3(-2, 0, -2), Vec3(0, 0, 4), Vec3(4, 0, 0));
      for (const float side : {-2.0f, 2.0f}) {
        if (roof || side < 0) add_quad(scene, "wall x", m, Vec3(side, 0, -2), Vec3(0, 3, 0), Vec3(0, 0, 4));
        add_quad(scene, "wall z", m, Vec3(-2, 0, side), Vec3(4, 0, 0), Vec3(0, 3, 0));
      }
      // What surrounds the hole, in the plane of the ceiling or of the wall x = 2.
      const auto frame = [&](const Vec3& p, const Vec3& a, const Vec3& b, float width, float height, float a0,
                             float b0) {
        add_quad(scene, "frame", m, p, a * width, b * b0);
        add_quad(scene, "frame", m, p + b * (b0 + 1), a * width, b * (height - b0 - 1));
        add_quad(scene, "frame", m, p + b * b0, a * a0, b);
        add_quad(scene, "frame", m, p + b * b0 + a * (a0 + 1), a * (width - a0 - 1), b);
      };
      if (roof)
        frame(Vec3(-2, 3, -2), Vec3(1, 0, 0), Vec3(0, 0, 1), 4, 4, 1.5f, 1.5f);
      else
        add_quad(scene, "ceiling", m, Vec3(-2, 3, -2), Vec3(4, 0, 0), Vec3(0, 0, 4)),
            frame(Vec3(2, 0, -2), Vec3(0, 0, 1), Vec3(0, 1, 0), 4, 3, 1.5f, 1.0f);
      Light sky;
      sky.intensity = Rgb(static_cast<float>(kLuminance));
      sky.shape = SkyLight{};
      scene.lights.push_back(sky);
      return Asked(std::move(scene));
    };
    const Asked roof = sky_room(true), window = sky_room(false);
    for (const double x : {0.0, 1.0, 1.8})
      add(fmt::format("5.9 roof opening 1 x 1 m, uniform sky, floor 3 m below, {:g} m aside, lx", x),
          polygon_lux(rectangle({-0.5, 3, -0.5}, {1, 0, 0}, {0, 0, 1}), kLuminance, {x, 0.001, 0}, {0, 1, 0}),
          roof.lux(Vec3(static_cast<float>(x), 0.001f, 0), Vec3(0, 1, 0), 0, 131072), 0.015);
    for (const double x : {1.0, 0.0, -1.0})
      add(fmt::format("5.11 window 1 x 1 m, uniform sky, floor {:g} m from it, lx", 2 - x),
          polygon_lux(rectangle({2, 1, -0.5}, {0, 1, 0}, {0, 0, 1}), kLuminance, {x, 0.001, 0}, {0, 1, 0}),
          window.lux(Vec3(static_cast<float>(x), 0.001f, 0), Vec3(0, 1, 0), 0, 131072), 0.02);
  }
  return out;
}

}  // namespace sconce::validation
