// SPDX-License-Identifier: Apache-2.0
// What the 128 bits of a BC6H block mean (Khronos Data Format Specification 1.3, section 21): the fourteen
// modes, and where each keeps its fields.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace sconce {

/// The ten modes with two subsets of the texels, then the four with one.
struct Bc6hMode {
  int id, id_bits;
  int subsets, bits;               ///< of an endpoint
  std::array<int, 3> offset_bits;  ///< per channel, of all endpoints but the first, which they are relative
                                   ///< to; 0: they are not
  std::string_view layout;  ///< of the endpoints' bits: "rw9:0" is red of the first, bit 0 first; w x y z

  int index_bits() const { return subsets == 1 ? 4 : 3; }
};
std::span<const Bc6hMode> bc6h_modes();

struct Bc6hFields {
  const Bc6hMode* mode = nullptr;
  std::array<std::array<int, 3>, 4> ends{};  ///< two per subset, R G B, in the mode's bits, not relative
  int shape = 0;                             ///< which texels are of the second subset
  std::array<int, 16> index{};

  std::size_t subset(std::size_t texel) const { return mode->subsets == 1 ? 0 : second(shape, texel); }
  /// Of 32 shapes.
  static std::size_t second(int shape, std::size_t texel);
  /// The texel of a subset whose index has one bit less: the highest is 0.
  std::size_t anchor(std::size_t subset) const;
};
inline constexpr int kBc6hShapes = 32;

/// Do the endpoints differ by what the mode can tell?
bool fits(const Bc6hFields& fields);
/// @pre fits(fields), and anchors' indices have their highest bit 0
std::array<uint8_t, 16> pack_bc6h(const Bc6hFields& fields);
/// Without a mode where its bits are reserved.
Bc6hFields unpack_bc6h(std::span<const uint8_t, 16> block);

}  // namespace sconce
