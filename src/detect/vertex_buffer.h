// SPDX-License-Identifier: Apache-2.0
// Vertices and indices as graphics APIs keep them, in bytes: what it takes to read a renderer's geometry, and
// to give every corner of a face a vertex of its own.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/vec.h"

namespace sconce {

using BufferBytes = std::vector<uint8_t>;

/// @param size  of an index, bytes: 2 or 4, the little end first
std::vector<uint32_t> read_indices(const BufferBytes& bytes, std::size_t size);

/// Three floats of each vertex. @param stride, offset  bytes from vertex to vertex, and in one
std::vector<Vec3> read_vectors(const BufferBytes& bytes, std::size_t stride, std::size_t offset);

/// A vertex for each index. @throws Error where one is beyond the last vertex
BufferBytes vertex_per_index(const BufferBytes& bytes, std::size_t stride, std::span<const uint32_t> indices);

}  // namespace sconce
