// SPDX-License-Identifier: Apache-2.0
// What moved lamps add to a picture: direct light exactly, where it is seen, and indirect light by transfer.
#pragma once

#include "relight/moved_lamps.h"
#include "relight/receivers.h"
#include "transfer/folded_bounces.h"

namespace sconce {

class Relighter {
 public:
  /// Lights the cloud and sends its light to all receivers. All but the bounces must outlive it.
  /// @param cull   Culling::apply()'s share; 0 = nothing is left out
  /// @param lobes  find_lobes(); need not outlive it
  Relighter(const Package& package, const View& view, const Operator& op, const FoldedBounces& bounces,
            const MovedLamps& lamps, float cull = 0, const Operator* lobes = nullptr);

  /// E_i per receiver, lux.
  const std::vector<Rgb>& indirect() const { return indirect_; }
  /// Of texels: adds the indirect light to the pages of a lightmap, gaps filled.
  void add_to(std::vector<Image>& pages) const;
  /// What pixels see besides the lightmap: direct light, and indirect light where pixels are the receivers:
  /// of the nearest in place and normal among 3 x 3 (the chapter, 9.8.1).
  AddedLight added() const;
  /// Of pixels: what they mirror of that light, cd/m2, of the nearest likewise. Empty without lobes.
  AddedLight mirrored() const;

  struct Seconds {
    double direct = 0, indirect = 0;  ///< on the cloud; from there to the receivers
  };
  const Seconds& seconds() const { return seconds_; }
  const Culling::Report& culled() const { return culled_; }

 private:
  /// @param of  per pixel: its row, or none
  /// @return the nearest row; none where no pixel around has one
  std::optional<uint32_t> nearest_row(std::span<const uint32_t> of, std::span<const OperatorPoint> points,
                                      const SurfacePoint& at, int x, int y) const;

  const Package& package_;
  const View& view_;
  const Operator& op_;
  const MovedLamps& lamps_;
  std::vector<Rgb> indirect_;
  std::vector<uint32_t> receiver_of_;  ///< of pixels: per pixel
  std::span<const OperatorPoint> lobes_;
  std::vector<Rgb> mirrored_;      ///< per lobe, cd/m2
  std::vector<uint32_t> lobe_of_;  ///< per pixel
  Seconds seconds_;
  Culling::Report culled_;
};

}  // namespace sconce
