// SPDX-License-Identifier: Apache-2.0
// Lamps that are told on a command line, in the words of a side file's [[light]] and [[luminaire]].
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/progress.h"
#include "scene/more_lights.h"

namespace sconce {

/// A lamp's text in its parts.
struct LightWords {
  std::string type;
  std::vector<std::pair<std::string, std::vector<std::string>>> values;  ///< per key, in order
};

/// `spot,position=1,2,0.5,target=0,0,0,lumens=800,kelvin=2700`: the type, then KEY=VALUE; a part without `=`
/// goes on with the value before it. @throws UsageError naming `where`
LightWords split_light(std::string_view text, const std::string& where);

/// A lamp without extent; keys are those of [[light]]. @throws UsageError or Error naming `where` and the key
Light parse_light(const LightWords& words, const std::string& where);

/// Any of [[light]], or `luminaire,file=lamp.ldt,position=0,2.8,0`: a measured one, its keys those of
/// [[luminaire]] but for rows of them, or as [[light]] calls them (position, target, lumens, kelvin).
/// @throws UsageError or Error naming `where` and the key
MoreLights parse_lights(std::string_view text, const std::string& where, const Progress& progress = {});

/// The [[light]] and [[luminaire]] tables of a TOML file that has nothing else. @throws Error with file:line
MoreLights read_lights(const std::filesystem::path& path, const Progress& progress = {});

}  // namespace sconce
