// SPDX-License-Identifier: Apache-2.0
// All that a foreign renderer needs for an ambient term in a texture: the atlas of its scene, its materials,
// its radiosity. Its geometry is taken part by part, every face with three vertices of its own.
#pragma once

#include "detect/realtime.h"
#include "receive/atlas.h"

namespace sconce {

/// Per part, three for each of its faces, in the order of its vertices.
using PartCorners = std::vector<std::vector<Vec2>>;

/// Adds what the renderer draws at once: a mesh and its instance.
/// @param positions  three per face
/// @param normals    as many, of any length
/// @param place      of both in the world
void add_part(Scene& scene, Id<Material> material, std::vector<Vec3> positions, std::vector<Vec3> normals,
              const Mat4& place = Mat4(1));

/// An operator that rooms have after a few seconds.
TransferParams quick_transfer();

class AmbientMap {
 public:
  /// Unwraps the scene into one texture.
  /// @param scene    of parts
  /// @param density  texels per metre
  AmbientMap(Scene scene, float density);

  const World& world() const { return world_; }
  const TracedScene& traced() const { return traced_; }
  /// Where the faces lie in the texture, in texels, and its size; rows go up.
  const TextureSpace& space() const { return space_; }
  /// The vertices' texture coordinates, 0 to 1; of a face without light, 0.
  PartCorners coordinates() const;
  /// Where a drawing wants the vertices, 0 to 1; those of faces that it does not want lie at 2, outside.
  PartCorners places(const DrawRequest& request) const;
  /// The same as positions in clip space, -1 to 1, for renderers whose shaders are not rewritten but
  /// extended.
  PartCorners clip_places(const DrawRequest& request) const;

  /// Asks the renderer for its materials and follows rays, once.
  /// @param params  their sums are kept whatever they say: even light stays exact
  /// @param look    how materials are detected
  /// @throws Error, UsageError, Cancelled as detect_materials() and make_operator()
  void start(const HostRenderer& host, TransferParams params = quick_transfer(),
             const Progress& progress = {}, const DetectParams& look = {});

  /// Looks at the materials again, after the renderer changed them: without rays. @pre started
  /// @throws Error, Cancelled: then the old ones stay
  void detect(const Progress& progress = {});

  /// As RealtimeRadiosity::update(). @pre started
  FrameReport update(const FrameBudget& budget = {}) { return radiosity_->update(budget); }
  /// Height x width, to be multiplied by the surface's own reflectance and added.
  std::span<const Rgb> texels() const { return radiosity_->ambient(); }
  /// The same times the reflectance that was detected, of the material, face or texel: for renderers that can
  /// only add. Texels around a face have its reflectance, so that filtering is right.
  std::vector<Rgb> reflected() const;
  const Detection& detection() const { return detection_; }
  RealtimeRadiosity& radiosity() { return *radiosity_; }

 private:
  PartCorners corners(std::span<const uint32_t> triangles, std::span<const std::array<Vec2, 3>> at,
                      Vec2 whole, Vec2 others) const;
  void spread_reflectance();

  Scene scene_;
  World world_;
  Tracer tracer_;
  TracedScene traced_;
  Atlas atlas_;
  TextureSpace space_;
  Detection detection_;
  HostRenderer host_;
  DetectParams look_;
  std::unique_ptr<RealtimeRadiosity> radiosity_;
  std::vector<Rgb> reflectance_;  ///< per texel
};

}  // namespace sconce
