// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "import/gltf_model.h"

namespace sconce {

/// Decodes every view with EXT_meshopt_compression into a buffer of its own, appended to `buffers`, and makes
/// the view lie in that. Views whose stream lies in a missing buffer stay as they are.
/// @param missing  per buffer: absent; grows with `buffers`
/// @throws Error naming the view: bytes out of range, a damaged stream, a filter that does not fit
void decode_meshopt(nlohmann::json& root, std::vector<Bytes>& buffers, std::vector<bool>& missing,
                    const std::string& where);

/// A buffer that only readers without the extension would need.
bool is_meshopt_fallback(const nlohmann::json& buffer);

}  // namespace sconce
