// SPDX-License-Identifier: Apache-2.0
// What `export --web` and `serve` share: the page that was built from web/, and a package for it.
#pragma once

#include <filesystem>

#include "app.h"
#include "web/site.h"

namespace sconce::app {

struct WebOptions {
  std::vector<std::string> presets;
  std::string tiers = "half,byte", encoding;

  void declare(Options& options);
  /// Everything that can be checked without the package. @throws UsageError
  void check() const;
};

/// index.html, what it needs, and the package in scene/. @throws Error where the page was not built
web::SiteReport write_web_site(const std::string& package, const std::filesystem::path& folder,
                               const WebOptions& web, const Progress& progress);

}  // namespace sconce::app
