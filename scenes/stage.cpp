// SPDX-License-Identifier: Apache-2.0
#include "stage.h"

#include <cstdlib>
#include <glm/gtc/matrix_transform.hpp>
#include <stdexcept>

#include "core/kelvin.h"
#include "image/io.h"

namespace sconce::demo {
namespace {

template <class T>
Id<T> last(const std::vector<T>& v) {
  return Id<T>{static_cast<uint32_t>(v.size() - 1)};
}

float area(const Mesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.positions[t.v[0]], b = mesh.positions[t.v[1]], c = mesh.positions[t.v[2]];
    sum += 0.5 * static_cast<double>(glm::length(glm::cross(b - a, c - a)));
  }
  return static_cast<float>(sum);
}

}  // namespace

void Stage::paint(const std::string& name, const char* srgb, bool double_sided) {
  const auto v = std::strtoul(srgb, nullptr, 16);
  const auto channel = [&](int shift) {
    return srgb_to_linear(static_cast<float>(v >> shift & 255) / 255.0f);
  };
  // Six binary digits after the point at the most, whatever pow() gives in its last bit.
  const auto rounded = [](float x) { return std::round(x * 65536) / 65536; };
  Material m;
  m.name = name;
  m.base_color = Rgb(rounded(channel(16)), rounded(channel(8)), rounded(channel(0)));
  m.double_sided = double_sided;
  scene.materials.push_back(m);
  materials_[name] = last(scene.materials);
}

void Stage::texture(const std::string& name, const Image8& image, Vec2 metres, bool double_sided) {
  Texture t;
  t.name = name;
  t.pixels = image;
  t.file = encode_png(image);
  t.mime = "image/png";
  scene.textures.push_back(std::move(t));
  Material m;
  m.name = name;
  m.base_color_texture.texture = last(scene.textures);
  m.double_sided = double_sided;
  scene.materials.push_back(m);
  materials_[name] = last(scene.materials);
  metres_[name] = metres;
}

void Stage::add(const std::string& name, const std::string& material, const MeshBuilder& shape,
                float lightmap_scale) {
  const auto found = materials_.find(material);
  if (found == materials_.end()) throw std::logic_error("no material " + material);
  const auto metres = metres_.find(material);
  scene.meshes.push_back(
      shape.finish(name, found->second, metres == metres_.end() ? Vec2(0) : metres->second));
  Instance instance;
  instance.name = name;
  instance.mesh = last(scene.meshes);
  instance.lightmap_scale = lightmap_scale;
  scene.instances.push_back(instance);
}

void Stage::add_light(const std::string& name, const MeshBuilder& shape, const char* group, float lumens,
                      double kelvin, float albedo) {
  const Mesh measured = shape.finish(name, {}, Vec2(0));
  // Lambertian emitter: flux = pi * area * luminance.
  const float luminance = lumens / (kPi * area(measured));
  const auto rounded = [](float v) { return std::round(v * 256) / 256; };
  const Rgb white = kelvin_color(kelvin);
  const Rgb emission(rounded(white.r * luminance), rounded(white.g * luminance),
                     rounded(white.b * luminance));
  const std::string material = std::string(group) + " lamp";
  if (const auto known = materials_.find(material);
      known == materials_.end() || scene[known->second].emission != emission) {
    Material m;
    m.name = material;
    m.base_color = Rgb(albedo);
    m.emission = emission;
    scene.materials.push_back(m);
    materials_[material] = last(scene.materials);
  }
  add(name, material, shape);
  scene.instances.back().group_name = group;
}

void Stage::camera(const std::string& name, Vec3 eye, Vec3 target, float horizontal_degrees) {
  Camera c;
  c.name = name;
  c.aspect = 16.0f / 9.0f;
  c.yfov = 2 * std::atan(std::tan(horizontal_degrees * kPi / 360) / c.aspect);
  c.yfov = std::round(c.yfov * 65536) / 65536;
  const Vec3 back = glm::normalize(eye - target), right = glm::normalize(glm::cross(Vec3(0, 1, 0), back));
  c.frame =
      Mat4(glm::vec4(right, 0), glm::vec4(glm::cross(back, right), 0), glm::vec4(back, 0), glm::vec4(eye, 1));
  scene.cameras.push_back(c);
}

}  // namespace sconce::demo
