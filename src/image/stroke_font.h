// SPDX-License-Identifier: Apache-2.0
// Letters as lines, for diagrams: smooth at any size.
#pragma once

#include <string_view>
#include <vector>

#include "core/vec.h"

namespace sconce {

/// Lines of a text that begins at (0, 0) on its base line; y runs down. UTF-8; accents of Latin letters are
/// left out, signs that it does not have are blank.
/// @param size  as fonts count it: capitals are 0.73 of it high
std::vector<std::vector<glm::dvec2>> strokes_of(std::string_view text, double size);
double stroke_text_width(std::string_view text, double size);

}  // namespace sconce
