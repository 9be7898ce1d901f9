// SPDX-License-Identifier: Apache-2.0
#include "gpu/near_lights.h"

#include <algorithm>
#include <cmath>

#include "encode/encoding.h"
#include "gpu/framebuffer.h"

namespace sconce::gpu {

namespace {

constexpr std::string_view kVertex =
#include "gpu/near_shadow_vertex.glsl.h"
    ;
constexpr std::string_view kGeometry =
#include "gpu/near_shadow_geometry.glsl.h"
    ;
constexpr std::string_view kFragment =
#include "gpu/shadow_fragment.glsl.h"
    ;
constexpr std::string_view kFilter =
#include "gpu/shadow_filter.glsl.h"
    ;
constexpr std::string_view kLight =
#include "gpu/near_light.glsl.h"
    ;
constexpr std::string_view kPoints =
#include "gpu/lamp_points.glsl.h"
    ;
constexpr std::string_view kArriving =
#include "gpu/near_arriving.glsl.h"
    ;
constexpr std::string_view kGloss =
#include "gpu/gloss.glsl.h"
    ;
constexpr std::string_view kSeen =
#include "gpu/near_seen.glsl.h"
    ;
constexpr std::string_view kPixels =
#include "gpu/near_pixels.glsl.h"
    ;
constexpr std::string_view kSrgbe =
#include "gpu/near_srgbe.glsl.h"
    ;
constexpr int kLayersAtOnce = 32;  // gpu/near_shadow_geometry.glsl
constexpr GLuint kTerms = 6;       // gpu/near_light.glsl
constexpr int kSumsUnit = SeenSurfaces::kUnits, kDepthsUnit = kSumsUnit + 1;
constexpr std::size_t kPointsOfGroup = 64;  // gpu/lamp_points.glsl
constexpr double kMargin = 3;               // texels around what is looked up, for the filter

std::string whole(std::initializer_list<std::string_view> parts) {
  std::string out = "#version 450 core\n";
  for (const std::string_view part : parts) out += part;
  return out;
}

std::string on_points() {
  return whole({octahedral_glsl(), kFilter, kLight, kArriving, kPoints});
}

std::string on_pixels(bool srgbe) {
  return whole({SeenSurfaces::glsl(), kFilter, kLight, kGloss, kSeen,
                srgbe ? find_encoding("srgbe8").glsl : std::string_view(), srgbe ? kSrgbe : kPixels});
}

/// Summed-area tables of E' in whole numbers, so that differences are exact: the largest sum of absolute
/// values takes 31 bits.
/// @param unit  lux m2 of one of them
std::vector<int32_t> sums_of(const NearLamp& lamp, int m, int n, double& unit) {
  const LightField& field = lamp.field();
  const auto width = static_cast<std::size_t>(field.width), height = static_cast<std::size_t>(field.height);
  std::vector<double> image;
  double all = 0;
  for (std::size_t t = 0; t < height; ++t)
    for (std::size_t s = 0; s < width; ++s) {
      const glm::dvec2 st = field.corner + field.pixel * (glm::dvec2(s, t) + 0.5);
      image.push_back(lamp.towards(m, n, st - field.center(m, n)));
      all += std::abs(image.back());
    }
  unit = all > 0 ? all / (0x7fffffff - static_cast<double>(image.size())) : 1;
  std::vector<int32_t> sums((width + 1) * (height + 1), 0);
  for (std::size_t t = 0; t < height; ++t) {
    int32_t row = 0;
    for (std::size_t s = 0; s < width; ++s) {
      row += static_cast<int32_t>(std::lround(image[t * width + s] / unit));
      sums[(t + 1) * (width + 1) + s + 1] = sums[t * (width + 1) + s + 1] + row;
    }
  }
  return sums;
}

}  // namespace

/// A light field on the device, for all lamps that have it.
struct NearLights::Field {
  Field(const Context& context, std::shared_ptr<const NearField> field, int side)
      : near(std::move(field)), grid(near->finest().field()) {
    for (std::size_t c = 0; c < near->channels(); ++c) channels.emplace_back(context, near->channel(c));
    // Light falls beyond M by half of what a filter covers of it.
    const glm::dvec2 size = grid.pixel * glm::dvec2(grid.width, grid.height) + grid.spacing,
                     step = size / std::max(1.0, side - 2 * kMargin);
    low = Vec2(grid.corner - 0.5 * grid.spacing - kMargin * step);
    texel = Vec2(step);
  }
  int count() const { return static_cast<int>(grid.terms()); }

  struct Channel {
    Channel(const Context& context, const NearLamp& lamp)
        : sums(context,
               {.format = GL_R32I,
                .width = lamp.field().width + 1,
                .height = lamp.field().height + 1,
                .layers = static_cast<int>(lamp.field().terms()),
                .filter = GL_NEAREST},
               "light field") {
      const LightField& grid = lamp.field();
      std::vector<glm::vec4> all;
      for (int n = 0; n < grid.rows; ++n)
        for (int m = 0; m < grid.columns; ++m) {
          double unit = 0;
          sums.upload(GL_RED_INTEGER, GL_INT, sums_of(lamp, m, n, unit).data(), static_cast<int>(all.size()));
          all.emplace_back(Vec2(grid.center(m, n)), static_cast<float>(unit), 0);
        }
      terms.emplace(context, std::span<const glm::vec4>(all), "terms of a light field");
    }
    Texture sums;
    std::optional<Buffer> terms;
  };
  std::shared_ptr<const NearField> near;
  const LightField& grid;
  std::vector<Channel> channels;  ///< one, or red, green and blue
  Vec2 low, texel;                ///< corner and texels of shadow maps on M, m
};

struct NearLights::Programs {
  explicit Programs(bool srgbe)
      : points("light field on points", on_points()),
        pixels("light field on pixels", on_pixels(srgbe)),
        shapes("shadow maps of a light field", kVertex, kGeometry, kFragment) {}
  Program points, pixels, shapes;
};

NearLights::NearLights(const Context& context, const Geometry& geometry, const Bounds& bounds,
                       const Lamps& lamps, std::span<const std::pair<std::size_t, Rgb>> chosen,
                       const NearLightParams& params)
    : context_(&context), geometry_(&geometry), params_(params), end_(1e-4f * bounds.diagonal()) {
  const auto add = [&](std::size_t number, const Rgb& weight, bool lights) {
    const auto* shape = std::get_if<NearFieldLamp>(&lamps.all()[number].shape);
    if (shape == nullptr) return;
    std::unique_ptr<Field>& field = fields_[shape->field.get()];
    if (field == nullptr) field = std::make_unique<Field>(context, shape->field, params.shadow_side);
    Lamp& lamp = lamps_.emplace_back();
    lamp.field = field.get(), lamp.position = shape->position, lamp.frame = shape->to_world;
    lamp.scale = shape->scale, lamp.group = lamps.all()[number].group;
    if (lights) lamp.color = weight * lamp.scale;
    if (lights && params.glints) lamp.shine = lamp.color;
    if (params.shadow_side > 0)
      lamp.depths.emplace(
          context,
          TextureParams{.format = GL_DEPTH_COMPONENT32F,
                        .width = params.shadow_side,
                        .height = params.shadow_side,
                        .layers = params.terms_per_pass > 0 ? std::min(params.terms_per_pass, field->count())
                                                            : field->count(),
                        .filter = GL_NEAREST},
          "shadow maps of a light field");
  };
  for (const auto& [number, weight] : chosen) add(number, weight, true);
  chosen_ = lamps_.size();
  for (std::size_t i = 0; params.glints && i < lamps.size(); ++i)
    if (std::none_of(chosen.begin(), chosen.end(), [&](const auto& c) { return c.first == i; }))
      add(i, Rgb(1), false);
  if (!lamps_.empty()) programs_ = std::make_unique<Programs>(params.srgbe);
  context.check("preparing light fields");
}

NearLights::~NearLights() = default;

void NearLights::move(std::size_t i, const Vec3& position, const Mat3& frame) {
  lamps_[i].position = position, lamps_[i].frame = frame, lamps_[i].drawn = false;
}

void NearLights::set_mix(const std::vector<Rgb>& weights) {
  for (std::size_t i = chosen_; i < lamps_.size(); ++i) {
    Lamp& lamp = lamps_[i];
    lamp.shine = lamp.scale * (lamp.group.valid() ? weights.at(lamp.group.value) : Rgb(1));
  }
}

void NearLights::use(const Program& program, const Lamp& lamp, std::size_t channel) const {
  const LightField& grid = lamp.field->grid;
  const auto of_channel = [&](const Rgb& all) {
    if (lamp.field->channels.size() == 1) return all;
    return Rgb(channel == 0 ? all.r : 0, channel == 1 ? all.g : 0, channel == 2 ? all.b : 0);
  };
  program.use();
  program.set("near_sums", kSumsUnit), program.set("near_depths", kDepthsUnit);
  lamp.field->channels[channel].sums.bind(kSumsUnit);
  if (lamp.depths) lamp.depths->bind(kDepthsUnit);
  lamp.field->channels[channel].terms->bind(kTerms);
  program.set("near_shadows", lamp.depths ? 1 : 0);
  program.set("near_position", lamp.position), program.set("near_frame", lamp.frame);
  program.set("near_color", of_channel(lamp.color)), program.set("near_shine", of_channel(lamp.shine));
  program.set("near_distance", static_cast<float>(grid.distance));
  program.set("near_filter", static_cast<float>(grid.spacing));
  program.set("near_pixel", static_cast<float>(grid.pixel)), program.set("near_corner", Vec2(grid.corner));
  program.set("near_low", lamp.field->low), program.set("near_texel", lamp.field->texel);
  program.set("near_end", end_);
}

void NearLights::draw_maps(const Lamp& lamp, int first, int count) {
  const Program& shapes = programs_->shapes;
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
  use(shapes, lamp, 0);
  shapes.set("size", static_cast<float>(params_.shadow_side));
  const Framebuffer target(Framebuffer::DepthOnly{}, *lamp.depths);
  target.use();
  target.clear();
  for (int layer = 0; layer < count; layer += kLayersAtOnce) {
    shapes.set("near_first", first + layer), shapes.set("near_layer", layer);
    shapes.set("near_count", std::min(kLayersAtOnce, count - layer));
    geometry_->draw_shapes(shapes);
    ++passes_.shadows;
  }
  glDisable(GL_DEPTH_TEST);
}

template <class F>
void NearLights::each_pass(Lamp& lamp, const Program& program, const F& sum) {
  const std::size_t channels = lamp.field->channels.size();
  const int all = lamp.field->count(), most = params_.terms_per_pass > 0 ? params_.terms_per_pass : all;
  for (int first = 0; first < all; first += most) {
    const int count = std::min(most, all - first);
    if (lamp.depths && !lamp.drawn) draw_maps(lamp, first, count);
    lamp.drawn = count == all;
    for (std::size_t c = 0; c < channels; ++c) {
      use(program, lamp, c);
      program.set("near_first", first), program.set("near_count", count);
      program.set("near_begin", first == 0 && c == 0 ? 1 : 0);
      program.set("near_last", first + count == all && c + 1 == channels ? 1 : 0);
      sum();
      ++passes_.lighting;
    }
  }
}

void NearLights::light_cloud(const Buffer& points, uint32_t slots, uint32_t points_per_slot,
                             const Buffer& exitance) {
  for (Lamp& lamp : std::span(lamps_).first(chosen_))
    each_pass(lamp, programs_->points, [&] {
      programs_->points.set("sconce_slots", slots), programs_->points.set("sconce_per_slot", points_per_slot);
      points.bind(0), exitance.bind(1);
      dispatch((slots + kPointsOfGroup - 1) / kPointsOfGroup);
      buffers_written();
    });
  context_->check("lighting the cloud by light fields");
}

void NearLights::add(const SeenSurfaces& seen, const Texture& picture) {
  std::optional<Texture> kept;
  if (params_.srgbe && !lamps_.empty()) {
    kept.emplace(
        *context_,
        TextureParams{.format = GL_RGBA8, .width = picture.params().width, .height = picture.params().height},
        "sums of a light field");
    glBindImageTexture(1, kept->handle(), 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA8);
  }
  for (Lamp& lamp : lamps_)
    if (!lamp.color.is_black() || !lamp.shine.is_black())
      each_pass(lamp, programs_->pixels, [&] { seen.shade(programs_->pixels, picture); });
  context_->check("lighting the picture by light fields");
}

}  // namespace sconce::gpu
