// SPDX-License-Identifier: Apache-2.0
// What of a package is looked at.
#pragma once

#include <span>
#include <string_view>

#include "tone/false_color.h"

namespace sconce {

enum class LookKind : uint8_t {
  picture,
  lux,
  luminance,
  lightmap,
  noise,
  albedo,
  normals,
  charts,
  reference
};

struct LookRow {
  LookKind kind;
  std::string_view name, label, doc;
  std::string_view unit;     ///< of the legend; "" = no false colours
  bool of_pictures = false;  ///< another renderer's picture can be looked at so
};
/// In the order of LookKind.
std::span<const LookRow> look_rows();
/// @throws UsageError naming the choices
const LookRow& find_look(std::string_view name);
inline const LookRow& row_of(LookKind kind) {
  return look_rows()[static_cast<std::size_t>(kind)];
}

/// A scale from 0 (or four decades below) to the next round number.
/// @param bright  what some values are above: nearer to lamps
FalseColor fitting_scale(double bright, bool decades);

}  // namespace sconce
