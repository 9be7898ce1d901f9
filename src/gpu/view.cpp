// SPDX-License-Identifier: Apache-2.0
#include "gpu/view.h"

#include "core/error.h"
#include "core/sobol.h"
#include "gpu/display_pass.h"

namespace sconce::gpu {

namespace {

constexpr std::string_view kSurfaceVertex =
#include "gpu/surface_vertex.glsl.h"
    ;
constexpr std::string_view kSurface =
#include "gpu/surface.glsl.h"
    ;
constexpr std::string_view kSky =
#include "gpu/sky.glsl.h"
    ;
constexpr std::string_view kVersion = "#version 450 core\n";
constexpr std::string_view kAdd = R"(#version 450 core
uniform sampler2D pass;
out vec4 color;
void main() {
  color = texelFetch(pass, ivec2(gl_FragCoord.xy), 0);
}
)";

}  // namespace

/// One pass and the sum of all.
struct View::Targets {
  Targets(const Context& context, int width, int height)
      : color(context, {.format = GL_RGBA32F, .width = width, .height = height}, "picture"),
        depth(context,
              {.format = GL_DEPTH_COMPONENT32F, .width = width, .height = height, .filter = GL_NEAREST},
              "picture"),
        sum(context, {.format = GL_RGBA32F, .width = width, .height = height}, "picture"),
        pass(color, 0, &depth),
        total(sum, 0) {}
  int width() const { return color.params().width; }
  int height() const { return color.params().height; }

  Texture color, depth, sum;
  Framebuffer pass, total;
};

/// The same pass, with what it shows.
struct View::Surfaces {
  Surfaces(const Context& context, const Targets& targets, bool normal_maps)
      : surfaces(context, params(targets, GL_RGBA32UI), "picture"),
        materials(context, params(targets, GL_RG32UI), "picture") {
    std::vector<const Texture*> more{&surfaces, &materials};
    if (normal_maps) more.push_back(&mapped.emplace(context, params(targets, GL_R32UI), "picture"));
    pass.emplace(targets.color, 0, &targets.depth, more);
  }
  static TextureParams params(const Targets& targets, GLenum format) {
    return {.format = format, .width = targets.width(), .height = targets.height(), .filter = GL_NEAREST};
  }
  void keep(const Context& context, const Targets& targets, const Lens& through) {
    if (!kept) kept.emplace(context, params(targets, GL_RGBA32F), "picture");
    lens = through;
    copy(targets.color, *kept);
  }
  static void copy(const Texture& from, const Texture& to) {
    glCopyImageSubData(from.handle(), GL_TEXTURE_2D, 0, 0, 0, 0, to.handle(), GL_TEXTURE_2D, 0, 0, 0, 0,
                       from.params().width, from.params().height, 1);
  }

  Texture surfaces, materials;
  std::optional<Texture> mapped;
  std::optional<Framebuffer> pass;
  bool directional = false;     ///< SeenSurfaces, of the last pass
  std::optional<Texture> kept;  ///< the picture without added light
  std::optional<Lens> lens;     ///< that this was seen through
};

View::View(const Context& context, const ShownScene& shown, bool normal_maps)
    : context_(&context),
      shown_(&shown),
      geometry_(context, shown, normal_maps),
      sky_("sky", whole_target_vertex(), kSky),
      add_("sum of passes", whole_target_vertex(), kAdd) {
  glCreateVertexArrays(1, &nothing_);
  for (const Light& light : shown.scene.lights) {
    skies_.emplace_back();
    const auto* sky = std::get_if<SkyLight>(&light.shape);
    if (sky == nullptr) continue;
    const bool constant = sky->image.data.empty();
    const float one[] = {1, 1, 1};
    skies_.back().emplace(context,
                          TextureParams{.format = GL_RGB32F,
                                        .width = constant ? 1 : sky->image.width,
                                        .height = constant ? 1 : sky->image.height,
                                        .filter = GL_NEAREST},
                          "sky '" + light.name + "'");
    skies_.back()->upload(GL_RGB, GL_FLOAT, constant ? one : sky->image.data.data());
  }
  context.check("uploading the skies");
}

View::~View() {
  glDeleteVertexArrays(1, &nothing_);
}

void View::draw_sky(const Lens& lens, const std::vector<Rgb>& weights, Vec2 shift) const {
  glDisable(GL_DEPTH_TEST);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE);
  glBlendEquationSeparate(GL_FUNC_ADD, GL_MAX);
  glBindVertexArray(nothing_);
  sky_.use();
  sky_.set("plane", lens.plane());
  sky_.set("shift", shift);
  sky_.set("image", 0);
  for (std::size_t i = 0; i < skies_.size(); ++i) {
    if (!skies_[i]) continue;
    const Light& light = shown_->scene.lights[i];
    skies_[i]->bind(0);
    sky_.set("to_local", glm::transpose(Mat3(light.frame)));
    sky_.set("scale", light.intensity);
    sky_.set("weight", light.group ? weights.at(light.group.value) : Rgb(1));
    glDrawArrays(GL_TRIANGLES, 0, 3);
  }
  glDisable(GL_BLEND);
}

const Program& View::surface_for(const LightSource& light) {
  const std::string head = std::string(kVersion) + "#define SEEN_SURFACES\n" + std::string(octahedral_glsl());
  std::string text = head + light.glsl() + std::string(kSurface);
  if (!surface_ || text != surface_text_) {
    surface_ = std::make_unique<Program>("surface", head + std::string(kSurfaceVertex), text);
    surface_text_ = std::move(text);
  }
  return *surface_;
}

void View::draw(const Camera& camera, const std::vector<Rgb>& weights, const LightSource& light,
                const PictureParams& params, const Progress& progress, const DrawOptions& options) {
  params.check();
  const Lens lens(camera, params);
  if (!targets_ || targets_->width() != params.width || targets_->height() != params.height)
    surfaces_.reset(), targets_ = std::make_unique<Targets>(*context_, params.width, params.height);
  const std::span<AddedLight* const> added = options.added;
  if ((!added.empty() || options.keep) && surfaces_ == nullptr)
    surfaces_ = std::make_unique<Surfaces>(*context_, *targets_, geometry_.normal_maps());
  if (surfaces_ != nullptr) surfaces_->lens.reset(), surfaces_->directional = light.directional();
  if (options.keep && params.samples > 1)
    throw UsageError("a picture that is kept", std::to_string(params.samples) + " samples", "one");
  samples_ = options.last < 0 ? params.samples : std::min(options.last, params.samples);
  const Program& surface = surface_for(light);
  const Bounds& bounds = shown_->world.bounds;
  surface.set("eye", lens.eye());
  surface.set("plane", lens.plane());
  surface.set("to_plane", Mat3(glm::inverse(glm::dmat3(lens.plane()))));
  surface.set("size", Vec2(params.width, params.height));
  // Depth is a float that falls from 1 to 0, so its steps are the same fraction of any distance.
  surface.set("near", 1e-5f * glm::length(bounds.hi - bounds.lo));
  surface.set("look", static_cast<int>(options.look));
  surface.set("page_size", options.page_size);
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glDepthFunc(GL_GREATER);
  // Rows run downwards, which turns windings round.
  glFrontFace(glm::determinant(lens.plane()) > 0 ? GL_CW : GL_CCW);

  summed_ = params.samples > 1;
  if (summed_ && options.first == 0) targets_->total.clear();
  for (int s = options.first; s < samples_; ++s) {
    progress.check();
    progress.at("render", static_cast<uint64_t>(s), static_cast<uint64_t>(params.samples));
    const Vec2 shift =
        params.samples == 1 ? Vec2(0) : Vec2(0.5f) - Sampler(params.seed, 0, static_cast<uint32_t>(s)).next();
    targets_->pass.use();
    targets_->pass.clear();
    if (options.look == Look::picture) draw_sky(lens, weights, shift);
    if (!added.empty() || options.keep) surfaces_->pass->use();
    glEnable(GL_DEPTH_TEST);
    surface.use();
    surface.set("shift", shift);
    surface.set("screen", 0.618034f * static_cast<float>(s));
    light.bind(surface, Geometry::kUnits);  // added light has used its units
    geometry_.draw(surface, weights);
    glDisable(GL_DEPTH_TEST);
    if (options.keep) surfaces_->keep(*context_, *targets_, lens);
    add(added, lens, shift);
    if (summed_) add_pass();
    context_->check("drawing the picture");
  }
}

void View::add(std::span<AddedLight* const> added, const Lens& lens, Vec2 shift) const {
  for (AddedLight* more : added)
    more->add({targets_->depth, surfaces_->surfaces, surfaces_->materials,
               surfaces_->mapped ? &*surfaces_->mapped : nullptr, surfaces_->directional, lens, shift},
              targets_->color);
}

void View::relight(std::span<AddedLight* const> added) {
  if (surfaces_ == nullptr || !surfaces_->lens)
    throw UsageError("View::relight", "nothing", "a picture that was kept");
  Surfaces::copy(*surfaces_->kept, targets_->color);
  add(added, *surfaces_->lens, Vec2(0));
  context_->check("lighting the picture anew");
}

void View::add_pass() const {
  targets_->total.use();
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE);
  glBlendEquation(GL_FUNC_ADD);
  glBindVertexArray(nothing_);
  add_.use();
  add_.set("pass", 0);
  targets_->color.bind(0);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDisable(GL_BLEND);
}

std::vector<float> View::sums() const {
  std::vector<float> rgba(4 * static_cast<std::size_t>(targets_->width()) *
                          static_cast<std::size_t>(targets_->height()));
  (summed_ ? targets_->total : targets_->pass).read(GL_RGBA, GL_FLOAT, rgba.data());
  context_->check("reading the picture");
  for (float& v : rgba) v /= static_cast<float>(samples_);
  return rgba;
}

Image View::linear() const {
  const std::vector<float> rgba = sums();
  Image out = Image::rgb(targets_->width(), targets_->height());
  for (std::size_t i = 0; i < out.pixels(); ++i) std::copy_n(&rgba[4 * i], 3, &out.data[3 * i]);
  return out;
}

Image View::coverage() const {
  const std::vector<float> rgba = sums();
  Image out(targets_->width(), targets_->height(), {"coverage"});
  for (std::size_t i = 0; i < out.pixels(); ++i) out.data[i] = rgba[4 * i + 3];
  return out;
}

Image8 View::toned(const Exposure& exposure, const ToneMapper& mapper) const {
  DisplayPass display(*context_);
  display.tone(sum(), samples_, exposure, mapper);
  return display.read();
}

const Texture& View::sum() const {
  return summed_ ? targets_->sum : targets_->color;
}

}  // namespace sconce::gpu
