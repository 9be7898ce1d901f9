// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "gather/row_rays.h"
#include "picture/gloss.h"
#include "relight/cloud_square.h"
#include "relight/receivers.h"
#include "transfer/sparse_rows.h"

namespace sconce {

/// Where the rays of a receiver's row of F start.
struct ReceiverRays {
  Footprint footprint;
  uint32_t stream;

  ReceiverRays(const RelightReceivers& receivers, uint32_t receiver, uint32_t seed)
      : footprint(receivers.source.footprint(receiver)),
        stream(mix32(mix32(seed, 0x66696e61u), receivers.places[receiver])) {}
  SurfacePoint operator()(uint32_t r) const { return footprint.sample(sobol_pair(r, 0, stream)); }
};

/// Where the rays of a glossy pixel's row go: over its lobe, each as it counts.
struct LobeRays {
  Glossy seen;
  uint32_t stream;

  LobeRays(Glossy glossy, uint32_t place, uint32_t seed)
      : seen(std::move(glossy)), stream(mix32(mix32(seed, 0x6c6f6265u), place)) {}
  Gloss lobe(uint32_t r) const { return gloss(seen.surface, seen.to_eye, seen.at, sobol_pair(r, 0, stream)); }
  Ray operator()(uint32_t r) const {
    const Vec3 direction = lobe(r).direction;
    return {offset_origin(seen.at.position, seen.at.geometric_normal, direction), direction};
  }
  /// Mean share of what comes along the lobe that goes on to the eye.
  Rgb albedo(uint32_t rays) const {
    Rgb sum;
    for (uint32_t r = 0; r < rays; ++r) sum += lobe(r).mirrored;
    return sum / static_cast<float>(rays);
  }
};

/// Hits of one receiver's rays as a sparse row.
class RowMaker {
 public:
  /// @param transmission  per Scene material, or empty
  RowMaker(const World& world, const Tracer& tracer, const GatherCloud& cloud, const CloudSquare& square,
           std::span<const float> transmission)
      : world_(world), tracer_(tracer), cloud_(cloud), square_(square), transmission_(transmission) {}

  void start() { met_.clear(), wandered_ = false; }
  /// Whether a ray of the row left its line, where no sample spoke for its end.
  bool wandered() const { return wandered_; }
  /// Sends ray r of the row, and through what lets it through.
  void shoot(const SurfacePoint& from, uint32_t r, uint32_t stream) {
    follow(row_ray(from, r, 0, stream), r, stream);
  }
  void follow(std::optional<Ray> ray, uint32_t r, uint32_t stream) {
    constexpr uint32_t kMostPanes = 8, kPanePair = 32, kTintPair = 48;  // pairs that no step of a ray uses
    for (uint32_t pane = 0; ray && pane <= kMostPanes; ++pane) {
      const Passage met = follow_row_panes(tracer_, *ray, r, 0, stream ^ pane);
      const Hit& hit = met.hit;
      const auto end = follow_row_hit(world_, tracer_, cloud_, met, r, stream,
                                      [&](const SurfacePoint&, uint32_t, uint32_t step, const Rgb&) {
                                        wandered_ = wandered_ || step > 0;
                                      });
      wandered_ = wandered_ || (!end && hit && cloud_.reflects(hit));
      // Rows are without colour: what is tinted counts by its mean.
      if (end && (end->tint == Rgb(1) ||
                  sobol_pair(r, kTintPair + pane, stream).x < (end->tint.r + end->tint.g + end->tint.b) / 3))
        met_.push_back(end->sample);
      if (!hit || transmission_.empty() ||
          !(sobol_pair(r, kPanePair + pane, stream).x < transmission_[world_.materials[hit.triangle].value]))
        return;
      const SurfacePoint at = surface_point(world_, hit);
      ray->origin = offset_origin(at.position, at.geometric_normal, ray->direction);
    }
  }
  void finish(uint32_t rays, std::vector<SparseEntry>& row) {
    std::sort(met_.begin(), met_.end());
    row.clear();
    for (std::size_t k = 0; k < met_.size();) {
      std::size_t end = k;
      while (end < met_.size() && met_[end] == met_[k]) ++end;
      const std::span<const uint32_t> slots = square_.of(met_[k]);
      const float weight =
          static_cast<float>(end - k) / (static_cast<float>(rays) * static_cast<float>(slots.size()));
      for (const uint32_t slot : slots) row.push_back({slot, weight});
      k = end;
    }
    std::sort(row.begin(), row.end(),
              [](const SparseEntry& a, const SparseEntry& b) { return a.index < b.index; });
  }

 private:
  const World& world_;
  const Tracer& tracer_;
  const GatherCloud& cloud_;
  const CloudSquare& square_;
  std::span<const float> transmission_;
  std::vector<uint32_t> met_;
  bool wandered_ = false;
};

}  // namespace sconce
