// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "photometry/light_field.h"

namespace sconce {

/// How a file keeps the values: 32-bit floats; halves (1/2048 of each value); or sRGBE, the paper's signed
/// shared exponent in four bytes for three values, zero exact (1/127 of the largest of the three). The three
/// are a pixel's colours, or three terms that follow each other where the light field is grey.
enum class FieldCoding : uint8_t { full, half, srgbe };

/// "float", "half", "srgbe"
const char* name_of(FieldCoding coding);
std::optional<FieldCoding> coding_named(std::string_view name);

/// One OpenEXR: docs/luminaires.md. @throws Error
void write_light_field(const std::filesystem::path& path, const LightField& field,
                       FieldCoding coding = FieldCoding::full);

/// @throws NotMyFormat (no EXR, or not marked as a light field), Error: what is missing or does not fit
LightField read_light_field(const std::filesystem::path& path);

}  // namespace sconce
