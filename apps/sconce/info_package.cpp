// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "info.h"
#include "package/package.h"
#include "table.h"

namespace sconce::app {

namespace {

using Json = nlohmann::ordered_json;

std::string percent(double value) {
  return fmt::format("{:.1f} %", 100 * value);
}
std::string megabytes(uint64_t bytes) {
  return fmt::format("{:.2f}", static_cast<double>(bytes) / 1e6);
}

void add_groups(const Manifest& m, InfoReport& report) {
  Table table({{"GROUP"},
               {"LUMENS", Table::Align::right},
               {"COLOUR"},
               {"MEAN LUX", Table::Align::right},
               {"NOISE", Table::Align::right},
               {"LAMPS", Table::Align::right},
               {""}});
  Json& groups = report.json["groups"] = Json::array();
  for (const GroupInfo& g : m.groups) {
    table.add({g.name, g.infinite ? "-" : grouped(g.lumens, g.lumens < 100 ? 1 : 0), hex_color(g.color),
               grouped(g.mean_lux, g.mean_lux < 100 ? 2 : 0), percent(g.noise),
               std::to_string(g.lamps.size()), some_names(g.lamps)});
    groups.push_back({{"name", g.name},
                      {"lumens", g.infinite ? Json() : Json(g.lumens)},
                      {"color", json_of(g.color)},
                      {"color_spread", g.color_spread},
                      {"mean_lux", g.mean_lux},
                      {"noise", g.noise},
                      {"lamps", g.lamps}});
  }
  report.text += fmt::format("light groups  {}\n", m.groups.size());
  if (!m.groups.empty()) report.text += table.text();
}

void add_layers(const Manifest& m, InfoReport& report) {
  Table table(
      {{"LAYER"}, {"PAGE", Table::Align::right}, {"ENCODING"}, {"MB", Table::Align::right}, {"FILE"}});
  Json& layers = report.json["layers"] = Json::array();
  uint64_t bytes = 0;
  for (const LayerInfo& layer : m.layers) {
    bytes += layer.bytes;
    const std::string& group = m.groups.at(layer.group).name;
    table.add(
        {group, std::to_string(layer.page), layer.encoding, megabytes(layer.bytes), "layers/" + layer.file});
    layers.push_back({{"group", group},
                      {"page", layer.page},
                      {"encoding", layer.encoding},
                      {"bytes", layer.bytes},
                      {"file", "layers/" + layer.file}});
  }
  report.text += fmt::format("layers        {}, {} MB\n", m.layers.size(), megabytes(bytes));
  if (!m.layers.empty()) report.text += table.text();
  uint64_t raw_bytes = 0;
  for (const LayerInfo& layer : m.raw) raw_bytes += layer.bytes;
  report.json["raw_layers"] = {{"count", m.raw.size()}, {"bytes", raw_bytes}};
  if (!m.raw.empty())
    report.text +=
        fmt::format("raw layers    {}, {} MB, before the denoiser\n", m.raw.size(), megabytes(raw_bytes));
}

void add_options(const Manifest& m, InfoReport& report) {
  Table table({{"OPTION"}, {"VALUE"}, {"FROM"}});
  for (const auto& [name, option] : m.options) table.add({name, option.value, option.source});
  report.text += "options\n" + table.text();
}

}  // namespace

InfoReport package_info(const std::filesystem::path& path, bool options) {
  const Package package = Package::open(path);
  const Manifest& m = package.manifest();
  const Scene scene = package.scene();
  std::vector<std::string> cameras;
  for (const Camera& camera : scene.cameras) cameras.push_back(camera.name);

  InfoReport report;
  report.json = {
      {"kind", "package"},
      {"file", path.string()},
      {"version", m.version},
      {"generator", m.generator},
      {"scene", m.scene_name},
      {"atlas", {{"width", m.width}, {"height", m.height}, {"pages", m.pages}, {"density", m.density}}},
      {"cameras", cameras}};
  report.text = fmt::format("package       {}, format {}, by {}\n", path.string(), m.version, m.generator);
  report.text += fmt::format("scene         {}\n", m.scene_name);
  report.text += fmt::format("atlas         {} x {}, {} {}", m.width, m.height, m.pages,
                             m.pages == 1 ? "page" : "pages");
  report.text += m.density > 0 ? fmt::format(", {:.4g} texels per metre\n", m.density) : "\n";
  report.text += fmt::format("cameras       {}\n", cameras.empty() ? "none" : some_names(cameras, 8));
  add_groups(m, report);
  add_layers(m, report);
  Table facts({{"FACT"}, {""}});
  for (const auto& [name, value] : m.facts) facts.add({name, value});
  if (!m.facts.empty()) report.text += facts.text();
  report.json["facts"] = m.facts;
  for (const auto& [name, option] : m.options) {
    report.json["options"][name] = {{"value", option.value}, {"source", option.source}};
  }
  if (options) add_options(m, report);
  return report;
}

}  // namespace sconce::app
