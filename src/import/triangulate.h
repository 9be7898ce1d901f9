// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/vec.h"

namespace sconce {

/// Triangles of a polygon that is about flat, wound as it is, as indices into its corners: n - 2 for n of
/// them. Concave ones by cutting off ears (Meisters, 1975); those that cross themselves, and concave ones of
/// more than 256 corners, as if they were convex.
std::vector<std::array<uint32_t, 3>> triangulate(std::span<const Vec3> corners);

}  // namespace sconce
