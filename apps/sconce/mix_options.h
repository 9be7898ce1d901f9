// SPDX-License-Identifier: Apache-2.0
// The options that `mix` and `render` share: group settings on the command line and in a preset.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app.h"
#include "mix/preset.h"
#include "mix/settings.h"

namespace sconce::app {

struct MixOptions {
  std::vector<std::string> settings;
  std::string preset_file, others;
  bool raw = false;
  bool moves_lamps = false;  ///< those of a preset; else they stay, which is said

  void declare(Options& options);
  /// The package to mix: as it stands, or as it was before the denoiser. @throws Error
  Package open(const std::string& path) const;
  /// The preset's file, or an empty preset. @throws UsageError, Error
  Preset preset() const;
  /// The preset's settings first, then the command line's, which win. @throws UsageError
  MixSpec make(const Preset& preset, std::span<const GroupInfo> groups, const Progress& progress) const;
};

/// JSON text: [{"name": ..., "weight": [r, g, b]}, ...]
std::string weights_json(std::span<const GroupInfo> groups, const MixSpec& mix);

/// `path` must end with one of `extensions`, or be `-`, and its folder must be writable.
/// @throws UsageError naming the extensions; Error
void check_output(const std::string& path, const std::vector<std::string>& extensions);

/// Bytes to standard output, for `-o -`. @throws Error when they do not all arrive
void write_stdout(std::string_view bytes);

}  // namespace sconce::app
