// SPDX-License-Identifier: Apache-2.0
// Which faders are shown, and in which folders, when there are many.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sconce {

struct FaderFolder {
  std::string name;  ///< "" = none: its faders stand alone
  std::vector<std::size_t> groups;
};

/// Groups whose names hold every word of `search`, whatever the case, in order of first appearance. A name
/// `kitchen/pendant` lies in the folder `kitchen`. Where there are more than kMany groups, names that begin
/// with the same word lie in a folder, too, if at least three do.
std::vector<FaderFolder> fader_folders(std::span<const std::string> names, std::string_view search);
inline constexpr std::size_t kMany = 12;

}  // namespace sconce
