// SPDX-License-Identifier: Apache-2.0
// The one place that configures tinygltf: pictures are ours to decode, Draco is on.
#pragma once

#ifndef TINYGLTF_ENABLE_DRACO
#define TINYGLTF_ENABLE_DRACO
#endif
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE

#include <tiny_gltf.h>

#include <string>
#include <vector>

namespace sconce {

using Bytes = std::vector<unsigned char>;

/// JSON to a tinygltf model. Buffer i of the JSON must be called `buffer:<i>` and hold exactly `buffers[i]`;
/// what tinygltf does not check by itself (Draco indices) has been checked before.
/// @throws Error
tinygltf::Model parse_gltf_model(const std::string& json, const std::vector<Bytes>& buffers,
                                 const std::string& where);

}  // namespace sconce
