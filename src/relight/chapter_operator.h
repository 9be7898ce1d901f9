// SPDX-License-Identifier: Apache-2.0
// The operator as system C's chapter makes it, to compare ours with ("Interactive Cinematic Relighting with
// Global Illumination", GPU Gems 3, chapter 9): F from form factors between points, all bounces by photons,
// rows of few wavelet coefficients. What differs from the chapter: ADR 40.
#pragma once

#include "relight/precompute.h"

namespace sconce {

/// Form factors of small patches as seen from a point (methods.md 2.4): cos cos A V / (pi max(r2, A / pi)),
/// clamped because points come close to each other in corners.
class PointFactors {
 public:
  /// @param areas  m2, per slot; a slot is its first lit point
  PointFactors(const Tracer& tracer, const Operator& op, std::vector<float> areas);
  /// Those that are not 0, ascending by slot.
  void row(const SurfacePoint& at, std::vector<SparseEntry>& row) const;

 private:
  const Tracer& tracer_;
  std::vector<float> areas_;
  std::vector<Vec3> positions_, normals_, starts_;
};

/// As make_operator(), of params.method chapter.
Operator make_chapter_operator(const TracedScene& traced, const RelightReceivers& receivers,
                               const TransferParams& params, const std::string& scene,
                               const TransferWork& work);

}  // namespace sconce
