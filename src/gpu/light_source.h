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
  /// Declares what it reads and defines vec3 illuminance(vec2 uv, int page): mixed light in lux, bilinear.
  virtual std::string glsl() const = 0;
  /// @param first_unit  texture units from here on are its own
  virtual void bind(const Program& program, int first_unit) const = 0;
};

/// illuminance() by `uniform sampler2DArray lightmap` of mixed pages, times `uniform float lightmap_scale`.
/// @param filter  by the texture unit, or in the shader
std::string lightmap_glsl(bool filter);

/// Pages that are mixed already.
class MixedPages : public LightSource {
 public:
  /// @param pages  as of mix_pages()
  MixedPages(const Context& context, const std::vector<Image>& pages);
  std::string glsl() const override;
  void bind(const Program& program, int first_unit) const override;

 private:
  Texture texture_;
};

}  // namespace sconce::gpu
