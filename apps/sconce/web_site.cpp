// SPDX-License-Identifier: Apache-2.0
#include "web_site.h"

#include "core/error.h"
#include "core/installed.h"
#include "core/text.h"
#include "picture/render.h"

namespace fs = std::filesystem;

namespace sconce::app {

namespace {

fs::path page_folder() {
  const fs::path page = installed_file("web/index.html");
  if (!fs::exists(page))
    throw Error(page.string(), "the page is not built: 'make web' does that, and needs npm");
  return page.parent_path();
}

std::vector<const ShaderTier*> tiers_of(const std::string& text) {
  std::vector<const ShaderTier*> tiers;
  for (const std::string& name : split(text, ',')) {
    const ShaderTier* tier = &find_shader_tier(trim(name));
    if (std::find(tiers.begin(), tiers.end(), tier) == tiers.end()) tiers.push_back(tier);
  }
  std::sort(tiers.begin(), tiers.end());  // best first, as in the table
  return tiers;
}

}  // namespace

void WebOptions::declare(Options& options) {
  options.option("--preset", &presets, "TOML file with a mood, a button of the page; may be repeated");
  options.option(
      "--tiers", &tiers,
      "sets of layers, of which each device loads the best that it can show: full, half, unfiltered, byte");
  options.option("--encoding", &encoding,
                 "encode all layers anew: f16, exp8, rgbe8, multi8, bc6h, lum:f16, lum:exp8, ...");
}

void WebOptions::check() const {
  tiers_of(tiers);
  if (!encoding.empty()) parse_encoding(encoding);
  for (const std::string& file : presets) read_preset(file);
}

web::SiteReport write_web_site(const std::string& input, const fs::path& folder, const WebOptions& web,
                               const Progress& progress) {
  const fs::path page = page_folder();
  const Package package = Package::open(input);
  web::SiteParams params;
  params.tiers = tiers_of(web.tiers);
  if (!web.encoding.empty()) params.encoding = parse_encoding(web.encoding);
  params.cameras = package.scene().cameras;
  if (params.cameras.empty()) params.cameras.push_back(View(package).camera({}, progress));
  for (const std::string& file : web.presets) {
    params.presets.emplace_back(fs::path(file).stem().string(), read_preset(file));
    if (!params.presets.back().second.lamps.empty())
      progress.warn(file + ": the page moves no lamps: they stay where they were baked");
  }
  fs::create_directories(folder / "scene");
  fs::copy(page, folder, fs::copy_options::recursive);
  return write_site(package, folder / "scene", params, progress);
}

}  // namespace sconce::app
