// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "asked.h"
#include "core/error.h"
#include "core/files.h"
#include "core/sobol.h"
#include "core/text.h"
#include "rows.h"

namespace sconce::validation {

namespace {

using Matrix = std::vector<std::vector<double>>;

/// Shares of cosine-distributed rays from every instance that end on every other; instances that `into` joins
/// count as one. Rays by the tracer that bakes use.
struct Traced {
  std::vector<double> areas;
  Matrix factors;
};
Traced traced(const Scene& scene, const std::vector<std::size_t>& into, std::size_t surfaces, uint32_t rays) {
  const World world = make_world(scene);
  const Tracer tracer(scene, world);
  Traced out{std::vector<double>(surfaces), Matrix(surfaces, std::vector<double>(surfaces))};
  for (std::size_t t = 0; t < world.size(); ++t) {
    const std::size_t from = into[world.instances[t].value];
    const auto area = static_cast<double>(world.area(t));
    out.areas[from] += area;
    const Vec3 n = world.face_normals[t],
               a = glm::normalize(std::abs(n.x) > 0.5f ? glm::cross(n, Vec3(0, 1, 0))
                                                       : glm::cross(n, Vec3(1, 0, 0))),
               b = glm::cross(n, a);
    for (uint32_t i = 0; i < rays; ++i) {
      const Vec2 u = sobol_pair(i, 0, static_cast<uint32_t>(t)),
                 v = sobol_pair(i, 1, static_cast<uint32_t>(t));
      const float root = std::sqrt(u.x), r = std::sqrt(v.x), phi = 2 * kPi * v.y;
      const Vec3 p = world.position(t, Vec2(root * (1 - u.y), root * u.y));
      const Vec3 d = r * std::cos(phi) * a + r * std::sin(phi) * b + std::sqrt(1 - v.x) * n;
      if (const Hit hit = tracer.closest({offset_origin(p, n, d), glm::normalize(d)}))
        out.factors[from][into[world.instances[hit.triangle].value]] += area / rays;
    }
  }
  for (std::size_t i = 0; i < surfaces; ++i)
    for (double& f : out.factors[i]) f /= out.areas[i];
  return out;
}

/// View3D's factors of grey surfaces: e (I - (1 - e) F)^-1 F e, one emissivity for all.
Matrix grey(const Matrix& f, double emissivity) {
  const std::size_t n = f.size();
  Matrix g = f;
  for (int bounce = 0; bounce < 30; ++bounce) {
    Matrix next = f;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < n; ++k)
        for (std::size_t j = 0; j < n; ++j) next[i][j] += (1 - emissivity) * f[i][k] * g[k][j];
    g = std::move(next);
  }
  for (auto& row : g)
    for (double& v : row) v *= emissivity * emissivity;
  return g;
}

std::vector<double> numbers_in(const std::string& line) {
  std::vector<double> out;
  for (const std::string& word : split(line, ' '))
    if (const auto v = parse_number(trim(word))) out.push_back(*v);
  return out;
}

/// View3D's input: vertices "v", surfaces "s" with four corners, base, the surface it is part of, emissivity,
/// name.
struct View3d {
  Scene scene;
  std::vector<std::size_t> into;   ///< per instance
  std::vector<std::string> names;  ///< per surface
};
View3d read_view3d(const std::filesystem::path& file) {
  View3d out;
  const auto material = black(out.scene);
  std::vector<Vec3> vertices;
  for (const std::string& line : split(read_file(file), '\n')) {
    const std::string kind = lower(trim(line)).substr(0, 2);
    if (kind != "v " && kind != "s ") continue;
    const std::vector<double> v = numbers_in(line);
    if (kind == "v ") {
      vertices.push_back(
          Vec3(static_cast<float>(v.at(1)), static_cast<float>(v.at(2)), static_cast<float>(v.at(3))));
      continue;
    }
    const auto corner = [&](std::size_t i) { return vertices.at(static_cast<std::size_t>(v.at(i)) - 1); };
    Mesh mesh;
    mesh.positions = {corner(1), corner(2), corner(3), corner(4)};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.material = material;
    out.scene.meshes.push_back(std::move(mesh));
    Instance instance;
    instance.mesh = Id<Mesh>(out.scene.meshes.size() - 1);
    out.scene.instances.push_back(std::move(instance));
    const auto part_of = static_cast<std::size_t>(v.at(6));
    out.into.push_back(part_of > 0 ? out.into.at(part_of - 1) : out.names.size());
    if (part_of == 0) out.names.push_back(trim(line.substr(line.find("0.9") + 3)));
  }
  return out;
}

}  // namespace

Section form_factors(const std::filesystem::path& data) {
  Section out{"Form factors",
              "Closed forms (analytic test 4), and the irregular room of NIST's View3D with its 25 surfaces "
              "and their "
              "obstructions: 16 rows of "
              "16 factors of grey surfaces (emissivity 0.9, so that reflections between them count), the "
              "largest difference of "
              "a row. View3D's own figures are off by some 0.005: from FW2 to BOS its factor without "
              "reflections is 0.313, where 400,000 rays "
              "of an independent count give 0.319 +- 0.001. Ours are shares of cosine-distributed rays of "
              "the tracer that bakes use, "
              "262,144 a triangle.",
              {}};
  const auto pair = [&](const std::string& what, const auto& build, double reference) {
    Scene scene;
    const auto material = black(scene);
    build(scene, material);
    out.rows.push_back({what, reference, traced(scene, {0, 1}, 2, 1 << 18).factors[0][1], 0.003});
  };
  pair(
      "facing unit squares a unit apart",
      [](Scene& s, Id<Material> m) {
        add_quad(s, "a", m, Vec3(0), Vec3(0, 0, 1), Vec3(1, 0, 0));
        add_quad(s, "b", m, Vec3(0, 1, 0), Vec3(1, 0, 0), Vec3(0, 0, 1));
      },
      0.199825);
  pair(
      "unit squares at right angles",
      [](Scene& s, Id<Material> m) {
        add_quad(s, "a", m, Vec3(0), Vec3(0, 0, 1), Vec3(1, 0, 0));
        add_quad(s, "b", m, Vec3(0), Vec3(0, 1, 0), Vec3(0, 0, 1));
      },
      0.200044);
  pair(
      "coaxial unit disks a unit apart",
      [](Scene& s, Id<Material> m) {
        add_disk(s, "a", m, Vec3(0), Vec3(0, 1, 0), 1, 96);
        add_disk(s, "b", m, Vec3(0, 1, 0), Vec3(0, -1, 0), 1, 96);
      },
      0.5 * (3 - std::sqrt(5.0)));
  const std::filesystem::path folder = data / "conformance/view3d-formfactors/test/3d";
  const View3d room = read_view3d(folder / "test.vs3");
  const std::vector<std::string> expected = split(read_file(folder / "test-expected-output.txt"), '\n');
  const std::size_t n = room.names.size();
  const Traced ours = traced(room.scene, room.into, n, 1 << 18);
  const Matrix factors = grey(ours.factors, 0.9);
  const std::vector<double> areas = numbers_in(expected.at(1));
  if (areas.size() != n) throw Error("view3d", "has other surfaces than expected");
  for (std::size_t i = 0; i < n; ++i)
    out.rows.push_back({fmt::format("View3D {}, area", room.names[i]), areas[i], ours.areas[i], 1e-5});
  for (std::size_t i = 0; i < n; ++i) {
    const std::vector<double> reference = numbers_in(expected.at(2 + i));
    std::size_t worst = 0;
    for (std::size_t j = 0; j < n; ++j)
      if (std::abs(factors[i][j] - reference.at(j)) > std::abs(factors[i][worst] - reference.at(worst)))
        worst = j;
    // The row's largest factor is named, so that the page does not change with the noise; the error is the
    // row's worst.
    const auto most =
        static_cast<std::size_t>(std::max_element(reference.begin(), reference.end()) - reference.begin());
    Row row{fmt::format("View3D {} to {}", room.names[i], room.names[most]), reference[most],
            factors[i][most], 0.005, true};
    out.rows.push_back(row);
    out.rows.push_back({fmt::format("View3D {}, largest difference in its row", room.names[i]), 0,
                        std::abs(factors[i][worst] - reference[worst]), 0.005, true});
  }
  return out;
}

}  // namespace sconce::validation
