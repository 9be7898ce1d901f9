// SPDX-License-Identifier: Apache-2.0
#include "encode/basis.h"

#include <array>

#include "core/find_row.h"

namespace sconce {

std::span<const BasisRow> bases() {
  static constexpr std::array kTable{
      BasisRow{Basis::flat, "flat", "illuminance along the surface's normal", 1},
      BasisRow{Basis::sh1, "sh1", "illuminance and how it changes with the normal, for normal maps; signed",
               4},
  };
  return kTable;
}

const BasisRow& basis_row(Basis basis) {
  return bases()[static_cast<std::size_t>(basis)];
}

Basis find_basis(std::string_view name) {
  return find_row(bases(), name, "basis").basis;
}

std::string_view coefficient_suffix(std::size_t coefficient) {
  static constexpr std::array<std::string_view, 4> kSuffixes{"", ".x", ".y", ".z"};
  return kSuffixes.at(coefficient);
}

}  // namespace sconce
