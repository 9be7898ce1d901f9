// SPDX-License-Identifier: Apache-2.0
// The nearest of many particles on the surface through a place (Jensen 2001, with tests for the surface).
#pragma once

#include <algorithm>
#include <nanoflann.hpp>
#include <utility>
#include <vector>

#include "core/vec.h"

namespace sconce {

/// Squared distance and index of particles, in no order.
using NearPhotons = std::vector<std::pair<float, uint32_t>>;

/// @tparam Photon  has `position` and `normal`: of the face on the side it came from, int8_t x 127
template <class Photon>
class PhotonTree {
 public:
  /// @param photons  must outlive it, and stay
  explicit PhotonTree(const std::vector<Photon>& photons) : points_{photons}, index_(3, points_, {16}) {}

  struct Place {
    Vec3 position, normal;
    std::size_t count = 64;
    float reach = 0;  ///< no photon is further away, m
  };
  /// Those that `accept`, whose normals agree with the place's and that lie near its plane. Of `count` the
  /// furthest only says how large the disk is: counted in, it would make the density too large by count /
  /// (count - 1).
  /// @param accept  of a photon
  /// @param out     reused from call to call
  /// @return radius of the disk that holds them, m
  template <class Accept>
  float nearest(const Place& place, const Accept& accept, NearPhotons& out) const {
    Found<Accept> found(points_.photons, place, accept, out);
    if (!points_.photons.empty()) index_.findNeighbors(found, &place.position.x, {});
    if (!found.full()) return place.reach;
    const float radius = std::sqrt(out.front().first);
    std::pop_heap(out.begin(), out.end());
    out.pop_back();
    return radius;
  }

 private:
  static constexpr float kAgree = 0.7f;  // least cosine between the normals
  static constexpr float kSlab = 0.1f;   // largest distance from the place's plane, in reaches

  /// What nanoflann sees.
  struct Points {
    const std::vector<Photon>& photons;

    std::size_t kdtree_get_point_count() const { return photons.size(); }
    float kdtree_get_pt(std::size_t i, std::size_t axis) const {
      return photons[i].position[static_cast<int>(axis)];
    }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
      return false;
    }
  };

  /// A heap whose top is the furthest; a result set of nanoflann. Ties go to the lower index.
  template <class Accept>
  class Found {
   public:
    using DistanceType = float;

    Found(const std::vector<Photon>& photons, const Place& place, const Accept& accept, NearPhotons& heap)
        : photons_(photons),
          place_(place),
          accept_(accept),
          limit_(place.reach * place.reach),
          slab_(kSlab * place.reach),
          heap_(heap) {
      heap_.clear();
    }
    bool full() const { return heap_.size() == place_.count; }
    float worstDist() const { return full() ? heap_.front().first : limit_; }
    bool addPoint(float distance2, uint32_t index) {
      const Photon& p = photons_[index];
      if (!accept_(p)) return true;
      if (glm::dot(Vec3(p.normal[0], p.normal[1], p.normal[2]), place_.normal) < 127 * kAgree) return true;
      if (std::abs(glm::dot(p.position - place_.position, place_.normal)) > slab_) return true;
      const std::pair<float, uint32_t> entry(distance2, index);
      if (full()) {
        if (!(entry < heap_.front())) return true;
        std::pop_heap(heap_.begin(), heap_.end());
        heap_.back() = entry;
      } else {
        heap_.push_back(entry);
      }
      std::push_heap(heap_.begin(), heap_.end());
      return true;
    }

   private:
    const std::vector<Photon>& photons_;
    const Place& place_;
    const Accept& accept_;
    float limit_, slab_;
    NearPhotons& heap_;
  };

  using Index =
      nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Points>, Points, 3, uint32_t>;
  Points points_;
  Index index_;
};

}  // namespace sconce
