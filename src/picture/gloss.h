// SPDX-License-Identifier: Apache-2.0
// What a surface mirrors towards an eye: the metallic-roughness material of glTF 2.0 (appendix B), its GGX
// lobe sampled by visible normals.
#pragma once

#include "core/receiver.h"
#include "scene/world.h"

namespace sconce {

/// One direction in which a surface mirrors. What it sends towards the eye is then
/// diffuse * rho (1 - metallic)/pi E + mirrored * L(direction), in the mean over all u.
struct Gloss {
  Vec3 direction{0};  ///< unit, above the surface
  Rgb mirrored;  ///< Fresnel's share (Schlick); the facets' mutual shadows are left out, so that no light is
                 ///< lost
  float diffuse = 1;  ///< what a dielectric's surface lets through
};

/// Reflections that pictures follow, one behind the other, unless asked not to.
inline constexpr int kReflections = 2;

/// Dielectrics (of 0.04 towards the normal) mirror up to Material::kGlossy, metals whatever their roughness.
bool mirrors(const Shade& surface);

/// Source of the sampling: Dupuy and Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps".
/// @param to_eye  unit, above the surface
/// @param at      where; its normals on the side of the eye
/// @param u       random, in [0,1)
Gloss gloss(const Shade& surface, const Vec3& to_eye, const SurfacePoint& at, Vec2 u);

/// The same lobe for light that comes from a known direction: luminance towards the eye per lux of a surface
/// that faces the light; its integral over all directions is Gloss::mirrored.
/// @param least_alpha  of the lobe's width (roughness squared): a lamp that is a point is as wide
Rgb gloss_of(const Shade& surface, const Vec3& to_eye, const SurfacePoint& at, const Vec3& direction,
             float least_alpha);
/// Density per steradian with which gloss() takes that direction.
float gloss_density(const Shade& surface, const Vec3& to_eye, const SurfacePoint& at, const Vec3& direction,
                    float least_alpha);

}  // namespace sconce
