// SPDX-License-Identifier: Apache-2.0
#include "detect/vertex_buffer.h"

#include <cstring>

#include "core/error.h"

namespace sconce {

std::vector<uint32_t> read_indices(const BufferBytes& bytes, std::size_t size) {
  std::vector<uint32_t> indices(bytes.size() / size, 0);
  for (std::size_t i = 0; i < indices.size(); ++i) std::memcpy(&indices[i], &bytes[i * size], size);
  return indices;
}

std::vector<Vec3> read_vectors(const BufferBytes& bytes, std::size_t stride, std::size_t offset) {
  std::vector<Vec3> values(bytes.size() / stride);
  for (std::size_t v = 0; v < values.size(); ++v)
    std::memcpy(&values[v], &bytes[v * stride + offset], sizeof(Vec3));
  return values;
}

BufferBytes vertex_per_index(const BufferBytes& bytes, std::size_t stride,
                             std::span<const uint32_t> indices) {
  const std::size_t vertices = bytes.size() / stride;
  BufferBytes out(indices.size() * stride);
  for (std::size_t i = 0; i < indices.size(); ++i) {
    if (indices[i] >= vertices)
      throw Error("index " + std::to_string(indices[i]), "is beyond the last of the vertices",
                  "below " + std::to_string(vertices));
    std::memcpy(&out[i * stride], &bytes[indices[i] * stride], stride);
  }
  return out;
}

}  // namespace sconce
