// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>

namespace sconce {

/// Limits the worker threads of every parallel_for inside its lifetime. 0 = all of the machine.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;
  static int current();

 private:
  void* control_;
};

/// Calls f(i) for i in [0, n), in any order, on the machine's threads; rethrows the first exception.
/// Results go into slots indexed by i and are folded in order afterwards, so any thread count gives the same
/// bits.
/// @param grain  indices handed out at a time
void parallel_for(std::size_t n, std::size_t grain, const std::function<void(std::size_t)>& f);

}  // namespace sconce
