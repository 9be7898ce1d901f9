// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "init.h"
#include "light/lamp.h"
#include "scene/groups.h"

namespace sconce::app {

namespace {

constexpr float kBright = 0.9f;       // albedo; fresh snow has more
constexpr float kRoomDiagonal = 200;  // m; larger scenes are mostly centimetres

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + "\"";
}

std::string suspicions(const Scene& scene, const World& world) {
  std::string text;
  const float size = world.bounds.diagonal();
  if (size > kRoomDiagonal)
    text += fmt::format(
        "# The scene is {:.0f} m across. If its unit is the centimetre:\n# [scene]\n# unit = \"cm\"\n\n",
        size);
  for (const Material& material : scene.materials)
    if (luminance(material.base_color) > kBright && !material.base_color_texture.texture && !material.emits())
      text += fmt::format(
          "# Material {} reflects {:.0f} %; white paint reflects 80 to 85:\n# [[material]]\n# match = {}\n"
          "# base_color = [0.8, 0.8, 0.8]\n\n",
          quoted(material.name), 100 * luminance(material.base_color), quoted(material.name));
  std::size_t reversed = 0;
  for (std::size_t t = 0; t < world.size(); ++t) {
    const Vec3& normal = world.normals[world.triangles[t].v[0]];
    const Mesh& mesh = scene[scene[world.instances[t]].mesh];
    if (!mesh.normals.empty() && glm::dot(normal, world.face_normals[t]) < 0) ++reversed;
  }
  if (reversed > 0)
    text += fmt::format("# {} of {} triangles wind against their normals: backs of walls are black.\n\n",
                        reversed, world.size());
  return text;
}

std::string groups_of(const Scene& scene, const World& world) {
  const Lamps lamps(scene, world);
  const std::vector<GroupFlux> fluxes = group_flux(scene, lamps);
  std::string text;
  for (std::size_t g = 0; g < scene.groups.size(); ++g) {
    const GroupFlux& flux = fluxes[g];
    text += fmt::format("# {}: {} lamp{}{}\n", scene.groups[g].name, flux.lamps.size(),
                        flux.lamps.size() == 1 ? "" : "s",
                        flux.infinite ? ", from the sky" : fmt::format(", {:.4g} lm", flux.lumens));
    if (flux.infinite) continue;
    text += fmt::format("# [group.{}]\n# nodes = [", quoted(scene.groups[g].name));
    for (std::size_t i = 0; i < flux.lamps.size(); ++i) text += (i > 0 ? ", " : "") + quoted(flux.lamps[i]);
    text += "]\n";
  }
  return text;
}

}  // namespace

std::string side_file_for(const Scene& scene, const std::string& name) {
  const World world = make_world(scene);
  std::string text = fmt::format(
      "# Side file of {}: what the scene says of light, and what it does not. Uncomment what is to change.\n"
      "# docs/side-file.md explains every table.\n\n[options]\n# quality = \"normal\"       # draft, normal, "
      "final\n\n",
      name);
  text += suspicions(scene, world);
  text += "# Light groups as `bake` finds them: one fader each.\n" + groups_of(scene, world);
  text +=
      "\n# A new lamp:\n# [[light]]\n# name = \"pendant\"\n# type = \"point\"          # point, spot, sun\n"
      "# position = [0, 2, 0]\n# lumens = 800\n# kelvin = 2700\n# group = \"pendant\"\n\n"
      "# Daylight:\n# [sky]\n# kind = \"cie-overcast\"   # cie-clear and preetham need [sun]\n"
      "# [sun]\n# latitude = 48.1\n# longitude = 11.6\n# time = \"2026-06-21T15:00+02:00\"\n\n";
  if (scene.cameras.empty()) {
    const Vec3 middle = world.bounds.center();
    text += fmt::format(
        "# The scene has no camera:\n# [[camera]]\n# name = \"main\"\n# eye = [{:.2f}, {:.2f}, {:.2f}]\n"
        "# target = [{:.2f}, {:.2f}, {:.2f}]\n# fov = 60\n",
        middle.x, world.bounds.lo.y + 1.6f, world.bounds.hi.z, middle.x, middle.y, middle.z);
  } else {
    text += "# Cameras:";
    for (const Camera& camera : scene.cameras) text += " " + camera.name;
    text += "\n";
  }
  return text;
}

}  // namespace sconce::app
