// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "import/gltf_source.h"

namespace sconce {

/// The accessor's elements as floats, interleaved; integers as they are, or normalised where the accessor
/// says so. All component types, strides, sparse overlays; an accessor without a view is zeros under its
/// overlay.
/// @param components  1 to 4: what the use allows; an accessor of another type is an error
/// @param place       "meshes[0].primitives[1].POSITION", for errors
/// @throws Error when an index or a byte range is outside of what it points into
std::vector<float> read_floats(const GltfSource& source, int accessor, int components,
                               const std::string& place);

/// Unsigned scalars: vertex indices. @throws Error as above
std::vector<uint32_t> read_indices(const GltfSource& source, int accessor, const std::string& place);

/// Bytes of a component of glTF's componentType; 0 for what is none.
int component_bytes(int component_type);

/// Does all that the accessor needs lie in buffers that are there?
bool has_accessor(const GltfSource& source, int accessor, const std::string& place);

}  // namespace sconce
