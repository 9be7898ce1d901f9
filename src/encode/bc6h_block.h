// SPDX-License-Identifier: Apache-2.0
// One 4 x 4 block of BC6H, unsigned (Khronos Data Format Specification 1.3, section 21): all its modes.
// Colours are on one line or two between endpoints, in the integer space of half floats, which is nearly
// logarithmic.
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace sconce {

/// Bits of 16 non-negative, finite halves in rows of 4, R, G, B each.
using HalfBlock = std::array<std::array<uint16_t, 3>, 16>;

/// Least squares in that space, refined, in whichever mode comes nearest.
std::array<uint8_t, 16> encode_bc6h_block(const HalfBlock& texels);

/// Blocks of reserved modes decode to 0.
HalfBlock decode_bc6h_block(std::span<const uint8_t, 16> block);

}  // namespace sconce
