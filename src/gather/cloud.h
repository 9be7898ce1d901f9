// SPDX-License-Identifier: Apache-2.0
// The gather cloud: samples spread over all surfaces that reflect, each speaking for the cells around it.
// Source: system C, "Direct-to-Indirect Transfer" (gather samples); cells instead of nearest-neighbour
// look-ups are ours.
#pragma once

#include "core/progress.h"
#include "core/receiver.h"
#include "gather/owners.h"
#include "light/lamp.h"

namespace sconce {

struct CloudParams {
  std::size_t samples = 65536;  ///< about
  uint32_t seed = 1;
};

class GatherCloud {
 public:
  /// Spreads samples by where gather rays from `receivers` (may be none) and light from the lamps land.
  /// @param ranks  share the work; each gets all of it
  GatherCloud(const Scene& scene, const World& world, const Tracer& tracer, const Lamps& lamps,
              const ReceiverSource& receivers, const CloudParams& params, const Progress& progress = {},
              const Ranks& ranks = {});

  /// After triangles moved, in the World that it was made for: samples and cells move along. Where boxes are,
  /// other samples may speak for cells; there are no new ones.
  /// @param tracer  made anew, at the old one's place
  /// @param boxes   around what moved, before and after; made larger here, so that nothing changed that is
  /// outside
  /// @return per sample: 1 where it may have changed
  std::vector<uint8_t> follow(const Tracer& tracer, std::span<Bounds> boxes);

  std::size_t size() const { return areas_.size(); }
  std::size_t cells() const { return cells_.size(); }
  bool reflects(const Hit& hit) const { return cells_.reflects(side_index(hit.triangle, hit.back)); }
  /// Cell of a hit; only for sides that reflect. O(1), as is its owner.
  uint32_t cell(const Hit& hit) const {
    return cells_.at(side_index(hit.triangle, hit.back), hit.barycentric);
  }
  const Owner& owner(uint32_t cell) const { return ownership_.owners[cell]; }
  /// Sample that speaks for a point of a cell, if any. O(1) where the cell's trust is whole.
  std::optional<uint32_t> speaker(const SurfacePoint& at, uint32_t cell) const {
    const Owner& owner = ownership_.owners[cell];
    if (owner.trust == Trust::whole || ownership_.samples->fits(at, owner.sample)) return owner.sample;
    return ownership_.samples->find(at);
  }
  /// A cell as a receiver.
  Footprint cell_footprint(uint32_t cell) const;
  /// Mean diffuse reflectance (metals: base colour, as in bounces) of a cell.
  const Rgb& cell_albedo(uint32_t cell) const { return cell_albedos_[cell]; }

  /// m2, of the cells that a sample speaks for
  float area(std::size_t i) const { return areas_[i]; }
  /// Mean diffuse reflectance over these cells.
  const Rgb& albedo(std::size_t i) const { return albedos_[i]; }
  /// A sample as a receiver: its cells.
  Footprint footprint(std::size_t i) const;
  /// The cells of its footprint.
  std::span<const uint32_t> owned(std::size_t i) const {
    return {owned_.data() + first_[i], owned_.data() + first_[i + 1]};
  }
  /// A point of it that the sample speaks for, where light may be gathered in its name.
  SurfacePoint point(std::size_t i, const Footprint& footprint, Vec2 u) const {
    const SurfacePoint p = footprint.sample(u);
    return least_[i] == Trust::whole || ownership_.samples->fits(p, i) ? p : (*ownership_.samples)[i];
  }
  /// Distance between samples around sample i, m.
  float spacing(std::size_t i) const { return std::sqrt(areas_[i]); }
  /// Share of the surface, by area, whose cells have this trust in their sample.
  double share(Trust trust) const { return shares_[static_cast<std::size_t>(trust)]; }

 private:
  void collect();

  const World* world_;
  SurfaceCells cells_;
  Ownership ownership_;
  std::vector<Trust> least_;             ///< of a sample's cells that count
  std::vector<uint32_t> first_, owned_;  ///< CSR: cells that each sample speaks for
  std::vector<float> areas_;
  std::vector<Rgb> albedos_, cell_albedos_;
  std::array<double, 3> shares_{};
};

}  // namespace sconce
