// SPDX-License-Identifier: Apache-2.0
// One declared option or positional argument, whatever reads it: command line, file, help.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "app.h"

namespace sconce::app {

struct Declared {
  std::string names;  ///< "-o,--output"; a positional has a bare name
  std::string key;    ///< first long name without dashes: key in files and in provenance
  std::string doc;
  std::string placeholder;  ///< "TEXT", "N", "NUMBER", "TIME"; empty for flags
  bool positional = false, required = false, many = false;
  bool in_files = true;                                         ///< may stand in [options]
  std::function<void(const std::vector<std::string>&)> assign;  ///< @throws UsageError
  std::function<std::string()> show;                            ///< current value as text
  std::string source = "default";

  bool is_flag() const { return placeholder.empty(); }
};

/// What --help prints.
std::string help_text(const std::string& verb, const std::string& summary, std::span<const Declared> declared,
                      const Guide& guide);

/// `next` of a guide with `files`, quoted for a shell, in the places of its {NAME}s; without files, the
/// NAMEs.
std::string next_step(std::string_view next, std::span<const std::string> files = {});

}  // namespace sconce::app
