// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "photometry/photometry.h"

namespace sconce {

/// The polar diagram of data sheets as SVG: planes C0-C180 (solid) and C90-C270 (dashed), cd, nadir down.
std::string polar_svg(const Photometry& photometry, const std::string& title);

}  // namespace sconce
