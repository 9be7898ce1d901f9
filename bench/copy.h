// SPDX-License-Identifier: Apache-2.0
// What work that memory bounds is measured against: a copy on the same threads in the same run.
#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <vector>

#include "core/parallel.h"

/// Seconds that `work` takes.
template <class Work>
double seconds_of(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Bytes read and written per second by a copy on all threads: what "memory bandwidth" means here. The best
/// of some rounds.
inline double copy_bandwidth() {
  static const double measured = [] {
    constexpr std::size_t kChunk = 1 << 18, kChunks = 1024;  // larger than caches of hundreds of megabytes
    const std::vector<char> from(kChunk * kChunks, 1);
    std::vector<char> to(from.size());
    double best = 0;
    for (int round = 0; round < 16; ++round) {
      const double seconds = seconds_of([&] {
        sconce::parallel_for(kChunks, 4,
                             [&](std::size_t i) { std::memcpy(&to[i * kChunk], &from[i * kChunk], kChunk); });
      });
      best = std::max(best, 2.0 * static_cast<double>(from.size()) / seconds);
    }
    return best;
  }();
  return measured;
}

/// Runs `work` as often as the benchmark wants and reports its best round.
/// @param moved  bytes that the work cannot avoid
template <class Work>
void measure(benchmark::State& state, double moved, const Work& work) {
  const double bandwidth = copy_bandwidth();
  double best = 1e9;
  for (auto _ : state) best = std::min(best, seconds_of(work));
  state.counters["best ms"] = best * 1e3;
  state.counters["GB/s"] = moved / best / 1e9;
  state.counters["copy GB/s"] = bandwidth / 1e9;
  state.counters["x copy time"] = best * bandwidth / moved;
}
