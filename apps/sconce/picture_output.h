// SPDX-License-Identifier: Apache-2.0
// Pictures that `render` and `relight` make, as files.
#pragma once

#include <string>

#include "image/image.h"
#include "tone/exposure.h"

namespace sconce::app {

/// kitchen.sconce -> kitchen.png beside it, for `ending` .png.
std::string default_output(const std::string& package, const std::string& ending);

/// `rec709` or `acescg`, of a linear picture. @return whether it is the latter
/// @throws UsageError, also where the output is not linear
bool is_acescg(const std::string& colorspace, bool linear);

/// OpenEXR, exposed. @param light  so many of the first channels; the others are no light and stay
/// @throws Error
void write_linear(const std::string& output, Image picture, const Exposure& exposure, bool acescg = false,
                  std::size_t light = static_cast<std::size_t>(-1));

/// PNG; `-` is standard output. @throws Error
void write_toned(const std::string& output, const Image8& toned);

}  // namespace sconce::app
