// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "import/gltf_model.h"

namespace sconce {

/// Is the primitive of a glTF JSON compressed?
bool is_draco(const nlohmann::json& primitive);

/// Checks every KHR_draco_mesh_compression primitive for what tinygltf trusts blindly: indices, byte ranges,
/// that the stream decodes, and that its attributes exist and have the accessors' types.
/// @param missing  buffers that are absent; primitives in them lose their attributes, so that the rest loads
/// @throws Error with the place
void check_draco(nlohmann::json& root, const std::vector<Bytes>& buffers, const std::vector<bool>& missing,
                 const std::string& where);

}  // namespace sconce
