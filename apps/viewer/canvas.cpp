// SPDX-License-Identifier: Apache-2.0
#include "viewer/canvas.h"

#include "gpu/tiers.h"

namespace sconce::viewer {

namespace {

bool same(const Scenery& a, const Scenery& b) {
  return a.camera.frame == b.camera.frame && a.camera.yfov == b.camera.yfov && a.width == b.width &&
         a.height == b.height && a.look == b.look;
}

/// The mixed light alone, however it is shown.
bool shows_light(LookKind look) {
  return look == LookKind::lux || look == LookKind::lightmap || look == LookKind::noise;
}

gpu::Look gpu_look(LookKind look) {
  if (shows_light(look)) return gpu::Look::illuminance;
  switch (look) {
    case LookKind::albedo:
      return gpu::Look::albedo;
    case LookKind::normals:
      return gpu::Look::normals;
    case LookKind::charts:
      return gpu::Look::charts;
    default:
      return gpu::Look::picture;
  }
}

std::unique_ptr<gpu::Texture> picture_texture(const gpu::Context& context, const Image& rgb,
                                              const char* name) {
  auto texture = std::make_unique<gpu::Texture>(
      context, gpu::TextureParams{.format = GL_RGB32F, .width = rgb.width, .height = rgb.height}, name);
  texture->upload(GL_RGB, GL_FLOAT, rgb.data.data());
  return texture;
}

}  // namespace

Canvas::Canvas(const gpu::Context& context, std::shared_ptr<const Opened> opened)
    : Screen(context),
      context_(&context),
      opened_(std::move(opened)),
      view_(context, opened_->rays.shown(), opened_->rays.sees_normal_maps()),
      mixer_(layers_of(opened_)),
      reference_display_(context) {
  for (std::size_t c = 1; c < opened_->layers.coefficients(); ++c) axes_.emplace_back(layers_of(opened_), c);
  const ShaderTier& tier = gpu::tier_of(context.capabilities());
  // Mixing by a processor that plays graphics device is slower than by the one that is a processor.
  if (!context.capabilities().software && tier.f16)
    atlas_ = std::make_unique<gpu::AtlasMix>(context, for_tier(opened_->layers, tier), tier);
}

void Canvas::update_mix(const MixSpec& mix, const Movers& movers, bool metered) {
  const uint64_t relit = movers.version();
  if (mixed_ && mix.weights == mix_.weights && relit == relit_ && (metered_ || !metered)) return;
  const Stopwatch watch;
  const bool moved = movers.any();
  on_device_ = atlas_ != nullptr && !moved;
  if (!on_device_ || metered) {
    std::vector<Image> relit_pages;
    if (moved) relit_pages = movers.pages(mixer_, mix);
    const std::vector<Image>& pages = moved ? relit_pages : mixer_.mix(mix);
    if (metered) metering_ = opened_->meter(mix, pages);
    fader_ms_ = watch.milliseconds();
    if (!on_device_) {
      const std::vector<Image> components = mixed_components(mix, movers);
      if (pages_ == nullptr)
        pages_ = std::make_unique<gpu::MixedPages>(*context_, pages, components);
      else
        pages_->set(pages, components);
    }
  }
  if (on_device_) atlas_->mix(mix.weights);
  mix_ = mix, mixed_ = true, metered_ = metered, relit_ = relit;
  samples_ = 0;
}

const gpu::LightSource& Canvas::light(LookKind look) {
  if (look == LookKind::noise) {
    if (noise_ == nullptr || noise_mix_.weights != mix_.weights) {
      noise_ = std::make_unique<gpu::MixedPages>(*context_, mixed_noise(*opened_, mix_));
      noise_mix_ = mix_;
    }
    return *noise_;
  }
  if (on_device_) return *atlas_;
  return *pages_;
}

bool Canvas::draw(const Session& session, const Scenery& scenery, const Movers& movers) {
  const bool metered = session.mood().automatic || find_tone_mapper(session.mood().tone).needs_maximum;
  update_mix(session.mix(), movers, metered);
  const Stopwatch watch;
  if (!same(scenery, drawn_)) samples_ = 0;
  const bool redisplay =
      samples_ < kSamples || !(session.mood() == shown_) || !(scenery.scale == drawn_.scale);
  if (samples_ == 0) at_rest_.reset(), ++version_;
  if (samples_ < kSamples) {
    const Manifest& m = opened_->package.manifest();
    view_.draw(scenery.camera, mix_.weights, light(scenery.look),
               {.width = scenery.width, .height = scenery.height, .samples = kSamples}, {},
               {.look = gpu_look(scenery.look),
                .page_size = Vec2(m.width, m.height),
                .first = samples_,
                .last = samples_ + 1});
    ++samples_;
  }
  drawn_ = scenery, shown_ = session.mood();
  if (redisplay) display(session, scenery);
  drawing_ms_ = watch.milliseconds();
  return samples_ < kSamples;
}

void Canvas::display(const Session& session, const Scenery& scenery) {
  const ToneMapper& curve = find_tone_mapper(session.mood().tone);
  const gpu::Texture& sum = at_rest_ ? *at_rest_ : view_.sum();
  const int samples = at_rest_ ? 1 : view_.samples();
  if (!row_of(scenery.look).unit.empty()) {
    display_.false_color(sum, samples, 1, scenery.scale);
  } else if (scenery.look == LookKind::picture || scenery.look == LookKind::reference) {
    display_.tone(sum, samples, session.exposure(metering_), curve);
  } else if (scenery.look == LookKind::lightmap) {
    Exposure exposure = session.exposure(metering_);
    exposure.scale *= kInvPi;
    display_.tone(view_.sum(), view_.samples(), exposure, curve);
  } else {
    display_.tone(view_.sum(), view_.samples(), Exposure{}, find_tone_mapper("linear"));
  }
}

void Canvas::set_at_rest(Image linear, const Session& session) {
  at_rest_ = picture_texture(*context_, linear, "picture at rest");
  at_rest_linear_ = std::move(linear);
  display(session, drawn_);
}

void Canvas::follow(const sconce::View& view) {
  view_.follow(view.shown());
  draw_anew();
}

std::vector<Image> Canvas::mixed_pages(const Movers& movers) {
  return movers.pages(mixer_, mix_);
}

std::vector<Image> Canvas::mixed_components(const MixSpec& mix, const Movers& movers) {
  if (axes_.empty()) return {};
  MixSpec baked = mix;
  for (const std::size_t group : movers.changed(mix.weights.size())) baked.weights[group] = Rgb(0);
  std::vector<Image> out(axes_.size() * static_cast<std::size_t>(opened_->package.manifest().pages));
  for (std::size_t axis = 0; axis < axes_.size(); ++axis) {
    const std::vector<Image>& pages = axes_[axis].mix(baked);
    for (std::size_t page = 0; page < pages.size(); ++page) out[axes_.size() * page + axis] = pages[page];
  }
  return out;
}

const GroupPages& Canvas::moved_pages(const Movers& movers) {
  if (!movers.any()) {
    moved_pages_.clear(), moved_mix_ = {};
  } else if (moved_version_ != movers.version() || moved_mix_.weights != mix_.weights) {
    moved_pages_.clear();
    Mixer mixer(layers_of(opened_));
    for (const std::size_t group : movers.changed(mix_.weights.size()))
      moved_pages_[group] = movers.pages(mixer, group, mix_.weights.size(), mix_.weights[group]);
    moved_version_ = movers.version(), moved_mix_ = mix_;
  }
  return moved_pages_;
}

void Canvas::set_reference(const Image& linear, const Session& session) {
  reference_sum_ = picture_texture(*context_, linear, "reference");
  reference_display_.tone(*reference_sum_, 1, session.exposure(metering_),
                          find_tone_mapper(session.mood().tone));
}

}  // namespace sconce::viewer
