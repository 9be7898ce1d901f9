// SPDX-License-Identifier: Apache-2.0
// Which gather sample speaks for which cell, and for which point of cells that are in part out of its sight.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/progress.h"
#include "core/ranks.h"
#include "gather/cells.h"
#include "trace/tracer.h"

namespace sconce {

/// How far a sample's light is the cell's.
enum class Trust : uint8_t {
  guess,   ///< no sample speaks for the cell: this one is merely near
  middle,  ///< the cell's middle sees the sample along one continuous surface
  whole,   ///< so do its corners
};

/// A cell's gather sample.
struct Owner {
  uint32_t sample = 0;
  Trust trust = Trust::guess;
};

/// Where the samples stand.
class Samples {
 public:
  /// @param spacings  per sample: distance between samples thereabouts, m
  Samples(const Tracer& tracer, std::vector<SurfacePoint> points, std::vector<float> spacings);
  ~Samples();
  Samples(const Samples&) = delete;
  Samples& operator=(const Samples&) = delete;

  std::size_t size() const { return points_.size(); }
  const SurfacePoint& operator[](std::size_t i) const { return points_[i]; }
  float spacing(std::size_t i) const { return spacings_[i]; }

  /// Whether a sample may speak for a point: near in place and normal, close to each other's plane, nothing
  /// between them, or light would leak through doors and thin walls.
  bool fits(const SurfacePoint& at, std::size_t sample) const;
  /// The nearest sample that fits, of a few.
  std::optional<uint32_t> find(const SurfacePoint& at) const;
  /// The nearest in place and normal, of as many, whatever is between.
  uint32_t nearest(const SurfacePoint& at) const;

 private:
  struct Tree;
  const Tracer& tracer_;
  std::vector<SurfacePoint> points_;
  std::vector<float> spacings_;
  std::unique_ptr<Tree> tree_;
};

struct Ownership {
  std::unique_ptr<Samples> samples;
  std::vector<uint32_t> seeds;  ///< per sample: the cell in whose middle it stands
  std::vector<Owner> owners;    ///< per cell
};

/// How far a cell is a sample's that fits its middle.
Trust trust(const World& world, const Tracer& tracer, const SurfaceCells& cells, uint32_t cell,
            const SurfacePoint& sample);

/// Gives every cell the nearest sample that fits. Cells that find none become samples where enough light
/// falls on them, and otherwise take the nearest as a guess.
/// @param seeds     cells that are samples, distinct
/// @param spacings  per cell: distance between samples thereabouts, m
/// @param weights   per cell: its share of the samples; cells below an eighth of a sample never become one
Ownership assign_owners(const World& world, const Tracer& tracer, const SurfaceCells& cells,
                        std::vector<uint32_t> seeds, std::span<const float> spacings,
                        std::span<const float> weights, const Progress& progress, const Ranks& ranks);

}  // namespace sconce
