// SPDX-License-Identifier: Apache-2.0
// Lamps: what rays and solvers see of the scene's lights. One file per kind; a new kind is one file and one
// row of the variant (the compiler then lists what is missing).
#pragma once

#include <memory>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "light/alias_table.h"
#include "scene/world.h"

namespace sconce {

class NearField;

/// Light that arrives at a point from one lamp along one direction.
struct LightSample {
  Vec3 direction;      ///< from the point to the lamp, unit
  float distance = 0;  ///< metres; kInfinite for sun and sky
  Rgb radiance;  ///< cd/m2; for delta lamps the illuminance on a facing surface, lux. Light fields have terms
                 ///< < 0
  float pdf = 0;       ///< per steradian, of this direction given this lamp; 1 for delta lamps
  bool delta = false;  ///< no direction picked at random ever meets this lamp
};
inline constexpr float kInfinite = 1e30f;
/// Where a shadow ray ends, in metres along the sample's direction; <= 0 where nothing can stand between. The
/// lamp's own surface must not count as an occluder.
/// @param offset  distance between the point and the ray's start (offset_origin)
inline float shadow_end(const LightSample& light, float offset) {
  return light.delta ? light.distance : light.distance * (1 - 1e-4f) - 4 * offset;
}

/// A particle of light that leaves a lamp; a mean over particles is a mean over the lamp's light.
struct EmittedLight {
  Vec3 position;  ///< on the lamp, for sun and sky on a disk that the light crosses before the scene
  Vec3 normal{
      0};  ///< of the lamp's surface there, on the side of `direction`; zero where there is no surface
  Vec3 direction;  ///< away from the lamp, unit
  Rgb flux;  ///< lm per channel; its mean is the lamp's flux, for sun and sky the flux through the disk. < 0
             ///< where a light field is
};

/// Point or spot: I / d2, windowed by KHR_lights_punctual's range and cone.
struct PunctualLamp {
  Vec3 position, axis;
  Rgb intensity;                         ///< cd
  float range = 0;                       ///< m, 0 = infinite
  float cos_inner = -1, cos_outer = -1;  ///< -1: a point light
};
/// A slide, lit evenly on a screen across the axis.
struct ProjectorLamp {
  std::shared_ptr<const Image> slide;
  Vec3 position;
  Mat3 to_world{1.0f};  ///< of right, up, backwards
  Vec2 half;            ///< of the picture at distance 1, m
  Rgb intensity;        ///< cd along the axis where the slide is 1
  AliasTable pixels;    ///< probability per pixel
};
/// Parallel light.
struct SunLamp {
  Vec3 direction;   ///< towards the sun, unit
  Rgb illuminance;  ///< lux on a facing surface
};
/// Light from infinity: a constant, or a lat-long image sampled by luminance x solid angle.
struct SkyLamp {
  Rgb scale;                     ///< multiplies the image; the radiance where there is none, cd/m2
  const Image* image = nullptr;  ///< of the scene's SkyLight
  Mat3 to_local{1.0f};
  AliasTable pixels;  ///< probability per pixel
};
/// The front side of an emissive mesh instance (both sides where double-sided). Its triangles are
/// consecutive.
struct MeshLamp {
  struct Piece {  ///< part of a triangle, small enough that its emission is nearly uniform
    uint32_t triangle;
    Vec2 b0, b1, b2;  ///< barycentric corners
    Vec3 p0, e1, e2;  ///< corner and edges, world
    Vec3 normal;
    Rgb emission;   ///< cd/m2, where it does not vary over the lamp
    float density;  ///< probability per m2 of a point of this piece
  };
  std::vector<Piece> pieces;
  AliasTable table;  ///< probability per piece: area x relative emission, never the strength
  uint32_t first_triangle = 0;
  std::vector<uint32_t> first_piece;  ///< per triangle
  std::vector<uint16_t> cut;          ///< per triangle: it is cut into cut x cut pieces
  Vec3 center{0};
  float radius = 0;  ///< of the bounding sphere
  Vec3 axis{0};      ///< the common normal of a flat lamp that shines to one side, else zero
  float plane = 0;   ///< no part of a flat lamp lies below dot(axis, p) = plane
  double area = 0;   ///< m2, one side
  bool two_sided = false;
  bool uniform = false;  ///< no emission texture, no alpha mask
  bool few = false;      ///< uniform and of so few triangles that near points sample what they see of each

  /// Whether points of the lamp are picked by solid angle from x, not by area.
  bool by_solid_angle(const Vec3& x) const {
    constexpr float kNear = 3;  // radii; beyond, the difference is small
    const Vec3 to = center - x;
    return few && glm::dot(to, to) < kNear * kNear * radius * radius;
  }

  /// A point by the table; its radiance is the material's emission. Inline: this is the bake's most frequent
  /// call.
  /// @param where  when given: piece and barycentric coordinates within it of the point
  bool sample(const Vec3& x, Vec2 u, LightSample& out, std::pair<const Piece*, Vec2>* where = nullptr) const {
    const Piece& piece = pieces[table.sample(u.x)];
    const Vec2 b = square_to_triangle(u);
    const Vec3 to = piece.p0 + b.x * piece.e1 + b.y * piece.e2 - x;
    const float d2 = glm::dot(to, to);
    const float facing = two_sided ? std::abs(glm::dot(to, piece.normal)) : -glm::dot(to, piece.normal);
    if (!(d2 > 1e-14f)) return false;
    const float inverse = 1 / std::sqrt(d2), cosine = facing * inverse;
    if (!(cosine > 1e-7f)) return false;
    out.direction = to * inverse;
    out.distance = d2 * inverse;
    out.radiance = piece.emission;
    out.pdf = piece.density * d2 / cosine;
    out.delta = false;
    if (where != nullptr) *where = {&piece, b};
    return true;
  }
};

/// A measured lamp: every point of its opening shines with the table's distribution.
struct LuminaireLamp {
  const Photometry* table = nullptr;  ///< of the scene's Luminaire
  Vec3 position;                      ///< centre of the opening
  Mat3 to_world{1.0f};                ///< of the luminaire's frame
  Rgb scale;                          ///< multiplies the table
  AliasTable cells;                   ///< probability per cell of the table: its flux
  double flux = 0;                    ///< of the table, lm
};

/// A lamp measured from near: every term of its light field a textured spot at its filter's centre, or points
/// of the sampling plane where that is not good enough.
struct NearFieldLamp {
  std::shared_ptr<const NearField> field;  ///< shared by all lamps of one luminaire
  Vec3 position;                           ///< of the light field's origin
  Mat3 to_world{1.0f};                     ///< of the luminaire's frame
  Rgb scale;                               ///< multiplies the light field
  float exact_below = 0;                   ///< LuminaireLight's
};

using LampShape =
    std::variant<PunctualLamp, SunLamp, SkyLamp, MeshLamp, LuminaireLamp, NearFieldLamp, ProjectorLamp>;

struct Lamp {
  std::string name;
  Id<LightGroup> group;
  LampShape shape;
  Rgb flux;               ///< lm per channel (Rec. 709); for sun and sky lux and pi x mean cd/m2
  bool infinite = false;  ///< sun or sky
};

/// Where lamps are and where they can shine, for quick bounds: spheres, cut by a plane, a cone or a range.
/// One array per property, so that a loop over lamps is a loop over vectors.
struct LampBounds {
  std::vector<float> x, y, z, radius;
  std::vector<float> axis_x, axis_y, axis_z,
      plane;                  ///< nothing below dot(axis, p) = plane is lit; axis 0: everything is
  std::vector<float> least2;  ///< squared distance below which importance no longer grows
  std::vector<float> range2;
  struct Cone {
    uint32_t lamp;
    Vec3 axis;
    float cosine;
  };
  std::vector<Cone> cones;
  std::vector<std::pair<uint32_t, Vec3>> suns;  ///< and the direction towards them
  std::vector<uint32_t> everywhere;             ///< skies
};

/// All lamps of a scene with what look-ups need. The scene and world must outlive it.
class Lamps {
 public:
  Lamps(const Scene& scene, const World& world);

  const std::vector<Lamp>& all() const { return lamps_; }
  std::size_t size() const { return lamps_.size(); }

  /// Light from lamp i at x for u in [0,1)^2, before visibility; nothing from behind a lamp or outside its
  /// cone.
  /// @return false where nothing arrives; `out` is then undefined
  [[gnu::always_inline]] bool sample(std::size_t i, const Vec3& x, Vec2 u, LightSample& out) const {
    const auto* mesh = std::get_if<MeshLamp>(&lamps_[i].shape);
    return mesh != nullptr && mesh->uniform && !mesh->by_solid_angle(x) ? mesh->sample(x, u, out)
                                                                        : sample_other(i, x, u, out);
  }

  /// A particle from lamp i, (where, whither) in [0,1)^4; position by area x texel, direction by intensity.
  /// Sun and sky: through a disk as large as the sphere around the scene's bounds.
  EmittedLight emit(std::size_t i, Vec2 where, Vec2 whither) const;
  /// Share of a particle's flux that counts after its first flight, by the lamp's range; 1 for most lamps.
  float reach(std::size_t i, float distance) const;

  /// Lamp of an emissive triangle, or -1.
  int lamp_of(uint32_t triangle) const { return lamp_of_.empty() ? -1 : lamp_of_[triangle]; }
  /// Emission of a triangle towards a viewer on its front or back; black from behind unless two-sided. cd/m2
  Rgb emission(uint32_t triangle, Vec2 barycentric, bool back) const;
  /// Density per steradian with which sample(lamp_of(triangle), x) picks the point that a ray of `distance`
  /// along `direction` hits.
  float pdf(uint32_t triangle, Vec2 barycentric, float distance, const Vec3& direction) const;

  /// Sky lamps, and what a ray that leaves the scene sees of one.
  const std::vector<uint32_t>& skies() const { return skies_; }
  Rgb sky_radiance(std::size_t i, const Vec3& direction) const;
  float sky_pdf(std::size_t i, const Vec3& direction) const;

  /// How much of each lamp may reach (x, n) at unit strength relative to its mean over the scene: a geometric
  /// bound, never its strength; 0 where nothing can (below the horizon, behind a flat lamp, outside the
  /// cone). Dimensionless.
  /// @param out  one per lamp
  void importances(const Vec3& x, const Vec3& n, std::span<float> out) const;

 private:
  bool sample_other(std::size_t i, const Vec3& x, Vec2 u, LightSample& out) const;

  const Scene* scene_;
  const World* world_;
  std::vector<Lamp> lamps_;
  std::vector<int> lamp_of_;
  std::vector<uint32_t> skies_;
  LampBounds bounds_;
  float scene_radius2_;
};

/// What a fader needs to know of a group's lamps (contract.md, "Colour").
struct GroupFlux {
  double lumens = 0;
  Rgb color{1.0f};        ///< flux-weighted, luminance 1; white where there is no flux
  double spread = 0;      ///< largest channel difference of any lamp's luminance-1 colour from `color`
  bool infinite = false;  ///< sky or sun among them: no lumens
  std::vector<std::string> lamps;
};
std::vector<GroupFlux> group_flux(const Scene& scene, const Lamps& lamps);

}  // namespace sconce
