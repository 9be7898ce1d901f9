// SPDX-License-Identifier: Apache-2.0
// A package as a browser wants it: a folder that any web server can host (docs/web.md). The page that shows
// it is TypeScript (web/).
#pragma once

#include <filesystem>
#include <optional>
#include <utility>

#include "core/progress.h"
#include "mix/preset.h"
#include "package/package.h"
#include "shader/composer.h"

namespace sconce::web {

struct SiteParams {
  std::vector<const ShaderTier*> tiers;    ///< sets of layers, for what devices can do; the page takes one
  std::optional<EncodingChoice> encoding;  ///< of all layers, instead of the package's own
  std::vector<Camera> cameras;             ///< at least one
  std::vector<std::pair<std::string, Preset>> presets;  ///< by name
};

struct SiteReport {
  struct Tier {
    std::string_view name;
    std::size_t bytes;  ///< of layers, as they are sent
  };
  std::vector<Tier> tiers;
  std::size_t geometry = 0, textures = 0, meter = 0;  ///< bytes
};

inline constexpr const char* kSiteFile = "sconce.json";

/// Writes kSiteFile and what it names into a folder that is there.
/// @throws Error; UsageError where encodings or presets do not fit the package; Cancelled
SiteReport write_site(const Package& package, const std::filesystem::path& folder, const SiteParams& params,
                      const Progress& progress = {});

}  // namespace sconce::web
