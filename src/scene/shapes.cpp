// SPDX-License-Identifier: Apache-2.0
#include "scene/shapes.h"

namespace sconce {

namespace {

Id<Instance> place(Scene& scene, const std::string& name, Mesh mesh) {
  mesh.name = name;
  scene.meshes.push_back(std::move(mesh));
  Instance instance;
  instance.name = name;
  instance.mesh = Id<Mesh>(scene.meshes.size() - 1);
  scene.instances.push_back(instance);
  return Id<Instance>(scene.instances.size() - 1);
}

void quad(Mesh& mesh, const Vec3& p, const Vec3& a, const Vec3& b) {
  const auto base = static_cast<uint32_t>(mesh.positions.size());
  const Vec3 n = glm::normalize(glm::cross(a, b));
  for (const Vec3& corner : {p, p + a, p + a + b, p + b}) {
    mesh.positions.push_back(corner);
    mesh.normals.push_back(n);
  }
  mesh.triangles.push_back({{base, base + 1, base + 2}});
  mesh.triangles.push_back({{base, base + 2, base + 3}});
}

}  // namespace

Id<Material> add_material(Scene& scene, const std::string& name, const Rgb& base_color, const Rgb& emission,
                          bool double_sided) {
  Material material;
  material.name = name;
  material.base_color = base_color;
  material.emission = emission;
  material.double_sided = double_sided;
  scene.materials.push_back(material);
  return Id<Material>(scene.materials.size() - 1);
}

Id<Instance> add_quad(Scene& scene, const std::string& name, Id<Material> material, const Vec3& p,
                      const Vec3& a, const Vec3& b) {
  Mesh mesh;
  mesh.material = material;
  quad(mesh, p, a, b);
  return place(scene, name, std::move(mesh));
}

Id<Instance> add_box(Scene& scene, const std::string& name, Id<Material> material, const Vec3& lo,
                     const Vec3& hi, bool inward) {
  Mesh mesh;
  mesh.material = material;
  const Vec3 d = hi - lo, x(d.x, 0, 0), y(0, d.y, 0), z(0, 0, d.z);
  const auto wall = [&](const Vec3& p, const Vec3& a, const Vec3& b) {
    inward ? quad(mesh, p, b, a) : quad(mesh, p, a, b);
  };
  wall(lo, y, x);      // z = lo, outward -z
  wall(lo + z, x, y);  // z = hi
  wall(lo, z, y);      // x = lo
  wall(lo + x, y, z);  // x = hi
  wall(lo, x, z);      // y = lo
  wall(lo + y, z, x);  // y = hi
  return place(scene, name, std::move(mesh));
}

Id<Instance> add_sphere(Scene& scene, const std::string& name, Id<Material> material, const Vec3& center,
                        float radius, int n, bool inward) {
  Mesh mesh;
  mesh.material = material;
  const int columns = 2 * n;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= columns; ++j) {
      const float theta = kPi * static_cast<float>(i) / static_cast<float>(n);
      const float phi = 2 * kPi * static_cast<float>(j) / static_cast<float>(columns);
      const Vec3 out(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
      mesh.positions.push_back(center + radius * out);
      mesh.normals.push_back(inward ? -out : out);
    }
  const auto at = [&](int i, int j) { return static_cast<uint32_t>(i * (columns + 1) + j); };
  const auto triangle = [&](uint32_t a, uint32_t b, uint32_t c) {
    mesh.triangles.push_back(inward ? Triangle{{a, c, b}} : Triangle{{a, b, c}});
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < columns; ++j) {
      if (i > 0) triangle(at(i, j), at(i, j + 1), at(i + 1, j));
      if (i < n - 1) triangle(at(i, j + 1), at(i + 1, j + 1), at(i + 1, j));
    }
  return place(scene, name, std::move(mesh));
}

Id<Instance> add_disk(Scene& scene, const std::string& name, Id<Material> material, const Vec3& center,
                      const Vec3& normal, float radius, int n) {
  Mesh mesh;
  mesh.material = material;
  const Frame frame(normal);
  const float angle = 2 * kPi / static_cast<float>(n);
  const float r = radius * std::sqrt(angle / std::sin(angle));
  mesh.positions.push_back(center);
  for (int i = 0; i < n; ++i) {
    const float phi = angle * static_cast<float>(i);
    mesh.positions.push_back(center + r * (std::cos(phi) * frame.x + std::sin(phi) * frame.y));
    mesh.triangles.push_back({{0, static_cast<uint32_t>(i + 1), static_cast<uint32_t>((i + 1) % n + 1)}});
  }
  mesh.normals.assign(mesh.positions.size(), normal);
  return place(scene, name, std::move(mesh));
}

void add_sky(Scene& scene, const Rgb& radiance, Id<LightGroup> group) {
  Light sky;
  sky.name = "sky";
  sky.group = group;
  sky.intensity = radiance;
  sky.shape = SkyLight{};
  scene.lights.push_back(std::move(sky));
}

}  // namespace sconce
