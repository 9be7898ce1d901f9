// SPDX-License-Identifier: Apache-2.0
// Where light is asked for. Texels, vertices, pixels, gather samples, plane points and probes are all
// receivers; a solver sees nothing else.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/rgb.h"
#include "core/vec.h"

namespace sconce {

enum class ReceiverKind : uint8_t { texel, vertex, pixel, gather, plane, probe };

/// A point of a receiver's footprint.
struct SurfacePoint {
  Vec3 position;
  Vec3 shading_normal;    ///< interpolated NORMAL, unit
  Vec3 geometric_normal;  ///< face normal, unit; light below its horizon does not count
};

/// A triangle of a footprint. Normals are interpolated linearly over it, then normalised.
struct FootprintPiece {
  Vec3 p0, p1, p2;
  Vec3 n0, n1, n2;
  Vec3 geometric_normal;
  float cumulative = 1;  ///< area share of this and all earlier pieces, last = 1
};

/// The receiver's footprint: the mean over it is the value that a layer holds (contract.md, "A layer").
/// A point receiver has one piece with three equal corners.
struct Footprint {
  ReceiverKind kind = ReceiverKind::texel;
  uint32_t id = 0;  ///< names the receiver's random numbers; never changes with tiling, sharding or threads
  std::vector<FootprintPiece> pieces;
  float area = 0;  ///< m2, 0 for points

  static Footprint point(uint32_t id, ReceiverKind kind, const SurfacePoint& p);

  /// Uniform by area; u in [0,1)^2, the first coordinate also picks the piece.
  SurfacePoint sample(Vec2 u) const;
};

/// Receivers by number, whatever they are.
struct ReceiverSource {
  std::size_t count = 0;
  std::function<Footprint(std::size_t)> footprint;  ///< thread-safe
};

}  // namespace sconce
