// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "photometry/light_field.h"

namespace sconce {

/// One OpenEXR of 32-bit floats, a channel per term: docs/luminaires.md. @throws Error
void write_light_field(const std::filesystem::path& path, const LightField& field);

/// @throws NotMyFormat (no EXR, or not marked as a light field), Error: what is missing or does not fit
LightField read_light_field(const std::filesystem::path& path);

}  // namespace sconce
