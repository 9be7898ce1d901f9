// SPDX-License-Identifier: Apache-2.0
#include "bake_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/text.h"
#include "encode/choice.h"

namespace sconce::app {

namespace {

std::vector<std::string> names(const PreparedBake& bake, bool solved) {
  std::vector<std::string> result;
  for (std::size_t g = 0; g < bake.scene.groups.size(); ++g)
    if (bake.plan.kept(g).has_value() != solved) result.push_back(bake.scene.groups[g].name);
  return result;
}

/// Bytes of all layers, before files compress them; "auto" counts as the halves that it is at most.
double layer_bytes(const PreparedBake& bake) {
  double pixel = 0;
  for (const std::string& name : bake.encodings)
    pixel += parse_encoding(name == kAutoEncoding ? "f16" : name).bytes_per_texel();
  return pixel * static_cast<double>(coefficients(bake.job.params.basis)) * bake.atlas.width *
         bake.atlas.height * bake.atlas.pages;
}

std::string in_words(double seconds) {
  return seconds < 90 ? fmt::format("{:.0f} s", seconds) : fmt::format("{:.1f} min", seconds / 60);
}

}  // namespace

void print_plan(const PreparedBake& bake, std::optional<double> seconds, bool json) {
  const AtlasReport& report = bake.atlas.report;
  const std::vector<std::string> solved = names(bake, true), kept = names(bake, false);
  if (json) {
    nlohmann::json plan = {{"solved", solved},
                           {"kept", kept},
                           {"triangles", bake.world.size()},
                           {"receivers", bake.receivers.size()},
                           {"pages", bake.atlas.pages},
                           {"width", bake.atlas.width},
                           {"height", bake.atlas.height},
                           {"layer_bytes", layer_bytes(bake)}};
    if (seconds) plan["seconds"] = *seconds;
    fmt::print("{}\n", plan.dump(2));
    return;
  }
  fmt::print("{}: {} triangles, {} lamps in {} groups\n", bake.job.scene.string(), bake.world.size(),
             bake.lamps.size(), bake.scene.groups.size());
  fmt::print(
      "atlas: {} page(s) of {} x {}, {:.4g} texels/m, {} charts, {} receivers, {} invalid, utilisation "
      "{:.1f} %, "
      "stretch mean {:.2f} max {:.2f}, {} triangles with a visible back\n",
      bake.atlas.pages, bake.atlas.width, bake.atlas.height, static_cast<double>(bake.atlas.density),
      report.charts, bake.receivers.size(), report.invalid, 100 * report.utilisation, report.stretch_mean,
      report.stretch_max, report.twins);
  fmt::print("to be solved: {}; kept: {}\n", solved.empty() ? "nothing" : join(solved, ", "),
             kept.empty() ? "nothing" : join(kept, ", "));
  fmt::print("{} texels, {:.3g} MB of layers before compression, {}\n", bake.receivers.size(),
             layer_bytes(bake) / 1e6,
             seconds ? "about " + in_words(*seconds) + " on this machine" : "time not known beforehand");
}

void print_result(const PreparedBake& bake, const Manifest& manifest, const std::filesystem::path& output,
                  double seconds, bool json) {
  double bytes = 0;
  for (const LayerInfo& layer : manifest.layers) bytes += static_cast<double>(layer.bytes);
  if (json) {
    nlohmann::json groups = nlohmann::json::array();
    for (const GroupInfo& group : manifest.groups)
      groups.push_back({{"name", group.name},
                        {"lumens", group.lumens},
                        {"mean_lux", group.mean_lux},
                        {"noise", group.noise}});
    for (std::size_t g = 0; g < groups.size(); ++g) groups[g]["kept"] = bake.plan.kept(g).has_value();
    const nlohmann::json report = {
        {"output", output.string()}, {"seconds", seconds},      {"width", manifest.width},
        {"height", manifest.height}, {"pages", manifest.pages}, {"layer_bytes", bytes},
        {"groups", groups},          {"facts", manifest.facts}, {"solved", bake.plan.count(true)}};
    fmt::print("{}\n", report.dump(2));
    return;
  }
  fmt::print("{}: {} group{}, {} page{} of {} x {}, {:.1f} MB of layers, {:.1f} s\n", output.string(),
             manifest.groups.size(), manifest.groups.size() == 1 ? "" : "s", manifest.pages,
             manifest.pages == 1 ? "" : "s", manifest.width, manifest.height, bytes / 1e6, seconds);
  for (std::size_t g = 0; g < manifest.groups.size(); ++g) {
    const GroupInfo& group = manifest.groups[g];
    fmt::print("  {:<20} {:>10} {:>12.4g} lx mean  noise {:.1f} %{}\n", group.name,
               group.infinite ? "-" : fmt::format("{:.4g} lm", group.lumens), group.mean_lux,
               100 * group.noise, bake.plan.kept(g) ? "  kept" : "");
  }
}

}  // namespace sconce::app
