// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sconce {

/// A span as bytes, and back: takes `to.size()` values off the front.
template <class T>
void put_span(std::string& bytes, std::span<const T> values) {
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
}
template <class T>
void take_span(std::string_view& bytes, std::span<T> to) {
  std::memcpy(to.data(), bytes.data(), to.size_bytes());
  bytes.remove_prefix(to.size_bytes());
}

/// The same with the number of values before them.
template <class T>
void put_vector(std::string& bytes, const std::vector<T>& values) {
  const uint64_t size = values.size();
  put_span(bytes, std::span(&size, 1));
  put_span(bytes, std::span<const T>(values));
}
template <class T>
void take_vector(std::string_view& bytes, std::vector<T>& values) {
  uint64_t size = 0;
  take_span(bytes, std::span(&size, 1));
  values.resize(size);
  take_span(bytes, std::span(values));
}

/// Processes that work on one job, each with all of its input. Passed in, never global; the default is one
/// process alone.
struct Ranks {
  int index = 0, count = 1;
  /// Everybody's bytes in the order of ranks, to everybody. All ranks must call it, equally often; waits for
  /// the last. @throws Error when a rank is lost, Cancelled
  std::function<std::vector<std::string>(std::string_view mine)> allgather;

  bool mine(std::size_t item) const {
    return item % static_cast<std::size_t>(count) == static_cast<std::size_t>(index);
  }
  /// Blocks of work that were done by mine(), `pack` writing one as bytes and `unpack` taking it off the
  /// front: afterwards every rank has all of them.
  template <class Pack, class Unpack>
  void share(std::size_t blocks, const Pack& pack, const Unpack& unpack) const {
    if (count == 1) return;
    std::string bytes;
    for (std::size_t block = 0; block < blocks; ++block)
      if (mine(block)) pack(block, bytes);
    const std::vector<std::string> all = allgather(bytes);
    std::vector<std::string_view> left(all.begin(), all.end());
    for (std::size_t block = 0; block < blocks; ++block)
      if (!mine(block)) unpack(block, left[block % static_cast<std::size_t>(count)]);
  }
  /// The same for plain values, so many to a block.
  template <class T>
  void share(std::span<T> values, std::size_t per_block) const {
    if (values.empty()) return;
    const auto part = [&](std::size_t block) {
      return values.subspan(block * per_block, std::min(per_block, values.size() - block * per_block));
    };
    share((values.size() + per_block - 1) / per_block,
          [&](std::size_t block, std::string& bytes) { put_span<T>(bytes, part(block)); },
          [&](std::size_t block, std::string_view& bytes) { take_span<T>(bytes, part(block)); });
  }
};

}  // namespace sconce
