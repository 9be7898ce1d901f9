// SPDX-License-Identifier: Apache-2.0
// The two-dimensional non-standard Haar transform of a square, orthonormal. Squares are stored along the
// Z-order curve: four neighbours in memory are a 2 x 2 block p q / r s, so that every level of the transform
// reads and writes whole runs. One convention throughout (methods.md 2.5):
//   average (p + q + r + s) / 2,  d_x (p - q + r - s) / 2,  d_y (p + q - r - s) / 2,  d_xy (p - q - r + s) /
//   2
// and coefficients lie where the usual pyramid has them: d_x at (x + h, y), d_y at (x, y + h), d_xy at
// (x + h, y + h), h the half side of that level; (0, 0) is the mean times the side.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace sconce {

/// Place of (x, y) on the Z-order curve: bits of x and y in turn, x first.
constexpr uint32_t morton(uint32_t x, uint32_t y) {
  const auto spread = [](uint32_t v) {
    v = (v | v << 8) & 0x00ff00ffu;
    v = (v | v << 4) & 0x0f0f0f0fu;
    v = (v | v << 2) & 0x33333333u;
    return (v | v << 1) & 0x55555555u;
  };
  return spread(x) | spread(y) << 1;
}

constexpr bool is_power_of_four(std::size_t n) {
  return std::has_single_bit(n) && std::countr_zero(n) % 2 == 0;
}

/// How many entries of a square of n a coefficient's wavelet covers: n for the mean and the coarsest details.
constexpr uint32_t haar_support(uint32_t coefficient, uint32_t n) {
  const int level = coefficient == 0 ? 0 : (std::bit_width(coefficient) - 1) / 2;
  return n >> (2 * level);
}

/// RGB and one unused channel, so that a vector unit loads it whole.
using Rgbx = std::array<float, 4>;
/// One value of each of sixteen squares.
using Sixteen = std::array<float, 16>;

/// In place; both directions keep the sum of squares. @pre size a power of four, no more than 65,536
void haar_forward(std::span<float> square);
void haar_inverse(std::span<float> square);
void haar_forward(std::span<Rgbx> square);
void haar_forward(std::span<Sixteen> square);
void haar_inverse(std::span<Rgbx> square);

/// An entry of a sparse square, or of its transform.
struct SparseEntry {
  uint32_t index;
  float value;
};

/// Transforms a square of which few entries are not zero, from the finest level up; the square is never made.
/// @param entries  ascending by index, distinct; used as scratch
/// @param out      the transform's entries that are not zero: cleared, then details from fine to coarse, the
/// mean last
void haar_forward(std::vector<SparseEntry>& entries, uint32_t n, std::vector<SparseEntry>& out);

}  // namespace sconce
