// SPDX-License-Identifier: Apache-2.0
// What renderers call the layers of their light groups. Adding a renderer is a row of group_names.cpp.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sconce {

struct GroupNaming {
  std::string renderer;  ///< for messages; "" for a user's own expression
  std::string group;  ///< ECMAScript expression of a layer's name without the view layer before it; its last
                      ///< capture (or all of it) is the group
};
/// Blender Cycles, V-Ray, LuxCore, Arnold.
std::span<const GroupNaming> group_namings();

struct NamedGroup {
  std::string layer, name;
};
/// The layers of light groups among a picture's.
struct FoundGroups {
  std::string renderer;            ///< "" where names told none
  std::string view;                ///< "ViewLayer." before all of them, or empty
  std::vector<NamedGroup> groups;  ///< in the order of `layers`
};
/// By the first row that finds any; of the first view layer that has some.
/// @param layers    that are colours, without ".R"
/// @param expression  instead of the rows, where not empty: found anywhere in a layer's name
/// @throws UsageError for a bad expression
FoundGroups find_groups(const std::vector<std::string>& layers, const std::string& expression);

/// Which of these layers is the whole picture that those groups are parts of.
std::optional<std::string> find_beauty(const std::vector<std::string>& layers, const FoundGroups& found);

}  // namespace sconce
