// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "scene/scene.h"

namespace sconce {

/// How lights become faders (architecture.md, "Groups").
enum class Grouping {
  automatic,  ///< named groups as named; every other light or emissive mesh by its name without trailing
              ///< digits
  named,      ///< named groups as named; what has no name goes to `rest`
  per_light,  ///< every light and every emissive instance is its own group
  one         ///< all in one group called `all-lights`
};

/// @throws UsageError naming the choices
Grouping parse_grouping(std::string_view text);

/// Fills scene.groups and the group of every light and every emissive instance; no light is ever dropped.
/// Order: by first appearance. Sky and sun are groups of their own under `automatic` unless named.
void assign_groups(Scene& scene, Grouping grouping);

}  // namespace sconce
