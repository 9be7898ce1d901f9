// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "encode/choice.h"
#include "info.h"
#include "package/package.h"
#include "table.h"

namespace sconce::app {

namespace {

using Json = nlohmann::ordered_json;

std::string percent(double value) {
  return fmt::format("{:.1f} %", 100 * value);
}
/// Dim groups keep two digits.
std::string lux(double value) {
  return value < 1 ? fmt::format("{:.2g}", value) : grouped(value, value < 100 ? 2 : 0);
}
std::string megabytes(double bytes) {
  return fmt::format("{:.2f}", bytes / 1e6);
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
               lux(g.mean_lux), percent(g.noise), std::to_string(g.lamps.size()), some_names(g.lamps)});
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

/// The group's name, and for components of g which.
std::string layer_label(const Manifest& m, const LayerInfo& layer) {
  return m.groups.at(layer.group).name + std::string(coefficient_suffix(layer.coefficient));
}

/// Where an encoding loses what eyes see, and what it is good for: system A's advice, with this layer's
/// figures.
std::vector<std::string> encoding_advice(const Manifest& m) {
  constexpr double kSeen = 0.01, kColourSeen = 2.3;  // of luminance; a just noticeable CIELAB distance
  std::vector<std::string> lines;
  for (const LayerInfo& layer : m.layers) {
    const EncodingChoice choice = parse_encoding(layer.encoding);
    const std::string group = layer_label(m, layer);
    if (layer.error.relative > kSeen && choice.encoding->type == TexelType::bc6h)
      lines.push_back(fmt::format("bc6h is for smooth layers; '{}' page {} loses {:.1f} %", group, layer.page,
                                  100 * layer.error.relative));
    else if (layer.error.relative > kSeen)
      lines.push_back(fmt::format("{} holds 1 % over 1:{:.3g}; '{}' page {} loses {:.1f} %",
                                  choice.encoding->name, range_within(*choice.encoding, kSeen), group,
                                  layer.page, 100 * layer.error.relative));
    if (choice.luminance && layer.error.chroma > kColourSeen)
      lines.push_back(
          fmt::format("'{}' page {} keeps luminance only: its colour is off by {:.1f} dE*ab, and a colour "
                      "fader will not show what surfaces bleed; {} keeps it",
                      group, layer.page, layer.error.chroma, choice.encoding->name));
  }
  return lines;
}

void add_layers(const Manifest& m, InfoReport& report) {
  Table table({{"LAYER"},
               {"PAGE", Table::Align::right},
               {"ENCODING"},
               {"ERROR", Table::Align::right},
               {"COLOUR", Table::Align::right},
               {"MB", Table::Align::right},
               {"ON DISK", Table::Align::right},
               {"FILE"}});
  Json& layers = report.json["layers"] = Json::array();
  std::map<std::string, uint64_t> files;  // groups may share one
  double texel_bytes = 0;
  for (const LayerInfo& layer : m.layers) {
    files[layer.file] = layer.bytes;
    const double memory = parse_encoding(layer.encoding).bytes_per_texel() * m.width * m.height;
    texel_bytes += memory;
    const std::string& group = m.groups.at(layer.group).name;
    table.add({layer_label(m, layer), std::to_string(layer.page), layer.encoding,
               fmt::format("{:.2f} %", 100 * layer.error.relative), fmt::format("{:.1f}", layer.error.chroma),
               megabytes(memory), megabytes(static_cast<double>(layer.bytes)), "layers/" + layer.file});
    layers.push_back({{"group", group},
                      {"page", layer.page},
                      {"coefficient", layer.coefficient},
                      {"encoding", layer.encoding},
                      {"error", layer.error.relative},
                      {"chroma_error", layer.error.chroma},
                      {"texel_bytes", memory},
                      {"bytes", layer.bytes},
                      {"file", "layers/" + layer.file}});
  }
  double bytes = 0;
  for (const auto& [file, size] : files) bytes += static_cast<double>(size);
  report.json["texel_bytes"] = texel_bytes;
  report.text += fmt::format("layers        {}, {} MB of texels, {} MB on disk\n", m.layers.size(),
                             megabytes(texel_bytes), megabytes(bytes));
  if (!m.layers.empty()) report.text += table.text();
  for (const std::string& line : encoding_advice(m)) report.text += "advice        " + line + "\n";
  uint64_t raw_bytes = 0;
  for (const LayerInfo& layer : m.raw) raw_bytes += layer.bytes;
  report.json["raw_layers"] = {{"count", m.raw.size()}, {"bytes", raw_bytes}};
  if (!m.raw.empty())
    report.text += fmt::format("raw layers    {}, {} MB, before the denoiser\n", m.raw.size(),
                               megabytes(static_cast<double>(raw_bytes)));
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
      {"basis", basis_row(m.basis).name},
      {"cameras", cameras}};
  report.text = fmt::format("package       {}, format {}, by {}\n", path.string(), m.version, m.generator);
  report.text += fmt::format("scene         {}\n", m.scene_name);
  report.text += fmt::format("atlas         {} x {}, {} {}", m.width, m.height, m.pages,
                             m.pages == 1 ? "page" : "pages");
  report.text += m.density > 0 ? fmt::format(", {:.4g} texels per metre\n", m.density) : "\n";
  report.text += fmt::format("basis         {}: {}\n", basis_row(m.basis).name, basis_row(m.basis).doc);
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
