// SPDX-License-Identifier: Apache-2.0
#include "web/packed.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <vector>

namespace sconce::web {
namespace {

/// As a browser does it (web/sconce-three/src/fetch.ts).
std::vector<std::byte> unpack(const std::string& packed, std::size_t bytes, std::size_t element) {
  std::vector<unsigned char> sorted(bytes);
  uLongf size = bytes;
  EXPECT_EQ(uncompress(sorted.data(), &size, reinterpret_cast<const Bytef*>(packed.data()), packed.size()),
            Z_OK);
  EXPECT_EQ(size, bytes);
  std::vector<std::byte> out(bytes);
  std::size_t from = 0;
  for (std::size_t k = 0; k < element; ++k) {
    unsigned char byte = 0;
    for (std::size_t i = k; i < bytes; i += element) {
      byte = static_cast<unsigned char>(byte + sorted[from++]);
      out[i] = std::byte{byte};
    }
  }
  return out;
}

TEST(Packed, ComesBack) {
  for (const std::size_t element : {1u, 2u, 6u, 12u}) {
    std::vector<std::byte> data;
    for (std::size_t i = 0; i < 50 * element; ++i) data.push_back(static_cast<std::byte>(i * i * 7 % 251));
    EXPECT_EQ(unpack(pack(data, element), data.size(), element), data) << element;
  }
  EXPECT_EQ(unpack(pack({}, 4), 0, 4).size(), 0u);
}

// Neighbours that rise evenly are one byte over and over.
TEST(Packed, SmoothIsSmall) {
  std::vector<std::byte> ramp;
  for (std::size_t i = 0; i < 60000; ++i) ramp.push_back(static_cast<std::byte>(i % 3 == 2 ? 9 : i / 3));
  EXPECT_LT(pack(ramp, 3).size(), 300u);
}

}  // namespace
}  // namespace sconce::web
