// SPDX-License-Identifier: Apache-2.0
// KTX 2.0 containers (Khronos, registry.khronos.org/KTX) of what layers need: 2-D, one level, 8-bit channels
// or BC6H blocks, zlib-compressed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace sconce {

/// VkFormat numbers.
enum class KtxFormat : uint32_t { r8 = 9, rg8 = 16, rgb8 = 23, rgba8 = 37, bc6h_ufloat = 131 };

struct Ktx2 {
  KtxFormat format = KtxFormat::rgba8;
  int width = 0, height = 0;
  int layers = 1;                           ///< of the array; 1 = no array
  std::map<std::string, std::string> text;  ///< key/value data
  std::vector<std::byte> data;              ///< layers one after the other, row 0 first, rows without padding

  /// What `data` must have. 0 for an unknown format.
  std::size_t bytes() const;
};

/// @throws NotMyFormat (no KTX2), Error (damaged, or of a kind named above as left out)
Ktx2 read_ktx2(const std::filesystem::path& path);
/// Written beside, then renamed. @throws Error
void write_ktx2(const std::filesystem::path& path, const Ktx2& texture);

}  // namespace sconce
