// SPDX-License-Identifier: Apache-2.0
// Incremental baking: which layers of the package that stands may stay.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "package/package.h"

namespace sconce::app {

/// For each group of a bake the layer that it is kept from, by the hash of what it depends on and whatever it
/// was called; none = it is to be solved.
class BakePlan {
 public:
  /// @param inputs     hash per group
  /// @param encodings  per group: a layer that was kept coarser than that is solved again
  /// @param max_error  of "auto"
  /// @param package    may be empty, missing or damaged: then nothing is kept
  BakePlan(const std::vector<std::string>& inputs, const std::vector<std::string>& encodings,
           double max_error, const std::filesystem::path& package);

  /// The package that layers are kept from, as it was before the denoiser; null where none stands.
  const Package* before() const { return before_ ? &*before_ : nullptr; }
  /// Its group that group g is kept from.
  std::optional<std::size_t> kept(std::size_t g) const { return kept_[g]; }
  std::size_t count(bool solved) const;
  std::vector<uint8_t> wanted() const;  ///< per group: 1 = to be solved

 private:
  std::optional<Package> before_;
  std::vector<std::optional<std::size_t>> kept_;
};

}  // namespace sconce::app
