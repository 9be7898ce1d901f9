// SPDX-License-Identifier: Apache-2.0
// The gather cloud: samples spread over all surfaces that reflect, each speaking for the cells around it.
// Source: system C, "Direct-to-Indirect Transfer" (gather samples); cells instead of nearest-neighbour
// look-ups are ours.
#pragma once

#include "gather/owners.h"
#include "receive/atlas.h"

namespace sconce {

struct CloudParams {
  std::size_t samples = 65536;  ///< about
  uint32_t seed = 1;
};

class GatherCloud {
 public:
  /// Spreads samples by where gather rays from `receivers` land, or by area where there are none.
  GatherCloud(const Scene& scene, const World& world, const Tracer& tracer, const TexelReceivers* receivers,
              const CloudParams& params, const Progress& progress = {});

  std::size_t size() const { return areas_.size(); }
  /// Sample that speaks for a hit; only for sides that reflect. O(1).
  Owner owner(const Hit& hit) const {
    return ownership_.owners[cells_.at(side_index(hit.triangle, hit.back), hit.barycentric)];
  }
  bool reflects(const Hit& hit) const { return cells_.reflects(side_index(hit.triangle, hit.back)); }
  /// m2; they add up to the area of all sides that reflect
  float area(std::size_t i) const { return areas_[i]; }
  /// Mean diffuse reflectance over the sample's cells (metals: base colour, as in bounces).
  const Rgb& albedo(std::size_t i) const { return albedos_[i]; }
  /// A sample as a receiver: its cells.
  Footprint footprint(std::size_t i) const;
  /// Distance between samples around sample i, m.
  float spacing(std::size_t i) const { return std::sqrt(areas_[i]); }
  /// Share of the surface, by area, whose cells are sure of their sample.
  double sure_share() const { return sure_share_; }

 private:
  const World* world_;
  SurfaceCells cells_;
  Ownership ownership_;
  std::vector<uint32_t> first_, owned_;  ///< CSR: cells of each sample
  std::vector<float> areas_;
  std::vector<Rgb> albedos_;
  double sure_share_ = 0;
};

}  // namespace sconce
