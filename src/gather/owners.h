// SPDX-License-Identifier: Apache-2.0
// Which gather sample speaks for which cell.
#pragma once

#include <vector>

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

struct Ownership {
  std::vector<Owner> owners;    ///< per cell
  std::vector<uint32_t> seeds;  ///< per sample: the cell it stands in
};

/// Gives every cell the nearest sample that it sees on the same surface: near in place and normal, close to
/// each other's plane, nothing between them (or light would leak through doors and thin walls). Cells that
/// find none become samples where enough light falls on them, and otherwise take the nearest as a guess.
/// @param seeds     cells that are samples, distinct
/// @param spacings  per cell: distance between samples thereabouts, m
/// @param weights   per cell: its share of the samples; cells below an eighth of a sample never become one
Ownership assign_owners(const World& world, const Tracer& tracer, const SurfaceCells& cells,
                        std::vector<uint32_t> seeds, std::span<const float> spacings,
                        std::span<const float> weights);

}  // namespace sconce
