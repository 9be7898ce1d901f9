// SPDX-License-Identifier: Apache-2.0
#include "measure/field.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/error.h"

namespace sconce {

namespace {

constexpr double kMostGigabytes = 2;
constexpr double kMargin = 12;    // filters beside the opening, at most
constexpr double kSpacings = 25;  // between the planes where nothing else is asked for

/// Where rays leave, as far as they go within an angle from nadir.
struct Extent {
  Vec2 low{1e30f}, high{-1e30f};  ///< on the sampling plane, m
  float bottom = 1e30f;           ///< z of the sampling plane
  bool colored = false;           ///< some of them
  float saturation = 1;           ///< that their colours are to have: less where Rec. 709 has not that of all
};

class FieldRays {
 public:
  FieldRays(const RaySource& rays, double tangent) : rays_(rays), tangent_(static_cast<float>(tangent)) {}

  Extent extent() const {
    Extent out;
    each([&](const SourceRay& ray) { out.bottom = std::min(out.bottom, ray.position.z); });
    glm::dvec3 sum(0);  // lm of each channel
    double all = 0;
    each([&](const SourceRay& ray) {
      const SourceRay r = lowered(ray, out.bottom);
      if (!within(r)) return;
      const Vec2 uv = Vec2(r.position) - Vec2(r.direction) * (r.position.z / r.direction.z);
      out.low = glm::min(out.low, uv), out.high = glm::max(out.high, uv);
      out.colored |= r.color != Rgb(1);
      const auto lumens = static_cast<double>(r.flux);
      sum += lumens * glm::dvec3(r.color.r, r.color.g, r.color.b), all += lumens;
    });
    if (const double least = all > 0 ? std::min({sum.x, sum.y, sum.z}) / all : 0; least < 0)
      out.saturation = static_cast<float>(1 / (1 - least));
    return out;
  }

  void project(LightFieldBuilder& builder, const Extent& extent, float scale) const {
    std::vector<SourceRay> block;
    rays_([&](std::span<const SourceRay> rays) {
      block.clear();
      for (const SourceRay& ray : rays) {
        SourceRay r = lowered(ray, extent.bottom);
        r.flux *= scale;
        r.color = Rgb(1) + extent.saturation * (r.color - Rgb(1));
        if (!within(r)) r.direction = Vec3(0, 0, 1);  // counts as lost
        block.push_back(r);
      }
      builder.add(block);
    });
  }

  double flux() const {
    double sum = 0;
    each([&](const SourceRay& ray) { sum += static_cast<double>(ray.flux); });
    return sum;
  }

 private:
  template <class F>
  void each(const F& f) const {
    rays_([&](std::span<const SourceRay> rays) {
      for (const SourceRay& ray : rays) f(ray);
    });
  }
  static SourceRay lowered(SourceRay ray, float bottom) {
    ray.position.z -= bottom;
    return ray;
  }
  bool within(const SourceRay& ray) const {
    return ray.direction.z < 0 && glm::length(Vec2(ray.direction)) <= tangent_ * -ray.direction.z;
  }

  const RaySource& rays_;
  float tangent_;
};

}  // namespace

MeasuredField measure_field(const RaySource& source, const FieldParams& params, const std::string& where) {
  const double distance = params.distance > 0 ? params.distance : kSpacings * params.spacing;
  const double tangent = std::tan(params.angle * std::numbers::pi / 180);
  const FieldRays rays(source, tangent);
  const Extent extent = rays.extent();
  if (extent.low.x > extent.high.x) throw Error(where, "sends no ray within the angle from nadir");
  const Vec2 size = extent.high - extent.low;
  const glm::dvec2 filters = glm::dvec2(size) / params.spacing + kMargin;
  const double count = filters.x * filters.y, pixels = static_cast<double>(params.pixels) * params.pixels,
               gigabytes = (extent.colored ? 40e-9 : 12e-9) * count * pixels;
  if (gigabytes > kMostGigabytes)
    throw UsageError(
        "--spacing",
        fmt::format("makes some {:.0f} filters of {} x {} pixels{}, {:.1f} GB", count, params.pixels,
                    params.pixels, extent.colored ? " in colours" : "", gigabytes),
        "at most 2 GB; a wider spacing, a smaller --angle or fewer --pixels");
  LightField empty = make_light_field(
      params.basis, extent.low, extent.high, params.spacing, distance,
      0.5 * static_cast<double>(std::max(size.x, size.y)) + distance * tangent, params.pixels);
  MeasuredField out;
  out.plane = static_cast<double>(extent.bottom);
  if (params.lumens > 0) out.scale = params.lumens / rays.flux();
  LightFieldBuilder builder(std::move(empty), extent.colored);
  rays.project(builder, extent, static_cast<float>(out.scale));
  out.kept = builder.kept(), out.lost = builder.lost();
  out.field = std::move(builder).finish();
  return out;
}

}  // namespace sconce
