// SPDX-License-Identifier: Apache-2.0
#include "web/site.h"

#include <utility>

#include "core/error.h"
#include "core/files.h"
#include "core/kelvin.h"
#include "mix/settings.h"
#include "package/convention.h"
#include "web/packed.h"
#include "web/parts.h"

namespace sconce::web {

namespace {

constexpr std::string_view kSurface =
#include "gpu/surface.glsl.h"
    ;

Json groups_json(const Manifest& m) {
  Json out = Json::array();
  for (const GroupInfo& group : m.groups)
    out.push_back({{"name", group.name},
                   {"lumens", group.lumens},
                   {"color", json_of(group.color)},
                   {"infinite", group.infinite},
                   {"meanLux", group.mean_lux},
                   {"lamps", group.lamps}});
  return out;
}

Json cameras_json(const std::vector<Camera>& cameras) {
  Json out = Json::array();
  for (const Camera& camera : cameras) {
    Json matrix = Json::array();
    for (int i = 0; i < 16; ++i) matrix.push_back(camera.frame[i / 4][i % 4]);
    out.push_back(
        {{"name", camera.name}, {"matrix", matrix}, {"yfov", camera.yfov}, {"aspect", camera.aspect}});
  }
  return out;
}

Json presets_json(const Manifest& m, const SiteParams& params) {
  Json out = Json::array();
  for (const auto& [name, preset] : params.presets) {
    make_mix(m.groups, preset.assignments, preset.others, {});  // told now rather than in the browser
    out.push_back({{"name", name},
                   {"settings", preset.assignments},
                   {"others", preset.others},
                   {"exposure", preset.exposure},
                   {"ev100", preset.ev100},
                   {"tone", preset.tone},
                   {"camera", preset.camera}});
  }
  return out;
}

/// Colours of black bodies, so that the page needs no table of the eye's sensitivity.
Json kelvins_json() {
  constexpr double kStep = 50;
  Json colors = Json::array();
  for (double kelvin = kKelvinMin; kelvin <= kKelvinMax; kelvin += kStep)
    colors.push_back(json_of(kelvin_color(kelvin)));
  return {{"from", kKelvinMin}, {"step", kStep}, {"colors", std::move(colors)}};
}

Json tones_json() {
  Json out = Json::array();
  for (const ToneMapper& mapper : tone_mappers())
    out.push_back({{"name", mapper.name}, {"doc", mapper.doc}, {"glsl", tone_glsl(mapper)}});
  return out;
}

}  // namespace

Json SiteFiles::write(const std::string& name, const std::function<std::string()>& make) {
  const auto [at, is_new] = written_.try_emplace(name);
  if (is_new) {
    const std::string bytes = make();
    write_file(folder_ / name, bytes);
    at->second = bytes.size();
    bytes_ += bytes.size();
  }
  return {{"file", name}, {"bytes", at->second}};
}

Json SiteFiles::write_packed(const std::string& name, std::span<const std::byte> data, std::size_t element) {
  return write(name, [&] { return pack(data, element); });
}

SiteReport write_site(const Package& package, const std::filesystem::path& folder, const SiteParams& params,
                      const Progress& progress) {
  const Manifest& m = package.manifest();
  const uint64_t steps = params.tiers.size() + 2;
  uint64_t step = 0;
  const auto next = [&] {
    progress.check();
    progress.at("export", step++, steps);
  };
  SiteFiles files(folder);
  SiteReport report;
  std::size_t before = 0;
  const auto written = [&] { return files.bytes() - std::exchange(before, files.bytes()); };

  next();
  const ShownScene shown(package);
  const bool normal_maps = m.basis != Basis::flat && shown.scene.has_normal_maps();
  const std::size_t shown_coefficients = normal_maps ? coefficients(m.basis) : 1;
  Json out = {{"format", "sconce-web"},
              {"version", 1},
              {"generator", m.generator},
              {"name", m.scene_name},
              {"convention", lightmap_convention(m.lightmap_set)},
              {"atlas", {{"width", m.width}, {"height", m.height}, {"pages", m.pages}}},
              {"coefficients", shown_coefficients},
              {"groups", groups_json(m)},
              {"cameras", cameras_json(params.cameras)},
              {"presets", presets_json(m, params)}};
  out["geometry"] = write_geometry(files, shown, normal_maps);
  report.geometry = written();
  out["materials"] = write_materials(shown.scene, normal_maps);
  out["textures"] = write_textures(files, shown.scene, normal_maps);
  out["skies"] = write_skies(files, shown.scene);
  report.textures = written();
  next();
  out["meter"] = write_meter(files, choose_meter_points(package, shown, progress));
  if (Json probes = write_probes(files, package); !probes.is_null()) out["probes"] = std::move(probes);
  report.meter = written();
  for (const ShaderTier* tier : params.tiers) {
    next();
    out["tiers"].push_back(write_tier(files, package, shown_coefficients, *tier, params.encoding));
    report.tiers.push_back({tier->name, out["tiers"].back()["bytes"].get<std::size_t>()});
  }
  out["surface"] = kSurface;
  out["tones"] = tones_json();
  out["kelvins"] = kelvins_json();
  write_file(folder / kSiteFile, out.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n");
  return report;
}

}  // namespace sconce::web
