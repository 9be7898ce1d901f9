// SPDX-License-Identifier: Apache-2.0
// Strict reading of JSON: whatever is missing or of another type is an Error that names the file and the key.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/rgb.h"
#include "core/vec.h"

namespace sconce {

/// A value inside a parsed document, which it keeps alive. Every accessor throws Error(file, "KEY is ...").
class JsonValue {
 public:
  /// @throws Error naming `where` and the position when `text` is no JSON
  static JsonValue parse(std::string_view text, const std::string& where);

  bool has(const std::string& key) const;
  JsonValue at(const std::string& key) const;
  JsonValue at(std::size_t index) const;
  /// Number of elements; @throws Error when this is no array
  std::size_t size() const;
  /// Keys in the file's order; @throws Error when this is no object
  std::vector<std::string> keys() const;

  double number() const;
  float real() const { return static_cast<float>(number()); }
  int64_t integer(int64_t lowest, int64_t highest) const;
  /// An index below `count`.
  std::size_t index(std::size_t count) const;
  bool flag() const;
  std::string text() const;
  Rgb rgb() const;
  Vec2 vec2() const;
  Mat4 matrix() const;  ///< 16 numbers, column-major

  double number(const std::string& key, double fallback) const;
  std::string text(const std::string& key, const std::string& fallback) const;
  bool flag(const std::string& key, bool fallback) const;

  /// An Error about this value.
  [[noreturn]] void fail(const std::string& what, const std::string& allowed = {}) const;

 private:
  struct Document;
  std::shared_ptr<const Document> document_;
  const void* value_ = nullptr;
  std::string key_;
};

}  // namespace sconce
