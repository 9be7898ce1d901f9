// SPDX-License-Identifier: Apache-2.0
#include "light/mesh_lamp.h"

#include "core/triangle_grid.h"
#include "light/spherical_triangle.h"

namespace sconce {

namespace {

constexpr int kMaxCut = 64;  // pieces per edge of a textured emissive triangle, at most
constexpr std::size_t kMaxPieces = 1 << 20;
constexpr std::size_t kFew = 4;  // pieces of a lamp that is sampled by solid angle, at most
constexpr double kFloor = 0.1;   // share of the picking density that ignores the texture

/// Texels of the emission texture along the longest edge of the triangle.
double texels_along(const Scene& scene, const World& world, const Material& material, uint32_t t) {
  const TextureUse& use = material.emission_texture;
  if (!use.texture.valid()) return 0;
  const Texture& texture = scene[use.texture];
  const Vec2 size(texture.pixels.width, texture.pixels.height);
  const Vec2 corner[3] = {use.transform(world.texcoord(t, Vec2(0, 0), use.texcoord)) * size,
                          use.transform(world.texcoord(t, Vec2(1, 0), use.texcoord)) * size,
                          use.transform(world.texcoord(t, Vec2(0, 1), use.texcoord)) * size};
  double longest = 0;
  for (int e = 0; e < 3; ++e)
    longest = std::max(longest, static_cast<double>(glm::length(corner[(e + 1) % 3] - corner[e])));
  return std::isfinite(longest) ? longest : 0;
}

bool is_uniform(const Material& material) {
  return !material.emission_texture.texture.valid() && material.alpha_mode != Material::Alpha::mask;
}

/// Height of x over the face of a piece, m.
float height(const MeshLamp::Piece& piece, const Vec3& x) {
  return glm::dot(x - piece.p0, piece.normal);
}

SphericalTriangle seen(const MeshLamp::Piece& piece, const Vec3& x) {
  const Vec3 a = piece.p0 - x;
  return {a, a + piece.e1, a + piece.e2};
}

/// Solid angles of a lamp of few pieces from a point.
struct SolidAngles {
  float of[kFew], sum = 0;

  SolidAngles(const MeshLamp& lamp, const Vec3& x) {
    for (std::size_t p = 0; p < lamp.pieces.size(); ++p) {
      const bool lit = lamp.two_sided || height(lamp.pieces[p], x) > 0;
      of[p] = lit ? seen(lamp.pieces[p], x).solid_angle() : 0.0f;
      sum += of[p];
    }
  }
};

/// A direction uniform in what x sees of the lamp.
bool sample_solid_angle(const MeshLamp& lamp, const Vec3& x, Vec2 u, LightSample& out) {
  const SolidAngles angles(lamp, x);
  if (!(angles.sum > 1e-6f)) return false;
  float left = u.x * angles.sum;
  std::size_t p = 0;
  while (p + 1 < lamp.pieces.size() && left >= angles.of[p]) left -= angles.of[p++];
  if (!(angles.of[p] > 0)) return false;
  const MeshLamp::Piece& piece = lamp.pieces[p];
  out.direction = seen(piece, x).sample({std::min(left / angles.of[p], 0x1.fffffep-1f), u.y});
  const float cosine = std::abs(glm::dot(out.direction, piece.normal));
  if (!(cosine > 1e-7f)) return false;
  out.distance = std::abs(height(piece, x)) / cosine;
  out.radiance = piece.emission;
  out.pdf = 1 / angles.sum;
  out.delta = false;
  return true;
}

}  // namespace

Rgb emission_at(const Scene& scene, const World& world, uint32_t triangle, Vec2 barycentric) {
  const Material& material = scene[world.materials[triangle]];
  if (is_uniform(material)) return material.emission;
  const Shade s = shade(scene, world, triangle, barycentric);
  return material.alpha_mode == Material::Alpha::mask && s.alpha < material.alpha_cutoff ? Rgb() : s.emission;
}

Lamp make_mesh_lamp(const Scene& scene, const World& world, Id<Instance> instance, uint32_t first,
                    uint32_t count) {
  const Instance& node = scene[instance];
  const Material& material = scene[world.materials[first]];
  MeshLamp lamp;
  lamp.first_triangle = first;
  lamp.two_sided = material.double_sided;
  lamp.uniform = is_uniform(material);
  lamp.cut.resize(count, 1);
  double pieces = 0;
  for (uint32_t i = 0; i < count; ++i) {
    const double texels = texels_along(scene, world, material, first + i);
    lamp.cut[i] = static_cast<uint16_t>(std::clamp(std::ceil(texels / 2), 1.0, static_cast<double>(kMaxCut)));
    pieces += static_cast<double>(lamp.cut[i]) * lamp.cut[i];
  }
  if (pieces > static_cast<double>(kMaxPieces)) {
    const double shrink = std::sqrt(static_cast<double>(kMaxPieces) / pieces);
    for (uint16_t& c : lamp.cut) c = static_cast<uint16_t>(std::max(1.0, c * shrink));
  }

  std::vector<double> areas, relative;
  double flux[3] = {0, 0, 0};
  Bounds bounds;
  const float strength = std::max(1e-30f, luminance(material.emission));
  double mean_relative = 0;
  for (uint32_t i = 0; i < count; ++i) {
    const uint32_t t = first + i;
    const int n = lamp.cut[i];
    lamp.first_piece.push_back(static_cast<uint32_t>(lamp.pieces.size()));
    const double area = static_cast<double>(world.area(t)) / n / n;
    for (const Vec2 corner : {Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)}) bounds.add(world.position(t, corner));
    for (uint32_t part = 0; part < static_cast<uint32_t>(n * n); ++part) {
      MeshLamp::Piece piece;
      piece.triangle = t;
      const auto [b0, b1, b2] = grid_corners(part, n);
      piece.b0 = b0, piece.b1 = b1, piece.b2 = b2;
      piece.p0 = world.position(t, piece.b0);
      piece.e1 = world.position(t, piece.b1) - piece.p0;
      piece.e2 = world.position(t, piece.b2) - piece.p0;
      piece.normal = world.face_normals[t];
      piece.emission = material.emission;
      Rgb mean;
      for (const Vec2 w : {Vec2(1 / 3.0f), Vec2(0.6f, 0.2f), Vec2(0.2f, 0.6f), Vec2(0.2f)})
        mean += 0.25f * emission_at(scene, world, t,
                                    piece.b0 + w.x * (piece.b1 - piece.b0) + w.y * (piece.b2 - piece.b0));
      lamp.pieces.push_back(piece);
      areas.push_back(area);
      relative.push_back(static_cast<double>(luminance(mean) / strength));
      lamp.area += area;
      mean_relative += area * relative.back();
      const double sides = lamp.two_sided ? 2 : 1;
      flux[0] += sides * static_cast<double>(kPi) * area * static_cast<double>(mean.r);
      flux[1] += sides * static_cast<double>(kPi) * area * static_cast<double>(mean.g);
      flux[2] += sides * static_cast<double>(kPi) * area * static_cast<double>(mean.b);
    }
  }
  mean_relative /= lamp.area;
  std::vector<double> weights(areas.size());
  double total = 0;
  for (std::size_t p = 0; p < areas.size(); ++p) {
    weights[p] = areas[p] * ((1 - kFloor) * relative[p] + kFloor * mean_relative);
    if (mean_relative <= 0) weights[p] = areas[p];
    total += weights[p];
  }
  lamp.table = AliasTable(weights);
  for (std::size_t p = 0; p < areas.size(); ++p)
    lamp.pieces[p].density = static_cast<float>(weights[p] / total / areas[p]);

  lamp.few = lamp.uniform && lamp.pieces.size() <= kFew;
  lamp.center = bounds.center();
  lamp.radius = 0.5f * bounds.diagonal();
  const Vec3 normal = world.face_normals[first];
  bool flat = !lamp.two_sided;
  float low = 1e30f;
  for (uint32_t t = first; t < first + count; ++t) {
    flat = flat && glm::dot(world.face_normals[t], normal) > 0.99999f;
    for (const Vec2 corner : {Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)})
      low = std::min(low, glm::dot(normal, world.position(t, corner)));
  }
  if (flat) {
    lamp.axis = normal;
    lamp.plane = low;
  }
  return {node.name, node.group, std::move(lamp),
          Rgb(static_cast<float>(flux[0]), static_cast<float>(flux[1]), static_cast<float>(flux[2])), false};
}

bool sample(const MeshLamp& lamp, const Scene& scene, const World& world, const Vec3& x, Vec2 u,
            LightSample& out) {
  if (lamp.by_solid_angle(x)) return sample_solid_angle(lamp, x, u, out);
  std::pair<const MeshLamp::Piece*, Vec2> where;
  if (!lamp.sample(x, u, out, &where)) return false;
  const auto& [piece, b] = where;
  out.radiance = emission_at(scene, world, piece->triangle,
                             piece->b0 + b.x * (piece->b1 - piece->b0) + b.y * (piece->b2 - piece->b0));
  return true;
}

EmittedLight emit(const MeshLamp& lamp, const Scene& scene, const World& world, Vec2 where, Vec2 whither) {
  const MeshLamp::Piece& piece = lamp.pieces[lamp.table.sample(where.x)];
  const Vec2 b = square_to_triangle(where);
  EmittedLight out;
  out.position = piece.p0 + b.x * piece.e1 + b.y * piece.e2;
  out.normal = piece.normal;
  if (lamp.two_sided) {
    whither.x *= 2;
    if (whither.x >= 1) out.normal = -out.normal, whither.x -= 1;
  }
  out.direction = Frame(out.normal).to_world(square_to_cosine(whither));
  const Rgb radiance =
      lamp.uniform ? piece.emission
                   : emission_at(scene, world, piece.triangle,
                                 piece.b0 + b.x * (piece.b1 - piece.b0) + b.y * (piece.b2 - piece.b0));
  out.flux = radiance * (kPi * (lamp.two_sided ? 2.0f : 1.0f) / piece.density);
  return out;
}

float pdf(const MeshLamp& lamp, const World& world, uint32_t triangle, Vec2 barycentric, float distance,
          const Vec3& direction) {
  const uint32_t i = triangle - lamp.first_triangle;
  if (lamp.few) {
    const Vec3 x = world.position(triangle, barycentric) - distance * direction;
    if (lamp.by_solid_angle(x)) {
      const float sum = SolidAngles(lamp, x).sum;
      return sum > 1e-6f ? 1 / sum : 0.0f;
    }
  }
  const std::size_t piece = lamp.first_piece[i] + grid_part(barycentric, lamp.cut[i]);
  const float cosine = std::abs(glm::dot(direction, world.face_normals[triangle]));
  return cosine > 1e-7f ? lamp.pieces[piece].density * distance * distance / cosine : 0.0f;
}

}  // namespace sconce
