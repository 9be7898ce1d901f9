// SPDX-License-Identifier: Apache-2.0
// Pictures that `render` and `relight` make, as files.
#pragma once

#include <string>

#include "image/image.h"
#include "tone/exposure.h"

namespace sconce::app {

/// kitchen.sconce -> kitchen.png beside it, for `ending` .png.
std::string default_output(const std::string& package, const std::string& ending);

/// OpenEXR, exposed. @throws Error
void write_linear(const std::string& output, Image picture, const Exposure& exposure);

/// PNG; `-` is standard output. @throws Error
void write_toned(const std::string& output, const Image8& toned);

}  // namespace sconce::app
