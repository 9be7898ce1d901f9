// SPDX-License-Identifier: Apache-2.0
// The weighted sum of float layers against the memory bandwidth of the same machine in the same run. The
// layers are larger than any cache, so that a fader can be no faster than memory.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>

#include "core/parallel.h"
#include "mix/accumulate.h"

using namespace sconce;

namespace {

constexpr int kWidth = 2048, kHeight = 1024;  ///< 25 MB a layer
constexpr std::size_t kMostLayers = 16;

Image make_layer(float value) {
  Image image = Image::rgb(kWidth, kHeight);
  for (std::size_t i = 0; i < image.data.size(); ++i)
    image.data[i] = value + 1e-3f * static_cast<float>(i % 1000);
  return image;
}

const std::vector<Image>& layers() {
  static const std::vector<Image> made = [] {
    std::vector<Image> all;
    for (std::size_t i = 0; i < kMostLayers; ++i) all.push_back(make_layer(static_cast<float>(i)));
    return all;
  }();
  return made;
}

/// One layer copied on all threads.
void copy_layer(const Image& from, Image& to) {
  constexpr std::size_t kRows = 64;
  const std::size_t chunk = kRows * kWidth * 3;
  parallel_for(kHeight / kRows, 1, [&](std::size_t i) {
    std::memcpy(&to.data[i * chunk], &from.data[i * chunk], chunk * sizeof(float));
  });
}

/// Bytes read and written per second by a copy: what "memory bandwidth" means here. The best of some rounds.
double copy_bandwidth() {
  static const double measured = [] {
    Image to = make_layer(0);
    double best = 0;
    for (std::size_t i = 0; i < 2 * kMostLayers; ++i) {
      const auto start = std::chrono::steady_clock::now();
      copy_layer(layers()[i % kMostLayers], to);
      const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
      best = std::max(best, 2.0 * static_cast<double>(to.data.size() * sizeof(float)) / took.count());
    }
    return best;
  }();
  return measured;
}

/// Bytes a mix cannot avoid: every layer read once, the sum written once.
void mix(benchmark::State& state) {
  const auto count = static_cast<std::size_t>(state.range(0));
  const double copy = copy_bandwidth();
  const std::array<std::size_t, 3> channels{0, 1, 2};
  Image sum = Image::rgb(kWidth, kHeight);
  const auto start = std::chrono::steady_clock::now();
  for (auto _ : state) {
    std::fill(sum.data.begin(), sum.data.end(), 0.0f);
    for (std::size_t i = 0; i < count; ++i) {
      const float w = 0.1f * static_cast<float>(i + 1);
      accumulate(sum, Rgb(w, 0.9f * w, 0.8f * w), layers()[i], channels);
    }
    benchmark::DoNotOptimize(sum.data.data());
  }
  const std::chrono::duration<double> all = std::chrono::steady_clock::now() - start;
  const double seconds = all.count() / static_cast<double>(state.iterations());
  const double bandwidth = static_cast<double>((count + 1) * sum.data.size() * sizeof(float)) / seconds;
  state.counters["GB/s"] = bandwidth / 1e9;
  state.counters["copy GB/s"] = copy / 1e9;
  state.counters["share of copy"] = bandwidth / copy;
  state.counters["ms/Mtexel"] = seconds * 1e3 / (static_cast<double>(sum.pixels()) / 1e6);
}

}  // namespace

BENCHMARK(mix)->ArgName("layers")->Arg(4)->Arg(16)->UseRealTime()->Unit(benchmark::kMillisecond);
