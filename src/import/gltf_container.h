// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace sconce {

/// A .gltf or .glb file taken apart, nothing interpreted yet.
struct GltfContainer {
  std::string json;
  std::optional<std::string> binary;  ///< the GLB's BIN chunk
};

/// By content: "glTF" magic, or a JSON object; a file called .gltf or .glb that is neither is damaged.
/// @throws NotMyFormat, Error (file and byte offset)
GltfContainer open_gltf_container(const std::filesystem::path& path);

}  // namespace sconce
