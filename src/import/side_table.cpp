// SPDX-License-Identifier: Apache-2.0
#include "import/side_table.h"

#include <algorithm>

#include "core/error.h"
#include "core/files.h"
#include "core/kelvin.h"
#include "core/text.h"
#include "core/toml.h"

namespace sconce {

namespace {

/// Words of a command line stand in no line.
std::string place(const std::string& file, const SideNode& node) {
  return node.line > 0 ? file + ":" + std::to_string(node.line) : file;
}

SideNode convert(const toml::node& node, const std::string& file) {
  SideNode out;
  out.line = static_cast<int>(node.source().begin.line);
  if (const auto* table = node.as_table()) {
    SideNode::Table items;
    for (const auto& [key, value] : *table) {
      SideNode item = convert(value, file);
      item.line = static_cast<int>(key.source().begin.line);
      items.push_back({std::string(key.str()), std::move(item)});
    }
    out.value = std::move(items);
  } else if (const auto* array = node.as_array()) {
    SideNode::Array items;
    for (const auto& value : *array) items.push_back(convert(value, file));
    out.value = std::move(items);
  } else if (const auto flag = node.as_boolean()) {
    out.value = flag->get();
  } else if (const auto text = node.as_string()) {
    out.value = text->get();
  } else if (const auto number = node.value<double>()) {
    out.value = *number;
  } else {
    throw Error(file + ":" + std::to_string(out.line), "dates and times mean nothing here",
                "numbers, strings, true, false, arrays, tables");
  }
  return out;
}

}  // namespace

const SideNode* SideNode::find(std::string_view key) const {
  const auto* table = std::get_if<Table>(&value);
  if (table == nullptr) return nullptr;
  for (const auto& [name, node] : *table)
    if (name == key) return &node;
  return nullptr;
}

SideNode parse_side_file(const std::filesystem::path& path) {
  const std::string text = read_file(path);
  try {
    return convert(toml::parse(text, path.string()), path.string());
  } catch (const toml::parse_error& e) {
    throw Error(path.string() + ":" + std::to_string(e.source().begin.line), std::string(e.description()));
  }
}

SideTable::SideTable(std::string file, std::string title, const SideNode& node,
                     std::vector<std::string> allowed)
    : file_(std::move(file)), title_(std::move(title)), node_(node) {
  const auto* table = std::get_if<SideNode::Table>(&node.value);
  if (table == nullptr) throw Error(where(), title_ + " is no table", title_);
  for (const auto& [key, value] : *table) {
    if (std::find(allowed.begin(), allowed.end(), key) != allowed.end()) continue;
    throw Error(place(file_, value), "unknown key '" + key + "' in " + title_ + did_you_mean(key, allowed),
                join(allowed, ", "));
  }
}

std::string SideTable::where(std::string_view key) const {
  const SideNode* item = key.empty() ? nullptr : node_.find(key);
  const std::string at = place(file_, item != nullptr ? *item : node_) + ": " + title_;
  return key.empty() ? at : at + " " + std::string(key);
}

void SideTable::fail(std::string_view key, const std::string& what, const std::string& allowed) const {
  throw Error(where(key), what, allowed);
}

std::optional<double> SideTable::number(std::string_view key) const {
  const SideNode* item = node_.find(key);
  if (item == nullptr) return std::nullopt;
  const double* value = std::get_if<double>(&item->value);
  if (value == nullptr || !std::isfinite(*value)) fail(key, "is no number");
  return *value;
}

std::optional<double> SideTable::positive(std::string_view key) const {
  const auto value = number(key);
  if (value && !(*value > 0)) fail(key, "is not positive", "a number > 0");
  return value;
}

std::optional<double> SideTable::not_negative(std::string_view key) const {
  const auto value = number(key);
  if (value && *value < 0) fail(key, "is negative", "a number >= 0");
  return value;
}

std::optional<std::string> SideTable::text(std::string_view key) const {
  const SideNode* item = node_.find(key);
  if (item == nullptr) return std::nullopt;
  const auto* value = std::get_if<std::string>(&item->value);
  if (value == nullptr || value->empty()) fail(key, "is no text", "\"...\"");
  return *value;
}

std::optional<bool> SideTable::flag(std::string_view key) const {
  const SideNode* item = node_.find(key);
  if (item == nullptr) return std::nullopt;
  const bool* value = std::get_if<bool>(&item->value);
  if (value == nullptr) fail(key, "is neither true nor false", "true, false");
  return *value;
}

std::optional<std::array<double, 2>> SideTable::pair(std::string_view key) const {
  const SideNode* item = node_.find(key);
  if (item == nullptr) return std::nullopt;
  const auto* array = std::get_if<SideNode::Array>(&item->value);
  if (array == nullptr || array->size() != 2) fail(key, "is no pair", "[x, z]");
  std::array<double, 2> out{};
  for (std::size_t i = 0; i < 2; ++i) {
    const double* v = std::get_if<double>(&(*array)[i].value);
    if (v == nullptr || !std::isfinite(*v)) fail(key, "holds something that is no number", "[x, z]");
    out[i] = *v;
  }
  return out;
}

std::optional<Vec3> SideTable::vector(std::string_view key) const {
  const SideNode* item = node_.find(key);
  if (item == nullptr) return std::nullopt;
  const auto* array = std::get_if<SideNode::Array>(&item->value);
  if (array == nullptr || array->size() != 3) fail(key, "is no triple", "[x, y, z]");
  Vec3 out;
  for (int i = 0; i < 3; ++i) {
    const double* v = std::get_if<double>(&(*array)[static_cast<std::size_t>(i)].value);
    if (v == nullptr || !std::isfinite(*v)) fail(key, "holds something that is no number", "[x, y, z]");
    out[i] = static_cast<float>(*v);
  }
  return out;
}

std::vector<std::string> SideTable::list(std::string_view key) const {
  const SideNode* item = node_.find(key);
  if (item == nullptr) return {};
  if (const auto* one = std::get_if<std::string>(&item->value)) return {*one};
  const auto* array = std::get_if<SideNode::Array>(&item->value);
  if (array == nullptr) fail(key, "is no list", "[\"name\", \"glob*\"]");
  std::vector<std::string> out;
  for (const SideNode& entry : *array) {
    const auto* name = std::get_if<std::string>(&entry.value);
    if (name == nullptr) fail(key, "holds something that is no text", "[\"name\", \"glob*\"]");
    out.push_back(*name);
  }
  return out;
}

std::optional<Rgb> SideTable::color(std::string_view key) const {
  const SideNode* item = node_.find(key);
  if (item == nullptr) return std::nullopt;
  const char* allowed = "\"#rrggbb\" (sRGB) or [r, g, b] (linear, not negative)";
  if (const auto* hex = std::get_if<std::string>(&item->value)) {
    const bool shaped = hex->size() == 7 && hex->front() == '#' &&
                        hex->find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos;
    if (!shaped) fail(key, "'" + *hex + "' is no colour", allowed);
    const auto channel = [&](std::size_t at) {
      return srgb_to_linear(static_cast<float>(std::stoi(hex->substr(at, 2), nullptr, 16)) / 255.0f);
    };
    return Rgb(channel(1), channel(3), channel(5));
  }
  const auto* array = std::get_if<SideNode::Array>(&item->value);
  if (array == nullptr || array->size() != 3) fail(key, "is no colour", allowed);
  const Vec3 v = *vector(key);
  if (v.x < 0 || v.y < 0 || v.z < 0) fail(key, "is negative", allowed);
  return Rgb(v.x, v.y, v.z);
}

std::optional<Rgb> SideTable::lamp_color() const {
  if (has("color") && has("kelvin")) fail("kelvin", "stands beside color", "one of the two");
  if (const auto kelvin = number("kelvin")) {
    if (*kelvin < kKelvinMin || *kelvin > kKelvinMax) fail("kelvin", "is out of range", "1000 to 11000");
    return kelvin_color(*kelvin);
  }
  const auto given = color("color");
  if (!given) return std::nullopt;
  const float y = luminance(*given);
  if (!(y > 0)) fail("color", "is black", "a colour; for a lamp that is off use intensity = 0");
  return *given / y;
}

}  // namespace sconce
