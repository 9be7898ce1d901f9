// SPDX-License-Identifier: Apache-2.0
// Materials out of a foreign renderer's pictures: emission, transmission, reflectance. Source: Hrbek 2006,
// "Realtime radiosity integration", with the formulas corrected (methods.md 1B): emission is taken off the
// transmission too, and a white card under the same light tells what the renderer's "1" is.
#pragma once

#include "core/progress.h"
#include "detect/lobe.h"

namespace sconce {

/// What a surface does with light; linear, in the renderer's own unit.
struct SurfaceResponse {
  Rgb emission;
  Rgb transmission;  ///< share of the light from behind that goes through
  Rgb reflectance;   ///< diffuse; with the transmission at most 0.98
};

struct DetectedFace {
  uint32_t triangle;  ///< of the World
  SurfaceResponse response;
};

struct DetectedMaterial {
  SurfaceResponse response;  ///< mean over its faces that were looked at, by area
  std::size_t faces = 0;     ///< those; 0: no face bears the material, and nothing is known of it
  float spread = 0;          ///< of reflectance over them, largest distance to the mean
  float residual = 0;        ///< of what it does under held-out lights: share of a white card's light
  bool lambertian = true;    ///< residual below the limit
  std::optional<Lobe> lobe;  ///< where one was asked for and the material is not Lambertian
  bool two_sided = false;    ///< the renderer lights backs, too; asked where light goes through or both show

  bool lets_through() const;  ///< more than rounding makes
};

struct DetectParams {
  /// By material, from its largest faces; or for each face, or each texel of each face, for renderers whose
  /// materials are not uniform.
  enum class Per : uint8_t { material, face, texel } per = Per::material;
  int faces = 8;                 ///< per material
  int texels = 8;                ///< a side of each face
  float texel = 0.05f;           ///< m, by texel: its size
  int most_texels = 256;         ///< by texel: a side of each face
  float flag_above = 0.02f;      ///< residual; 8-bit targets have a limit of their own where theirs is higher
  bool lobes = false;            ///< fit one to each material that is not Lambertian
  float spread_above = 0.1f;     ///< warn where a material's faces differ by more
  float most_reflected = 0.98f;  ///< reflectance + transmission, so that light dies out
};

struct Detection {
  std::vector<DetectedMaterial> materials;  ///< per Scene material
  std::vector<DetectedFace> faces;          ///< that were looked at, by triangle
  TextureSpace space;                       ///< by texel: where all faces lie, by triangle
  std::vector<SurfaceResponse> texels;      ///< by texel: per pixel of it; else empty
  std::size_t undrawn = 0;                  ///< faces of them that the renderer did not draw
  /// How far all lights' light on a face depends on where on the target it is drawn, largest share: above a
  /// few per cent the renderer looks lights up by the screen (clusters, tiles) and does not fit.
  float placement = 0;
  CaptureCost cost;
  std::vector<std::string> findings;  ///< one line each: materials that are not Lambertian, not uniform

  /// Of its face where that was looked at, else of its material.
  const SurfaceResponse& of(const World& world, uint32_t triangle) const;
  /// Of a point: between texels where those were looked at, else as of().
  SurfaceResponse at(const World& world, uint32_t triangle, Vec2 barycentric) const;
};

/// Draws with no light on black and on white, with one light on the faces and on a white card in their place,
/// along each axis; those of transparent or double-sided materials from behind; then with lights and eyes
/// held out (lambertian.h), and with all lights at two places.
/// @throws Error naming the renderer's fault: besides capture()'s, it draws nothing, does not clear, or its
/// card does not answer; Cancelled
Detection detect_materials(const Scene& scene, const World& world, const HostRenderer& host,
                           const DetectParams& params = {}, const Progress& progress = {});

/// The scene with its materials replaced by the detected ones; materials of which nothing is known stay.
Scene with_detected(Scene scene, const Detection& detection);

}  // namespace sconce
