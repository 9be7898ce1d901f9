// SPDX-License-Identifier: Apache-2.0
// The software mix against the memory bandwidth of the same machine in the same run: a fader can be no faster
// than memory, since the layers are larger than any cache.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>

#include "core/parallel.h"
#include "mix/mixer.h"

using namespace sconce;

namespace {

constexpr int kSide = 2048;

/// Smooth light that differs by group.
EncodedImage make_layer(std::size_t group, const Encoding& encoding) {
  Image image = Image::rgb(kSide, kSide);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x)
      image.set_rgb(x, y,
                    Rgb(1.5f + std::sin(0.01f * static_cast<float>(x + y) + static_cast<float>(group))));
  return encode(image, encoding);
}

Mixer make_mixer(std::size_t groups, const Encoding& encoding) {
  std::vector<LayerTexture> textures;
  std::vector<std::vector<EncodedImage>> pages;
  for (std::size_t g = 0; g < groups; ++g) {
    textures.push_back({{&encoding, false}, {g}, {}});
    pages.push_back({make_layer(g, encoding)});
  }
  return Mixer(std::move(textures), std::move(pages), std::vector<Rgb>(groups, Rgb(1)));
}

/// Bytes read and written per second by a copy on all threads: what "memory bandwidth" means here. The best
/// of some rounds.
double copy_bandwidth() {
  static const double measured = [] {
    constexpr std::size_t kChunk = 1 << 18, kChunks = 256;
    const std::vector<char> from(kChunk * kChunks, 1);
    std::vector<char> to(from.size());
    double best = 0;
    for (int round = 0; round < 16; ++round) {
      const auto start = std::chrono::steady_clock::now();
      parallel_for(kChunks, 4,
                   [&](std::size_t i) { std::memcpy(&to[i * kChunk], &from[i * kChunk], kChunk); });
      const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
      best = std::max(best, 2.0 * static_cast<double>(from.size()) / took.count());
    }
    return best;
  }();
  return measured;
}

MixSpec weights(std::size_t groups, float shift) {
  MixSpec mix;
  for (std::size_t g = 0; g < groups; ++g)
    mix.weights.emplace_back(shift + static_cast<float>(g), 1.0f, 0.5f);
  return mix;
}

/// @param moved  bytes that the work cannot avoid
void report(benchmark::State& state, double seconds, double moved) {
  state.counters["GB/s"] = moved / seconds / 1e9;
  state.counters["copy GB/s"] = copy_bandwidth() / 1e9;
  state.counters["x copy time"] = seconds * copy_bandwidth() / moved;
}

/// Everything anew: every code read once, the sum written once.
void mix_all(benchmark::State& state, const char* encoding) {
  const auto groups = static_cast<std::size_t>(state.range(0));
  Mixer mixer = make_mixer(groups, find_encoding(encoding));
  const double moved = static_cast<double>(mixer.bytes()) + 12.0 * kSide * kSide;
  copy_bandwidth();
  double best = 1e9;
  float shift = 0;
  for (auto _ : state) {
    const MixSpec mix = weights(groups, shift += 0.25f);
    // All weights differ from the last call's, so all is read.
    MixSpec other = mix;
    for (Rgb& w : other.weights) w = w * 0.5f;
    const auto start = std::chrono::steady_clock::now();
    benchmark::DoNotOptimize(mixer.mix(other).front().data.data());
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  report(state, best, moved);
}

/// One fader: its codes read once, the sum read and written, however many groups there are.
void mix_one(benchmark::State& state) {
  const auto groups = static_cast<std::size_t>(state.range(0));
  Mixer mixer = make_mixer(groups, find_encoding("f16"));
  MixSpec mix = weights(groups, 1);
  mixer.mix(mix);
  const double moved =
      static_cast<double>(mixer.bytes()) / static_cast<double>(groups) + 24.0 * kSide * kSide;
  double best = 1e9;
  for (auto _ : state) {
    mix.weights[0] = mix.weights[0] * 1.001f;
    const auto start = std::chrono::steady_clock::now();
    benchmark::DoNotOptimize(mixer.mix(mix).front().data.data());
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  report(state, best, moved);
}

}  // namespace

BENCHMARK_CAPTURE(mix_all, f16, "f16")
    ->ArgName("groups")
    ->Arg(4)
    ->Arg(16)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(mix_all, f32, "f32")
    ->ArgName("groups")
    ->Arg(4)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(mix_all, exp8, "exp8")
    ->ArgName("groups")
    ->Arg(4)
    ->Arg(16)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(mix_all, rgbe8, "rgbe8")
    ->ArgName("groups")
    ->Arg(4)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(mix_all, multi8, "multi8")
    ->ArgName("groups")
    ->Arg(4)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(mix_one)->ArgName("groups")->Arg(4)->Arg(16)->UseRealTime()->Unit(benchmark::kMillisecond);
