// SPDX-License-Identifier: Apache-2.0
#include "gpu/light_source.h"

namespace sconce::gpu {

namespace {

TextureParams array_of(const std::vector<Image>& pages, const std::vector<Image>& components) {
  return {.format = GL_RGB32F,
          .width = pages.front().width,
          .height = pages.front().height,
          .layers = static_cast<int>(pages.size() + components.size())};
}

}  // namespace

MixedPages::MixedPages(const Context& context, const std::vector<Image>& pages,
                       const std::vector<Image>& components)
    : page_count_(static_cast<int>(pages.size())),
      texture_(context, array_of(pages, components), "lightmap") {
  set(pages, components);
  context.check("uploading the lightmap");
}

void MixedPages::set(const std::vector<Image>& pages, const std::vector<Image>& components) const {
  for (std::size_t page = 0; page < pages.size(); ++page)
    texture_.upload(GL_RGB, GL_FLOAT, pages[page].data.data(), static_cast<int>(page));
  // Three of each page; the shader has all pages of one axis before those of the next.
  for (std::size_t i = 0; i < components.size(); ++i)
    texture_.upload(GL_RGB, GL_FLOAT, components[i].data.data(),
                    static_cast<int>((i % 3 + 1) * pages.size() + i / 3));
}

std::string lightmap_glsl(bool filter, int pages, std::size_t coefficients) {
  std::string text = "uniform sampler2DArray lightmap;\nuniform float lightmap_scale;\n\n";
  text += filter ? R"(vec3 lightmap_slice(vec2 uv, int slice) {
  return lightmap_scale * texture(lightmap, vec3(uv, float(slice))).rgb;
}
)"
                 : R"(vec3 lightmap_slice(vec2 uv, int slice) {
  ivec2 last = textureSize(lightmap, 0).xy - 1;
  vec2 at = clamp(uv * vec2(last + 1) - 0.5, vec2(0.0), vec2(last));
  ivec2 low = ivec2(at), high = min(low + 1, last);
  vec2 part = at - vec2(low);
  vec3 top = mix(texelFetch(lightmap, ivec3(low, slice), 0).rgb,
                 texelFetch(lightmap, ivec3(high.x, low.y, slice), 0).rgb, part.x);
  vec3 bottom = mix(texelFetch(lightmap, ivec3(low.x, high.y, slice), 0).rgb,
                    texelFetch(lightmap, ivec3(high, slice), 0).rgb, part.x);
  return lightmap_scale * mix(top, bottom, part.y);
}
)";
  if (coefficients == 1)
    return text + R"(
vec3 illuminance(vec2 uv, int page, vec3 offset) {
  return lightmap_slice(uv, page);
}
)";
  return text + "const int kPages = " + std::to_string(pages) + R"(;

vec3 illuminance(vec2 uv, int page, vec3 offset) {
  vec3 e = lightmap_slice(uv, page);
  if (offset == vec3(0.0)) return e;
  for (int axis = 0; axis < 3; ++axis)
    e += offset[axis] * lightmap_slice(uv, page + (axis + 1) * kPages);
  return max(e, vec3(0.0));
}
)";
}

std::string MixedPages::glsl() const {
  return lightmap_glsl(true, page_count_, static_cast<std::size_t>(texture_.params().layers / page_count_));
}

void MixedPages::bind(const Program& program, int first_unit) const {
  texture_.bind(first_unit);
  program.set("lightmap", first_unit);
  program.set("lightmap_scale", 1.0f);
}

}  // namespace sconce::gpu
