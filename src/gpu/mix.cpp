// SPDX-License-Identifier: Apache-2.0
#include "gpu/mix.h"

#include "core/error.h"

namespace sconce::gpu {

namespace {

// Halves end at 65504; the sun has 100,000 lux.
constexpr float kHalfScale = 1.0f / 64;

const ShaderTier& with_floats(const ShaderTier& tier) {
  if (!tier.f16)
    throw Error("OpenGL", "the tier " + std::string(tier.name) + " has no float textures to mix to");
  return tier;
}

TextureParams pages_of(const EncodedLayers& layers, const ShaderTier& tier) {
  TextureParams params;
  params.format = tier.f32 ? GL_RGBA32F : GL_RGBA16F;
  params.width = layers.width();
  params.height = layers.height();
  params.layers = layers.pages() * static_cast<int>(layers.coefficients());
  params.filter = tier.filter ? GL_LINEAR : GL_NEAREST;
  return params;
}

AtlasMix::Form quicker_form(const Context& context, const EncodedLayers& layers, const ShaderTier& tier) {
  const bool computes =
      !context.capabilities().software &&
      split_layers(context, layers, tier, ShaderSpec::Form::compute).size() <= layers.coefficients();
  return computes ? AtlasMix::Form::compute : AtlasMix::Form::fragment;
}

}  // namespace

bool PixelMix::possible(const Context& context, const EncodedLayers& layers, const ShaderTier& tier) {
  return split_layers(context, layers, tier, ShaderSpec::Form::functions).size() == 1;
}

PixelMix::PixelMix(const Context& context, const EncodedLayers& layers, const ShaderTier& tier)
    : passes_(make_passes(context, layers, tier, ShaderSpec::Form::functions)),
      coefficients_(layers.coefficients()) {
  if (passes_.size() > 1)
    throw Error("OpenGL", "one shader cannot read all " + std::to_string(layers.textures.size()) + " layers");
}

std::string PixelMix::glsl() const {
  return passes_.front().text() + R"(
vec3 illuminance(vec2 uv, int page, vec3 offset) {
  return sconce_illuminance(uv, page)" +
         (coefficients_ > 1 ? ", offset" : "") + ");\n}\n";
}

void PixelMix::bind(const Program& program, int first_unit) const {
  passes_.front().bind(program, first_unit, weights_, 0);
}

AtlasMix::AtlasMix(const Context& context, const EncodedLayers& layers, const ShaderTier& tier, Form form)
    : context_(&context),
      tier_(&with_floats(tier)),
      form_(form),
      passes_(make_passes(context, layers, tier,
                          form == Form::compute ? ShaderSpec::Form::compute : ShaderSpec::Form::atlas)),
      page_count_(layers.pages()),
      pages_(context, pages_of(layers, tier), "lightmap"),
      scale_(tier.f32 ? 1.0f : kHalfScale) {
  if (form == Form::compute && passes_.size() > layers.coefficients())
    throw Error("OpenGL",
                "one compute shader cannot read all " + std::to_string(layers.textures.size()) + " layers");
  for (const LayerPass& pass : passes_)
    programs_.push_back(form == Form::compute
                            ? std::make_unique<Program>("mix", pass.text())
                            : std::make_unique<Program>("mix", whole_target_vertex(), pass.text()));
  glCreateVertexArrays(1, &nothing_);
  // A data-centre card was seen, now and then, to mix what had not yet arrived.
  glFinish();
}

AtlasMix::AtlasMix(const Context& context, const EncodedLayers& layers, const ShaderTier& tier)
    : AtlasMix(context, layers, tier, quicker_form(context, layers, tier)) {}

AtlasMix::~AtlasMix() {
  glDeleteVertexArrays(1, &nothing_);
}

void AtlasMix::mix(const std::vector<Rgb>& weights) const {
  std::vector<Rgb> scaled;
  for (const Rgb& w : weights) scaled.push_back(scale_ * w);
  for (int slice = 0; slice < pages_.params().layers; ++slice)
    form_ == Form::compute ? compute_slice(slice, scaled) : draw_slice(slice, scaled);
  context_->check("mixing");
}

void AtlasMix::draw_slice(int slice, const std::vector<Rgb>& weights) const {
  const Framebuffer target(pages_, slice);
  target.use();
  glDisable(GL_DEPTH_TEST);
  glBindVertexArray(nothing_);
  glBlendFunc(GL_ONE, GL_ONE);
  glBlendEquation(GL_FUNC_ADD);
  for (std::size_t i = 0; i < passes_.size(); ++i) {
    if (passes_[i].coefficient() != coefficient(slice)) continue;
    programs_[i]->use();
    programs_[i]->set("sconce_page", page(slice));
    passes_[i].bind(*programs_[i], 0, weights, page(slice));
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glEnable(GL_BLEND);
  }
  glDisable(GL_BLEND);
}

void AtlasMix::compute_slice(int slice, const std::vector<Rgb>& weights) const {
  constexpr int kGroup = 16;  // of the composed shader
  const Program& program = *programs_[coefficient(slice)];
  program.use();
  program.set("sconce_page", page(slice));
  program.set("sconce_mixed", 0);
  passes_[coefficient(slice)].bind(program, 0, weights, page(slice));
  const TextureParams& p = pages_.params();
  glBindImageTexture(0, pages_.handle(), 0, GL_FALSE, slice, GL_WRITE_ONLY, p.format);
  glDispatchCompute(static_cast<GLuint>((p.width + kGroup - 1) / kGroup),
                    static_cast<GLuint>((p.height + kGroup - 1) / kGroup), 1);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT);
}

std::vector<Image> AtlasMix::read() const {
  std::vector<Image> pages;
  for (int slice = 0; slice < pages_.params().layers; ++slice) {
    pages.push_back(Image::rgb(pages_.params().width, pages_.params().height));
    Framebuffer(pages_, slice).read(GL_RGB, GL_FLOAT, pages.back().data.data());
    for (float& v : pages.back().data) v /= scale_;
  }
  context_->check("reading the mix");
  return pages;
}

std::string AtlasMix::glsl() const {
  return lightmap_glsl(tier_->filter, page_count_, coefficient(pages_.params().layers));
}

void AtlasMix::bind(const Program& program, int first_unit) const {
  pages_.bind(first_unit);
  program.set("lightmap", first_unit);
  program.set("lightmap_scale", 1 / scale_);
}

}  // namespace sconce::gpu
