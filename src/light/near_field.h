// SPDX-License-Identifier: Apache-2.0
// Lamps measured from near (Granier, Goesele, Heidrich, Seidel 2003): light fields with what sampling them
// needs.
#pragma once

#include "light/lamp.h"
#include "photometry/light_field.h"

namespace sconce {

/// A light field and coarser ones of it, down to a single term. Luminaire's frame throughout.
class NearField {
 public:
  explicit NearField(const LightField& field);

  /// Light from a point of the sampling plane on a surface at x that faces it, lux, over the probability of
  /// the point. Eq. 14: the point is the centre of a filter, picked by what it sends to x. Where the bound of
  /// that is above the tolerance: any point, by eq. 5.
  struct Sample {
    glm::dvec2 at{0};  ///< on the sampling plane, m
    Rgb lux;           ///< may be negative; 0: nothing arrives
  };
  Sample sample(const Vec3& x, Vec2 u, double tolerance) const;

  /// A particle from the sampling plane through the measurement plane.
  EmittedLight emit(Vec2 where, Vec2 whither) const;

  const Rgb& flux() const { return flux_; }  ///< lm, of each channel
  Vec3 center() const { return center_; }
  float radius() const { return radius_; }  ///< of what the filters reach

  /// The lamp for a place so far away: the coarsest whose filters are small seen from there.
  const NearLamp& finest() const { return levels_.front().channels.front(); }
  const NearLamp& level(const Vec3& x) const { return levels_[level_index(x)].channels.front(); }

  /// One where the light field is grey, three where it has colours; channel(0) is finest().
  std::size_t channels() const { return levels_.front().channels.size(); }
  const NearLamp& channel(std::size_t i) const { return levels_.front().channels[i]; }

 private:
  struct Level {
    std::vector<NearLamp> channels;
    AliasTable by_flux;  ///< terms by the sum of the channels' |flux|
  };
  std::size_t level_index(const Vec3& x) const;

  std::vector<Level> levels_;  ///< finest first
  AliasTable pixels_;          ///< of the measurement plane, by the terms' |E|, all channels together
  Rgb flux_{0.0f};             ///< lm
  double absolute_ = 0;        ///< lm; of |E|, all channels together
  Vec3 center_{0};
  float radius_ = 0;
};

Lamp make_near_field(const Light& light, std::shared_ptr<const NearField> field, float exact_below);
bool sample(const NearFieldLamp& lamp, const Vec3& x, Vec2 u, LightSample& out);
EmittedLight emit(const NearFieldLamp& lamp, Vec2 where, Vec2 whither);

}  // namespace sconce
