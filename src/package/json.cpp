// SPDX-License-Identifier: Apache-2.0
#include "package/json.h"

#include <nlohmann/json.hpp>

#include "core/error.h"

namespace sconce {

using Json = nlohmann::ordered_json;

struct JsonValue::Document {
  Json root;
  std::string where;
};

namespace {
const Json& json(const void* value) {
  return *static_cast<const Json*>(value);
}
}  // namespace

JsonValue JsonValue::parse(std::string_view text, const std::string& where) {
  auto document = std::make_shared<Document>();
  document->where = where;
  try {
    document->root = Json::parse(text);
  } catch (const Json::parse_error& e) {
    throw Error(where, "is damaged: no JSON at byte " + std::to_string(e.byte));
  } catch (const Json::exception& e) {
    throw Error(where, std::string("is damaged: ") + e.what());  // a number too large for a double
  }
  JsonValue value;
  value.value_ = &document->root;
  value.document_ = std::move(document);
  return value;
}

void JsonValue::fail(const std::string& what, const std::string& allowed) const {
  throw Error(document_->where, (key_.empty() ? "the document" : key_) + " " + what, allowed);
}

bool JsonValue::has(const std::string& key) const {
  return json(value_).is_object() && json(value_).contains(key);
}

JsonValue JsonValue::at(const std::string& key) const {
  if (!json(value_).is_object()) fail("is no object");
  JsonValue child = *this;
  child.key_ = key_.empty() ? key : key_ + "." + key;
  const auto found = json(value_).find(key);
  if (found == json(value_).end()) child.fail("is missing");
  child.value_ = &*found;
  return child;
}

JsonValue JsonValue::at(std::size_t index) const {
  JsonValue child = *this;
  child.key_ = key_ + "[" + std::to_string(index) + "]";
  if (index >= size()) child.fail("is missing");
  child.value_ = &json(value_)[index];
  return child;
}

std::size_t JsonValue::size() const {
  if (!json(value_).is_array()) fail("is no array");
  return json(value_).size();
}

std::vector<std::string> JsonValue::keys() const {
  if (!json(value_).is_object()) fail("is no object");
  std::vector<std::string> keys;
  for (const auto& [key, value] : json(value_).items()) keys.push_back(key);
  return keys;
}

double JsonValue::number() const {
  if (!json(value_).is_number()) fail("is no number");
  return json(value_).get<double>();
}

int64_t JsonValue::integer(int64_t lowest, int64_t highest) const {
  const Json& v = json(value_);
  const std::string range = std::to_string(lowest) + ".." + std::to_string(highest);
  if (!v.is_number_integer()) fail("is no integer", range);
  const bool huge = v.is_number_unsigned() && v.get<uint64_t>() > static_cast<uint64_t>(INT64_MAX);
  const int64_t n = huge ? 0 : v.get<int64_t>();
  if (huge || n < lowest || n > highest) fail("is " + v.dump(), range);
  return n;
}

std::size_t JsonValue::index(std::size_t count) const {
  if (count == 0) fail("names something that is not there");
  return static_cast<std::size_t>(integer(0, static_cast<int64_t>(count) - 1));
}

bool JsonValue::flag() const {
  if (!json(value_).is_boolean()) fail("is neither true nor false");
  return json(value_).get<bool>();
}

std::string JsonValue::text() const {
  if (!json(value_).is_string()) fail("is no text");
  return json(value_).get<std::string>();
}

Rgb JsonValue::rgb() const {
  if (size() != 3) fail("is no colour", "three numbers");
  return {at(0).real(), at(1).real(), at(2).real()};
}

Vec2 JsonValue::vec2() const {
  if (size() != 2) fail("is no pair", "two numbers");
  return {at(0).real(), at(1).real()};
}

Mat4 JsonValue::matrix() const {
  if (size() != 16) fail("is no matrix", "sixteen numbers");
  Mat4 m;
  for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = at(static_cast<std::size_t>(i)).real();
  return m;
}

double JsonValue::number(const std::string& key, double fallback) const {
  return has(key) ? at(key).number() : fallback;
}
std::string JsonValue::text(const std::string& key, const std::string& fallback) const {
  return has(key) ? at(key).text() : fallback;
}
bool JsonValue::flag(const std::string& key, bool fallback) const {
  return has(key) ? at(key).flag() : fallback;
}

}  // namespace sconce
