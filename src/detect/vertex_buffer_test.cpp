// SPDX-License-Identifier: Apache-2.0
// A square of four vertices, each a position behind a 16-bit tag.
#include "detect/vertex_buffer.h"

#include <gtest/gtest.h>

#include <cstring>

#include "core/error.h"

namespace sconce {
namespace {

constexpr std::size_t kOffset = 2, kStride = kOffset + sizeof(Vec3) + 2;
const std::vector<Vec3> kSquare{{0, 0, 1}, {1, 0, 2}, {1, 1, 3}, {0, 1, 4}};

BufferBytes square() {
  BufferBytes bytes(kSquare.size() * kStride, 0xee);
  for (std::size_t v = 0; v < kSquare.size(); ++v)
    std::memcpy(&bytes[v * kStride + kOffset], &kSquare[v], sizeof(Vec3));
  return bytes;
}

TEST(VertexBuffer, IndicesOfEitherSize) {
  EXPECT_EQ(read_indices({1, 0, 0, 2}, 2), (std::vector<uint32_t>{1, 0x200}));
  EXPECT_EQ(read_indices({1, 0, 0, 2}, 4), (std::vector<uint32_t>{0x02000001}));
}

TEST(VertexBuffer, AVertexForEachIndex) {
  EXPECT_EQ(read_vectors(square(), kStride, kOffset), kSquare);
  const std::vector<uint32_t> indices{0, 1, 2, 0, 2, 3};
  const BufferBytes bytes = vertex_per_index(square(), kStride, indices);
  EXPECT_EQ(bytes.size(), 6 * kStride);
  EXPECT_EQ(bytes.back(), 0xee);
  const std::vector<Vec3> positions = read_vectors(bytes, kStride, kOffset);
  for (std::size_t i = 0; i < indices.size(); ++i) EXPECT_EQ(positions[i], kSquare[indices[i]]) << i;
}

TEST(VertexBuffer, AnIndexBeyondTheLastVertex) {
  try {
    vertex_per_index(square(), kStride, std::vector<uint32_t>{0, 4, 1});
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("index 4"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace sconce
