// SPDX-License-Identifier: Apache-2.0
#include "package/manifest.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/files.h"
#include "package/json.h"

namespace sconce {

using Json = nlohmann::ordered_json;

namespace {

Json finite(double v, const std::string& key) {
  if (!std::isfinite(v)) throw Error(std::string(kManifestFile), key + " is not finite");
  return v;
}

Json color(const Rgb& c, const std::string& key) {
  return {finite(c.r, key), finite(c.g, key), finite(c.b, key)};
}

// Indented, but an array of plain values stays on one line: there is one number per mesh node.
void print(const Json& v, int indent, std::string& out) {
  const bool plain = std::none_of(v.begin(), v.end(), [](const Json& e) { return e.is_structured(); });
  if (!v.is_structured() || v.empty() || (v.is_array() && plain)) {
    out += v.dump(-1, ' ', false, Json::error_handler_t::replace);
    return;
  }
  const std::string margin(static_cast<std::size_t>(indent), ' ');
  out += v.is_array() ? "[" : "{";
  std::string_view comma;
  for (auto it = v.begin(); it != v.end(); ++it) {
    out.append(comma).append("\n  ").append(margin);
    if (v.is_object()) out += Json(it.key()).dump(-1, ' ', false, Json::error_handler_t::replace) + ": ";
    print(*it, indent + 2, out);
    comma = ",";
  }
  out += "\n" + margin + (v.is_array() ? "]" : "}");
}

GroupInfo parse_group(const JsonValue& v) {
  GroupInfo group;
  group.name = v.at("name").text();
  group.lumens = v.at("lumens").number();
  group.color = v.at("color").rgb();
  group.color_spread = v.at("color_spread").number();
  group.infinite = v.at("infinite").flag();
  group.mean_lux = v.at("mean_lux").number();
  group.noise = v.at("noise").number();
  const JsonValue lamps = v.at("lamps");
  for (std::size_t i = 0; i < lamps.size(); ++i) group.lamps.push_back(lamps.at(i).text());
  group.inputs = v.text("inputs", "");
  return group;
}

std::string base_name(const JsonValue& v) {
  const std::string name = v.text();
  if (!is_base_name(name)) v.fail("is '" + name + "'", "a file name without a folder");
  return name;
}

LayerInfo parse_layer(const JsonValue& v, const Manifest& m) {
  LayerInfo layer;
  const std::string group = v.at("group").text();
  const auto found =
      std::find_if(m.groups.begin(), m.groups.end(), [&](const GroupInfo& g) { return g.name == group; });
  if (found == m.groups.end()) v.at("group").fail("names the unknown group '" + group + "'");
  layer.group = static_cast<uint32_t>(found - m.groups.begin());
  layer.page = static_cast<int>(v.at("page").index(static_cast<std::size_t>(m.pages)));
  layer.encoding = v.at("encoding").text();
  layer.file = base_name(v.at("file"));
  layer.hash = v.at("hash").text();
  layer.bytes = static_cast<uint64_t>(v.at("bytes").integer(0, INT64_MAX));
  if (v.has("coefficient")) layer.coefficient = v.at("coefficient").index(coefficients(m.basis));
  if (v.has("channel")) layer.channel = static_cast<int>(v.at("channel").index(4));
  layer.gain = v.number("gain", 1);
  if (!(layer.gain > 0)) v.at("gain").fail("is not above 0");
  layer.error = {v.number("error", 0), v.number("chroma_error", 0)};
  return layer;
}

// Every group has each page of each coefficient exactly once.
void check_layers(const JsonValue& list, const Manifest& m, const std::vector<LayerInfo>& layers) {
  const std::size_t pages = static_cast<std::size_t>(m.pages), groups = m.groups.size();
  std::vector<int> seen(coefficients(m.basis) * groups * pages, 0);
  for (const LayerInfo& layer : layers)
    ++seen[(layer.coefficient * groups + layer.group) * pages + static_cast<std::size_t>(layer.page)];
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (seen[i] == 1) continue;
    const std::size_t coefficient = i / pages / groups;
    list.fail((seen[i] == 0 ? "misses page " : "has more than one page ") + std::to_string(i % pages) +
              " of group '" + m.groups[i / pages % groups].name + "'" +
              (coefficient == 0 ? std::string() : ", coefficient " + std::to_string(coefficient)));
  }
}

Json print_layers(const std::vector<LayerInfo>& layers, const Manifest& m) {
  Json list = Json::array();
  for (const LayerInfo& l : layers) {
    list.push_back({{"group", m.groups.at(l.group).name},
                    {"page", l.page},
                    {"encoding", l.encoding},
                    {"file", l.file},
                    {"hash", l.hash},
                    {"bytes", l.bytes},
                    {"gain", finite(l.gain, "layers.gain")},
                    {"error", finite(l.error.relative, "layers.error")},
                    {"chroma_error", finite(l.error.chroma, "layers.chroma_error")}});
    if (l.channel >= 0) list.back()["channel"] = l.channel;
    if (l.coefficient > 0) list.back()["coefficient"] = l.coefficient;
  }
  return list;
}

}  // namespace

bool is_base_name(std::string_view name) {
  return !name.empty() && name.front() != '.' && name.find_first_of("/\\") == std::string_view::npos &&
         name.find('\0') == std::string_view::npos;
}

bool is_package(const std::filesystem::path& folder) {
  std::error_code ec;
  const std::filesystem::path file = folder / kManifestFile;
  if (!std::filesystem::is_regular_file(file, ec)) return false;
  // Looked for in the text, so that a damaged package still counts as one.
  return read_file(file).find(kPackageFormat) != std::string::npos;
}

std::vector<std::string> layer_names(std::span<const GroupInfo> groups, std::size_t coefficient) {
  std::vector<std::string> names;
  for (const GroupInfo& group : groups) {
    std::string name;
    for (const char c : group.name)
      name += std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_' ? c : '_';
    if (name.empty()) name = "_";
    std::string unique = name;
    for (int n = 2; std::find(names.begin(), names.end(), unique) != names.end(); ++n)
      unique = name + "_" + std::to_string(n);
    names.push_back(std::move(unique));
  }
  for (std::string& name : names) name += coefficient_suffix(coefficient);
  return names;
}

std::string page_file(std::string_view stem, int page, std::string_view extension) {
  return std::string(stem) + "." + std::to_string(page) + std::string(extension);
}

std::string sky_file(std::size_t index) {
  return index == 0 ? "sky.exr" : "sky." + std::to_string(index) + ".exr";
}

std::string print_manifest(const Manifest& m) {
  Json j;
  j["format"] = kPackageFormat;
  j["version"] = m.version;
  j["generator"] = m.generator;
  j["scene"] = {{"name", m.scene_name}, {"hash", m.scene_hash}};
  j["atlas"] = {{"width", m.width},
                {"height", m.height},
                {"pages", m.pages},
                {"density", finite(m.density, "atlas.density")},
                {"lightmap_set", m.lightmap_set},
                {"instance_pages", m.instance_pages},
                {"instance_twins", m.instance_twins}};
  j["basis"] = basis_row(m.basis).name;
  j["groups"] = Json::array();
  for (const GroupInfo& g : m.groups) {
    const std::string key = "groups." + g.name + ".";
    j["groups"].push_back({{"name", g.name},
                           {"lumens", finite(g.lumens, key + "lumens")},
                           {"color", color(g.color, key + "color")},
                           {"color_spread", finite(g.color_spread, key + "color_spread")},
                           {"infinite", g.infinite},
                           {"mean_lux", finite(g.mean_lux, key + "mean_lux")},
                           {"noise", finite(g.noise, key + "noise")},
                           {"lamps", g.lamps},
                           {"inputs", g.inputs}});
  }
  j["layers"] = print_layers(m.layers, m);
  if (!m.raw.empty()) j["raw"] = print_layers(m.raw, m);
  j["files"] = Json(m.hashes);
  j["options"] = Json::object();
  for (const auto& [name, option] : m.options)
    j["options"][name] = {{"value", option.value}, {"source", option.source}};
  j["facts"] = Json(m.facts);
  std::string out;
  print(j, 0, out);
  return out + "\n";
}

Manifest parse_manifest(std::string_view text, const std::string& where) {
  const JsonValue root = JsonValue::parse(text, where);
  if (!root.has("format") || root.text("format", "") != kPackageFormat)
    throw NotMyFormat(where, "belongs to no sconce package");
  Manifest m;
  m.version = static_cast<int>(root.at("version").integer(0, INT32_MAX));
  if (m.version != kPackageVersion)
    throw Error(where, "is of package version " + std::to_string(m.version) +
                           ", this program reads version " + std::to_string(kPackageVersion));
  m.generator = root.at("generator").text();
  m.scene_name = root.at("scene").at("name").text();
  m.scene_hash = root.at("scene").at("hash").text();

  constexpr int kMaxSize = 1 << 16;
  const JsonValue atlas = root.at("atlas");
  m.width = static_cast<int>(atlas.at("width").integer(1, kMaxSize));
  m.height = static_cast<int>(atlas.at("height").integer(1, kMaxSize));
  m.pages = static_cast<int>(atlas.at("pages").integer(1, kMaxSize));
  m.density = atlas.at("density").number();
  m.lightmap_set = static_cast<uint32_t>(atlas.at("lightmap_set").integer(0, 255));
  const JsonValue pages = atlas.at("instance_pages"), twins = atlas.at("instance_twins");
  for (std::size_t i = 0; i < pages.size(); ++i)
    m.instance_pages.push_back(static_cast<int>(pages.at(i).integer(-1, m.pages - 1)));
  if (twins.size() != pages.size()) twins.fail("has another length than atlas.instance_pages");
  for (std::size_t i = 0; i < twins.size(); ++i)
    m.instance_twins.push_back(
        static_cast<int>(twins.at(i).integer(-1, static_cast<int64_t>(twins.size()) - 1)));

  const std::string basis = root.text("basis", "flat");
  try {
    m.basis = find_basis(basis);
  } catch (const UsageError& e) {
    throw Error(where, e.what());
  }
  const JsonValue groups = root.at("groups"), layers = root.at("layers");
  for (std::size_t i = 0; i < groups.size(); ++i) m.groups.push_back(parse_group(groups.at(i)));
  for (std::size_t i = 0; i < layers.size(); ++i) m.layers.push_back(parse_layer(layers.at(i), m));
  check_layers(layers, m, m.layers);
  if (root.has("raw")) {
    const JsonValue raw = root.at("raw");
    for (std::size_t i = 0; i < raw.size(); ++i) m.raw.push_back(parse_layer(raw.at(i), m));
    check_layers(raw, m, m.raw);
  }

  const JsonValue files = root.at("files"), options = root.at("options"), facts = root.at("facts");
  for (const std::string& name : files.keys()) {
    if (!is_base_name(name)) files.fail("names '" + name + "'", "file names without a folder");
    m.hashes[name] = files.at(name).text();
  }
  for (const std::string& name : options.keys())
    m.options[name] = {options.at(name).at("value").text(), options.at(name).at("source").text()};
  for (const std::string& name : facts.keys()) m.facts[name] = facts.at(name).text();
  return m;
}

}  // namespace sconce
