// SPDX-License-Identifier: Apache-2.0
// Where the lamps' light lands, as particles in a kd-tree.
#pragma once

#include <memory>
#include <vector>

#include "gather/photon_tree.h"
#include "solve/solver.h"

namespace sconce {

/// Light that landed on a surface, before it is reflected.
struct Photon {
  Vec3 position;
  int8_t normal[3];     ///< of the face on the side it came from, x 127
  uint8_t reflections;  ///< before it landed here, at most 255
  Rgb flux;             ///< lm per channel; black in groups that are not wanted
  Id<LightGroup> group;
};

/// Photons of all groups in one tree. Every lamp emits the same number, whatever its strength and group: so a
/// dim lamp is as clean as a bright one, and places and radii depend on neither (contract.md, "Which lamp is
/// sampled"). About 44 bytes per landing.
class PhotonMap {
 public:
  /// @param landings  how often a photon may land; -1 = until Russian roulette ends it
  /// @param photons   emitted by all lamps together, shared out evenly
  PhotonMap(const SolveContext& context, int landings, std::size_t photons, uint32_t seed,
            const Progress& progress);
  PhotonMap(const PhotonMap&) = delete;
  PhotonMap& operator=(const PhotonMap&) = delete;

  std::size_t size() const { return photons_.size(); }

  /// The nearest photons on the surface through (position, normal): those whose normals agree and that lie
  /// near its plane. None further away than twice the radius they would have were all spread evenly.
  struct Query {
    Vec3 position, normal;
    std::size_t count = 64;
    uint32_t least_reflections = 0, most_reflections = ~0u;
  };
  /// E = sum of flux x scale over `nearest`, lux.
  struct Density {
    float radius = 0;  ///< m
    float scale = 0;   ///< 1 / m2; 0 where there are none
    float offset =
        0;  ///< distance of their centroid from the query, in radii: large at edges of surfaces and shadows
    bool sparse = false;  ///< fewer than a quarter of the asked for lie in reach
    NearPhotons nearest;
  };
  /// @param out  reused from call to call
  void density(const Query& query, Density& out) const;

  const Photon& operator[](std::size_t i) const { return photons_[i]; }

 private:
  std::vector<Photon> photons_;
  std::unique_ptr<PhotonTree<Photon>> tree_;
  double area_ = 0;  ///< of the scene per photon, m2
};

}  // namespace sconce
