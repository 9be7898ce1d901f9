// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include "core/error.h"
#include "core/text.h"
#include "encode/rows.h"

namespace sconce {

std::span<const Encoding> encodings() {
  static const std::array kTable{kEncodingF32,    kEncodingF16,    kEncodingExp8, kEncodingRgbe8,
                                 kEncodingSrgbe8, kEncodingMulti8, kEncodingBc6h};
  return kTable;
}

const Encoding& find_encoding(std::string_view name) {
  std::vector<std::string> names;
  for (const Encoding& encoding : encodings()) {
    if (encoding.name == name) return encoding;
    names.emplace_back(encoding.name);
  }
  throw UsageError({}, "unknown encoding '" + std::string(name) + "'", join(names, ", "));
}

}  // namespace sconce
