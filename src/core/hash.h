// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace sconce {

/// A well-mixed 32-bit permutation (Wellons' "lowbias32" constants).
constexpr uint32_t mix32(uint32_t x) {
  x ^= x >> 16;
  x *= 0x7feb352du;
  x ^= x >> 15;
  x *= 0x846ca68bu;
  x ^= x >> 16;
  return x;
}
constexpr uint32_t mix32(uint32_t a, uint32_t b) {
  return mix32(a ^ mix32(b + 0x9e3779b9u));
}

/// Content hash: XXH3, 128 bits, as 32 hex digits. Append strings, numbers or bytes; order matters.
class ContentHash {
 public:
  ContentHash();
  ~ContentHash();
  ContentHash(const ContentHash&) = delete;
  ContentHash& operator=(const ContentHash&) = delete;

  ContentHash& bytes(const void* data, std::size_t size);
  ContentHash& text(std::string_view s);  ///< length-prefixed
  template <class T>
    requires std::is_trivially_copyable_v<T>
  ContentHash& value(const T& v) {
    return bytes(&v, sizeof v);
  }
  template <class T>
    requires std::is_trivially_copyable_v<T>
  ContentHash& span(std::span<const T> v) {
    value(v.size());
    return bytes(v.data(), v.size_bytes());
  }
  std::string hex() const;

 private:
  void* state_;
};

std::string hash_hex(std::string_view bytes);
/// @throws Error when the file cannot be read
std::string hash_file(const std::filesystem::path& path);

}  // namespace sconce
