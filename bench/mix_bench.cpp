// SPDX-License-Identifier: Apache-2.0
// The software mix against the memory bandwidth of the same machine in the same run: a fader can be no faster
// than memory, since the layers are larger than any cache.
#include "copy.h"
#include "layers.h"

using namespace sconce;

namespace {

constexpr int kSide = 2048;

/// Everything anew: every code read once, the sum written once.
void mix_all(benchmark::State& state, const char* encoding) {
  const auto groups = static_cast<std::size_t>(state.range(0));
  Mixer mixer = make_mixer(groups, find_encoding(encoding), kSide);
  MixSpec mix = make_weights(groups, 1);
  measure(state, static_cast<double>(mixer.bytes()) + 12.0 * kSide * kSide, [&] {
    // All weights differ from the last call's, so all is read.
    for (Rgb& w : mix.weights) w = w * 1.001f;
    benchmark::DoNotOptimize(mixer.mix(mix).front().data.data());
  });
}

/// One fader: its codes read once, the sum read and written, however many groups there are.
void mix_one(benchmark::State& state) {
  const auto groups = static_cast<std::size_t>(state.range(0));
  Mixer mixer = make_mixer(groups, find_encoding("f16"), kSide);
  MixSpec mix = make_weights(groups, 1);
  mixer.mix(mix);
  measure(state, static_cast<double>(mixer.bytes()) / static_cast<double>(groups) + 24.0 * kSide * kSide,
          [&] {
            mix.weights[0] = mix.weights[0] * 1.001f;
            benchmark::DoNotOptimize(mixer.mix(mix).front().data.data());
          });
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
