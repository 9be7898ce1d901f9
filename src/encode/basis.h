// SPDX-License-Identifier: Apache-2.0
// What a layer holds of the directions that its light comes from. Adding a basis is a row of basis.cpp.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace sconce {

/// The first coefficient of every basis is the illuminance E at the footprint's own shading normal n_s, so
/// who knows no other reads that one alone. All are linear in the light and add up over groups.
enum class Basis : uint8_t {
  flat,  ///< E
  /// E and the vector g = 1/2 integral of L_in(w) w dw (lux, world axes, signed, per colour channel): linear
  /// spherical harmonics convolved with the cosine lobe (Ramamoorthi and Hanrahan 2001), pinned to E at n_s.
  /// At a normal n the illuminance is E + g . (n - n_s), at least 0 once the groups are summed.
  sh1,
};

struct BasisRow {
  Basis basis;
  std::string_view name, doc;
  int coefficients;
};

/// flat, sh1; in this order.
std::span<const BasisRow> bases();
const BasisRow& basis_row(Basis basis);
/// @throws UsageError naming the choices
Basis find_basis(std::string_view name);

/// Layers per light group.
inline std::size_t coefficients(Basis basis) {
  return static_cast<std::size_t>(basis_row(basis).coefficients);
}
/// "" for the first, then ".x", ".y", ".z": what names of groups get in files.
std::string_view coefficient_suffix(std::size_t coefficient);

}  // namespace sconce
