// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/files.h"
#include "core/parallel.h"
#include "web_site.h"

namespace fs = std::filesystem;

namespace sconce::app {

namespace {

/// What would be replaced must be such a page itself.
void check_folder(const fs::path& folder) {
  if (!fs::exists(folder)) return;
  if (!fs::is_directory(folder)) throw Error(folder.string(), "is no folder");
  if (!fs::is_empty(folder) && !fs::exists(folder / "scene" / web::kSiteFile))
    throw Error(folder.string(), "holds something else", "a new or empty folder, or an earlier export");
}

}  // namespace

int run_export(int argc, const char* const* argv) {
  std::string input, folder;
  WebOptions web;
  Options options(
      "export",
      "A package as a web page with faders: a folder that any web server can host, without code on "
      "the server.",
      {"sconce export kitchen.sconce --web site",
       "sconce export kitchen.sconce --web site --preset evening.toml",
       "python3 -m http.server -d {FOLDER}"});
  options.positional("PACKAGE", &input, "NAME.sconce");
  options.option("--web", &folder, "folder to write; an earlier export in its place is replaced");
  web.declare(options);
  if (const auto code = options.parse(argc, argv)) return *code;
  if (folder.empty()) throw UsageError({}, "nothing to export to", "--web DIR");
  web.check();

  const ThreadLimit threads(options.threads);
  fs::path target = fs::absolute(folder).lexically_normal();
  if (!target.has_filename()) target = target.parent_path();
  check_folder(target);
  web::SiteReport report;
  {
    const Progress progress = make_progress(options);
    Beside beside(target);
    report = write_web_site(input, beside.path(), web, progress);
    beside.commit();
  }
  if (options.json) {
    nlohmann::ordered_json json = {{"input", input},
                                   {"output", folder},
                                   {"bytes",
                                    {{"geometry", report.geometry},
                                     {"textures", report.textures},
                                     {"meter", report.meter},
                                     {"layers", nlohmann::ordered_json::object()}}}};
    for (const auto& tier : report.tiers) json["bytes"]["layers"][std::string(tier.name)] = tier.bytes;
    fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
  } else if (!options.quiet) {
    std::string layers;
    for (const auto& tier : report.tiers)
      layers += fmt::format("{}{} {:.1f} MB", layers.empty() ? "" : ", ", tier.name,
                            static_cast<double>(tier.bytes) / 1e6);
    fmt::print("{}: a page for any web server; layers: {}; the rest {:.1f} MB\n", folder, layers,
               static_cast<double>(report.geometry + report.textures + report.meter) / 1e6);
  }
  options.next({folder});
  return kDone;
}

}  // namespace sconce::app
