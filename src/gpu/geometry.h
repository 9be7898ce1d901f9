// SPDX-License-Identifier: Apache-2.0
// A package's triangles, materials and textures on the graphics device.
#pragma once

#include <map>
#include <vector>

#include "gpu/program.h"
#include "gpu/texture.h"
#include "package/shown_scene.h"

namespace sconce::gpu {

/// Every triangle has vertices of its own, for both sides' places in the lightmap: 68 bytes a vertex, and 24
/// more for normal maps.
class Geometry {
 public:
  /// Texture units that draw() uses: base colour, metallic, emission, normals.
  static constexpr int kUnits = 4;

  /// @param shown  must outlive it
  Geometry(const Context& context, const ShownScene& shown, bool normal_maps);
  ~Geometry();
  Geometry(const Geometry&) = delete;
  Geometry& operator=(const Geometry&) = delete;

  /// The same triangles at other places. @param shown  must outlive it from now on
  void follow(const ShownScene& shown);

  /// Draws everything with `surface` (gpu/surface.glsl), which is in use.
  /// @param weights  of the light groups, for what emits
  void draw(const Program& surface, const std::vector<Rgb>& weights) const;
  /// Whether there are any.
  bool normal_maps() const { return normal_maps_; }
  /// Draws shapes alone, for gpu/shadow_fragment.glsl.
  void draw_shapes(const Program& shader) const;

 private:
  /// Triangles that share all that is set between draws.
  struct Batch {
    Id<Material> material;
    Id<LightGroup> group;  ///< of what emits
    GLint first;
    GLsizei count;
  };
  /// A texture as sRGB or as data.
  using Use = std::pair<uint32_t, bool>;

  void upload_triangles();
  void upload_textures(const Context& context);
  void bind(const TextureUse& use, bool srgb, int unit) const;
  void set_base(const Program& program, const Material& material) const;

  const ShownScene* shown_;
  bool normal_maps_;
  std::vector<Batch> batches_;
  std::map<Use, Texture> textures_;
  Texture white_;
  GLuint vertices_ = 0, normals_ = 0, layout_ = 0;
};

}  // namespace sconce::gpu
