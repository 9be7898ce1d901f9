// SPDX-License-Identifier: Apache-2.0
#include "relight/relight.h"

#include <chrono>
#include <limits>
#include <optional>

#include "core/sobol.h"

namespace sconce {

namespace {

constexpr uint32_t kNone = 0xffffffffu, kSeenStream = 0x7365656eu;

}  // namespace

Relighter::Relighter(const Package& package, const View& view, const Operator& op,
                     const FoldedBounces& bounces, const MovedLamps& lamps, float cull, const Operator* lobes)
    : package_(package), view_(view), op_(op), lamps_(lamps) {
  using Clock = std::chrono::steady_clock;
  const std::optional<Culling> culling = cull > 0 ? std::optional<Culling>(op.gather) : std::nullopt;
  const auto start = Clock::now();
  std::vector<Rgbx> light = light_cloud(op, lamps);
  const auto lit = Clock::now();
  indirect_.resize(op.gather.rows);
  if (culling)
    culled_ = bounces.indirect(light, indirect_, *culling, cull);
  else
    bounces.indirect(light, indirect_);
  if (lobes != nullptr) {
    std::vector<Rgb> seen(lobes->gather.rows);
    multiply(lobes->gather, light, seen);
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const Rgb& e = seen[i];
      mirrored_.push_back(kInvPi * unpack_albedo(lobes->receivers[i].albedo) *
                          Rgb(std::max(e.r, 0.0f), std::max(e.g, 0.0f), std::max(e.b, 0.0f)));
    }
    lobes_ = lobes->receivers;
  }
  seconds_.direct = std::chrono::duration<double>(lit - start).count();
  seconds_.indirect = std::chrono::duration<double>(Clock::now() - lit).count();
  if (op.kind == OperatorReceivers::pixels) {
    const auto rows_of = [&](std::span<const uint32_t> places) {
      std::vector<uint32_t> of(static_cast<std::size_t>(op.width) * static_cast<std::size_t>(op.height),
                               kNone);
      for (uint32_t i = 0; i < places.size(); ++i) of[places[i]] = i;
      return of;
    };
    receiver_of_ = rows_of(op.places);
    if (lobes != nullptr) lobe_of_ = rows_of(lobes->places);
  }
}

void Relighter::add_to(std::vector<Image>& pages) const {
  add_to_pages(package_, view_, op_, indirect_, pages);
}

std::optional<uint32_t> Relighter::nearest_row(std::span<const uint32_t> of,
                                               std::span<const OperatorPoint> points, const SurfacePoint& at,
                                               int x, int y) const {
  const float diagonal = view_.world().bounds.diagonal();
  float least = std::numeric_limits<float>::infinity();
  uint32_t nearest = kNone;
  for (int v = std::max(0, y - 1); v <= std::min(op_.height - 1, y + 1); ++v)
    for (int u = std::max(0, x - 1); u <= std::min(op_.width - 1, x + 1); ++u) {
      const uint32_t i =
          of[static_cast<std::size_t>(v) * static_cast<std::size_t>(op_.width) + static_cast<std::size_t>(u)];
      if (i == kNone) continue;
      const SurfacePoint p = point_of(points[i]);
      const Vec3 d = 20.0f * (p.position - at.position),
                 n = diagonal * (p.shading_normal - at.shading_normal);
      const float distance = glm::dot(d, d) + glm::dot(n, n);
      if (distance >= least) continue;
      least = distance;
      nearest = i;
    }
  return nearest == kNone ? std::nullopt : std::optional(nearest);
}

AddedLight Relighter::added() const {
  return [this](const SurfacePoint& at, int x, int y, uint32_t sample) {
    const auto pixel = mix32(static_cast<uint32_t>(x), static_cast<uint32_t>(y));
    Rgb light = lamps_.illuminance(at, mix32(kSeenStream, pixel), sample);
    if (op_.kind != OperatorReceivers::pixels) return light;
    if (const auto i = nearest_row(receiver_of_, op_.receivers, at, x, y)) light += indirect_[*i];
    return light;
  };
}

AddedLight Relighter::mirrored() const {
  if (lobe_of_.empty()) return {};
  return [this](const SurfacePoint& at, int x, int y, uint32_t) {
    const auto i = nearest_row(lobe_of_, lobes_, at, x, y);
    return i ? mirrored_[*i] : Rgb();
  };
}

}  // namespace sconce
