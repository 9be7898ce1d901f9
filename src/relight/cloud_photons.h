// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gather/photon_tree.h"
#include "relight/cloud_square.h"
#include "trace/tracer.h"
#include "transfer/haar.h"

namespace sconce {

/// All bounces at once, as system C's chapter finds them (9.6; methods.md 2.4): every slot of the cloud is a
/// small matt lamp that sends photons by its area; they keep its number wherever they land, and the nearest
/// ones around a place tell whose light comes there.
class CloudPhotons {
 public:
  /// @param photons  sent by all slots together
  CloudPhotons(const TracedScene& traced, const GatherCloud& cloud, const CloudSquare& square,
               std::size_t photons, uint32_t seed, const Progress& progress = {});

  /// Illuminance at a place per radiosity of each slot, after any number of reflections on the way; ascending
  /// by slot, colourless: the mean of three channels.
  /// @param nearest  photons that are looked at
  /// @return their colour, of mean 1: what slots of one grey light together throw there; white where none is
  Rgb row(const SurfacePoint& at, std::size_t nearest, std::vector<SparseEntry>& row) const;

  std::size_t landings() const { return landings_.size(); }

 private:
  struct Landing {
    Vec3 position;
    int8_t normal[3];
    uint32_t slot;
    Rgb throughput;  ///< of the reflections before it landed here
  };

  std::vector<Landing> landings_;
  std::unique_ptr<PhotonTree<Landing>> tree_;
  float area_ = 0;        ///< of the cloud per photon sent, m2
  float scene_area_ = 0;  ///< m2
};

}  // namespace sconce
