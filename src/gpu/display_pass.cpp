// SPDX-License-Identifier: Apache-2.0
#include "gpu/display_pass.h"

namespace sconce::gpu {

namespace {

constexpr std::string_view kVersion = "#version 450 core\n";
constexpr std::string_view kTone = R"(
uniform sampler2D sum;
uniform float scale;
uniform float maximum, adaptation, drago_bias;
out vec4 color;
void main() {
  vec3 exposed = texelFetch(sum, ivec2(gl_FragCoord.xy), 0).rgb * scale;
  color = vec4(linear_to_srgb(tone_map(exposed, ToneParams(maximum, adaptation, drago_bias))), 1.0);
}
)";
// Twin of false_color() in tone/false_color.cpp.
constexpr std::string_view kFalseColor = R"(
uniform sampler2D sum;
uniform float scale, low, high;
uniform bool decades;
uniform vec3 ticks[16];
uniform int tick_count;
out vec4 color;

float value(ivec2 at) {
  return scale * dot(texelFetch(sum, at, 0).rgb, vec3(0.2126, 0.7152, 0.0722));
}

int band(float v) {
  int count = 0;
  for (int i = 0; i < tick_count; ++i) count += v >= ticks[i].x ? 1 : 0;
  return count;
}

bool line_between(float a, float b) {
  return abs(a - b) <= 0.15 * max(a, b) && band(a) != band(b);
}

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy), last = textureSize(sum, 0) - 1;
  float v = value(at), inside = v > low ? v : low;
  vec3 code = false_color(decades ? log(inside / low) / log(high / low) : (inside - low) / (high - low));
  if (tick_count > 0 && (line_between(v, value(min(at + ivec2(1, 0), last))) ||
                         line_between(v, value(min(at + ivec2(0, 1), last)))))
    code *= 0.25;
  color = vec4(code, 1.0);
}
)";

}  // namespace

DisplayPass::DisplayPass(const Context& context) : context_(&context) {
  glCreateVertexArrays(1, &nothing_);
}

DisplayPass::~DisplayPass() {
  glDeleteVertexArrays(1, &nothing_);
}

void DisplayPass::tone(const Texture& sum, int samples, const Exposure& exposure, const ToneMapper& mapper) {
  if (mapper_ != &mapper) {
    tone_ = std::make_unique<Program>("tone curve " + std::string(mapper.name), whole_target_vertex(),
                                      std::string(kVersion) + tone_glsl(mapper) + std::string(kTone));
    mapper_ = &mapper;
  }
  tone_->use();
  tone_->set("sum", 0);
  tone_->set("scale", exposure.scale / static_cast<float>(samples));
  tone_->set("maximum", exposure.params.maximum);
  tone_->set("adaptation", exposure.params.adaptation);
  tone_->set("drago_bias", exposure.params.drago_bias);
  draw(sum);
}

void DisplayPass::false_color(const Texture& sum, int samples, float scale, const FalseColor& colors) {
  colors.check();
  if (!false_color_)
    false_color_ =
        std::make_unique<Program>("false colours", whole_target_vertex(),
                                  std::string(kVersion) + false_color_glsl() + std::string(kFalseColor));
  std::vector<Rgb> ticks;
  if (colors.lines)
    for (const float tick : legend_ticks(colors)) ticks.emplace_back(tick);
  false_color_->use();
  false_color_->set("sum", 0);
  false_color_->set("scale", scale / static_cast<float>(samples));
  false_color_->set("low", colors.low);
  false_color_->set("high", colors.high);
  false_color_->set("decades", colors.decades ? 1 : 0);
  false_color_->set("tick_count", static_cast<int>(ticks.size()));
  if (!ticks.empty()) false_color_->set("ticks", ticks);
  draw(sum);
}

void DisplayPass::draw(const Texture& sum) {
  const int width = sum.params().width, height = sum.params().height;
  if (!target_ || target_->texture.params().width != width || target_->texture.params().height != height)
    target_.emplace(*context_, width, height);
  sum.bind(0);
  target_->framebuffer.use();
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  glBindVertexArray(nothing_);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  context_->check("tone mapping");
}

Image8 DisplayPass::read() const {
  const TextureParams& p = target_->texture.params();
  Image8 out{p.width, p.height, 3, {}};
  out.data.resize(3 * static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height));
  target_->framebuffer.read(GL_RGB, GL_UNSIGNED_BYTE, out.data.data());
  context_->check("reading the picture");
  return out;
}

}  // namespace sconce::gpu
