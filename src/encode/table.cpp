// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "core/find_row.h"
#include "encode/rows.h"

namespace sconce {

std::span<const Encoding> encodings() {
  static const std::array kTable{kEncodingF32,    kEncodingF16,    kEncodingExp8, kEncodingRgbe8,
                                 kEncodingSrgbe8, kEncodingMulti8, kEncodingBc6h};
  return kTable;
}

const Encoding& find_encoding(std::string_view name) {
  return find_row(encodings(), name, "encoding");
}

}  // namespace sconce
