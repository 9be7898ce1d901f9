// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "gpu/program.h"
#include "gpu/texture.h"
#include "image/image.h"

namespace sconce::gpu {

/// Where a picture takes the light of the lightmap from.
class LightSource {
 public:
  virtual ~LightSource() = default;
  /// Declares what it reads and defines vec3 illuminance(vec2 uv, int page, vec3 offset): mixed light in lux,
  /// bilinear. offset: a mapped normal minus the surface's, world space; of no matter where the light's
  /// directions are not known.
  virtual std::string glsl() const = 0;
  /// Whether they are known: normal maps are seen then.
  virtual bool directional() const { return false; }
  /// @param first_unit  texture units from here on are its own
  virtual void bind(const Program& program, int first_unit) const = 0;
};

/// illuminance() by `uniform sampler2DArray lightmap` of mixed pages, times `uniform float lightmap_scale`:
/// all pages of E, then, of a basis with more coefficients, those of the next ones.
/// @param filter  by the texture unit, or in the shader
std::string lightmap_glsl(bool filter, int pages, std::size_t coefficients);

/// Pages that are mixed already.
class MixedPages : public LightSource {
 public:
  /// @param pages       as of mix_pages()
  /// @param components  as of mix_components(); may be empty
  MixedPages(const Context& context, const std::vector<Image>& pages,
             const std::vector<Image>& components = {});
  /// Others of the same size. @pre their numbers are those of the first ones
  void set(const std::vector<Image>& pages, const std::vector<Image>& components = {}) const;
  std::string glsl() const override;
  bool directional() const override { return page_count_ < texture_.params().layers; }
  void bind(const Program& program, int first_unit) const override;

 private:
  int page_count_;
  Texture texture_;
};

}  // namespace sconce::gpu
