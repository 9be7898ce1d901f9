// SPDX-License-Identifier: Apache-2.0
#include "gpu/light_source.h"

namespace sconce::gpu {

namespace {

TextureParams array_of(const std::vector<Image>& pages) {
  return {.format = GL_RGB32F,
          .width = pages.front().width,
          .height = pages.front().height,
          .layers = static_cast<int>(pages.size())};
}

}  // namespace

MixedPages::MixedPages(const Context& context, const std::vector<Image>& pages)
    : texture_(context, array_of(pages), "lightmap") {
  for (std::size_t page = 0; page < pages.size(); ++page)
    texture_.upload(GL_RGB, GL_FLOAT, pages[page].data.data(), static_cast<int>(page));
  context.check("uploading the lightmap");
}

std::string MixedPages::glsl() const {
  return R"(uniform sampler2DArray lightmap;

vec3 illuminance(vec2 uv, int page) {
  return texture(lightmap, vec3(uv, float(page))).rgb;
}
)";
}

void MixedPages::bind(const Program& program, int first_unit) const {
  texture_.bind(first_unit);
  program.set("lightmap", first_unit);
}

}  // namespace sconce::gpu
