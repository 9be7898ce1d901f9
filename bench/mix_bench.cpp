// SPDX-License-Identifier: Apache-2.0
// The software mix against the memory bandwidth of the same machine in the same run: a fader can be no faster
// than memory, since the layers are larger than any cache.
#include "copy.h"
#include "layers.h"
#include "mix/light_meter.h"
#include "package/test_package.h"

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

/// What automatic exposure adds to every fader move: the sum read once, and a texel's albedo, weight and
/// place.
void meter_mixed(benchmark::State& state) {
  const auto side = static_cast<int>(state.range(0));
  const TemporaryFolder folder;
  write_package(folder / "quad.sconce", test_package(1, 1, side, side));
  const Package package = Package::open(folder / "quad.sconce");
  const MixSpec mix = make_weights(1, 1);
  const LightMeter meter(package, package.scene());
  const std::vector<Image> mixed{make_layer(0, side, side)};
  measure(state, 32.0 * side * side, [&] { benchmark::DoNotOptimize(meter(mix, mixed)); });
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
BENCHMARK(meter_mixed)->ArgName("side")->Arg(1024)->UseRealTime()->Unit(benchmark::kMillisecond);
