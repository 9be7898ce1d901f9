// SPDX-License-Identifier: Apache-2.0
// Faders moved, picture shown: 1920 x 1080 from cached camera hits, 16 groups in halves, all on the CPU.
#include <random>

#include "copy.h"
#include "encode/half.h"
#include "layers.h"
#include "mix/tone_lightmap.h"
#include "picture/show.h"

using namespace sconce;

namespace {

constexpr std::size_t kGroups = 16;
constexpr int kWidth = 1920, kHeight = 1080;

/// Surfaces of 80 x 72 pixels, each a chart that lies anywhere in the page and any way round, about two
/// pixels per texel each way; every fiftieth surface is a lamp.
CameraHits make_hits(int side) {
  CameraHits hits;
  hits.width = kWidth, hits.height = kHeight;
  hits.pages = 1, hits.page_width = hits.page_height = side;
  hits.groups = kGroups;
  hits.pixels.resize(std::size_t{kWidth} * kHeight);
  constexpr int kAcross = 80, kDown = 72;
  struct Chart {
    float x, y, cosine, sine, albedo;
    bool lamp;
  };
  std::mt19937 random(1);
  const auto next = [&] { return static_cast<float>(random() % 10000) / 10000; };
  std::vector<Chart> charts;
  for (int i = 0; i < (kWidth / kAcross) * (kHeight / kDown); ++i) {
    const float turn = 2 * kPi * next();
    charts.push_back({(0.05f + 0.9f * next()) * static_cast<float>(side),
                      (0.05f + 0.9f * next()) * static_cast<float>(side), 0.5f * std::cos(turn),
                      0.5f * std::sin(turn), 0.3f * next(), i % 50 == 7});
  }
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const Chart& chart = charts[static_cast<std::size_t>((y / kDown) * (kWidth / kAcross) + x / kAcross)];
      const auto u = static_cast<float>(x % kAcross), v = static_cast<float>(y % kDown);
      const float at_x =
          std::clamp(chart.x + chart.cosine * u - chart.sine * v, 0.0f, static_cast<float>(side) - 1.01f);
      const float at_y =
          std::clamp(chart.y + chart.sine * u + chart.cosine * v, 0.0f, static_cast<float>(side) - 1.01f);
      CameraHits::Pixel& pixel = hits.pixels[static_cast<std::size_t>(y * kWidth + x)];
      pixel.texel = static_cast<uint32_t>(at_y) * static_cast<uint32_t>(side) + static_cast<uint32_t>(at_x);
      pixel.place = {static_cast<uint16_t>((at_x - std::floor(at_x)) * CameraHits::kWhole),
                     static_cast<uint16_t>((at_y - std::floor(at_y)) * CameraHits::kWhole)};
      pixel.albedo.fill(float_to_half(chart.albedo));
      if (chart.lamp) hits.shines.push_back({static_cast<uint32_t>(x), Id<LightGroup>(3), Rgb(2)});
    }
    hits.row_end.push_back(hits.shines.size());
  }
  return hits;
}

/// Bytes of the mixed page that the picture reads.
double seen_bytes(const CameraHits& hits) {
  std::vector<bool> seen(static_cast<std::size_t>(hits.page_width) *
                         static_cast<std::size_t>(hits.page_height));
  const auto below = static_cast<std::size_t>(hits.page_width);
  for (const CameraHits::Pixel& p : hits.pixels)
    for (const std::size_t at : {std::size_t{0}, std::size_t{1}, below, below + 1}) seen[p.texel + at] = true;
  return 12.0 * static_cast<double>(std::count(seen.begin(), seen.end(), true));
}

/// The picture alone: hits and texels read once, codes written once.
double show_bytes(const CameraHits& hits) {
  return static_cast<double>(hits.bytes()) + seen_bytes(hits) + 3.0 * kWidth * kHeight;
}

ToneCodes tone(const char* curve) {
  return ToneCodes(auto_exposure(1, 40), find_tone_mapper(curve));
}

void show_only(benchmark::State& state, const char* curve) {
  const int side = static_cast<int>(state.range(0));
  const CameraHits hits = make_hits(side);
  Mixer mixer = make_mixer(1, find_encoding("f16"), side);
  const std::vector<Image>& pages = mixer.mix(make_weights(1, 1));
  const MixSpec mix = make_weights(kGroups, 1);
  const ToneCodes codes = tone(curve);
  measure(state, show_bytes(hits),
          [&] { benchmark::DoNotOptimize(show(hits, mix, pages, codes).data.data()); });
}

/// @param moved  faders that move for each picture
void faders(benchmark::State& state, std::size_t moved) {
  const int side = static_cast<int>(state.range(0));
  const CameraHits hits = make_hits(side);
  Mixer mixer = make_mixer(kGroups, find_encoding("f16"), side);
  MixSpec mix = make_weights(kGroups, 1);
  mixer.mix(mix);
  const double texels = static_cast<double>(side) * side;
  const double mix_bytes =
      static_cast<double>(mixer.bytes() * moved / kGroups) + (moved == kGroups ? 12.0 : 24.0) * texels;
  const ToneCodes codes = tone("agx");
  measure(state, mix_bytes + show_bytes(hits), [&] {
    for (std::size_t g = 0; g < moved; ++g) mix.weights[g] = mix.weights[g] * 1.001f;
    benchmark::DoNotOptimize(show(hits, mix, mixer.mix(mix), codes).data.data());
  });
}

/// System A's fallback: four groups combined and tone mapped into an 8-bit lightmap.
void fallback(benchmark::State& state) {
  const int side = static_cast<int>(state.range(0));
  Mixer mixer = make_mixer(4, find_encoding("f16"), side);
  MixSpec mix = make_weights(4, 1);
  const double texels = static_cast<double>(side) * side;
  measure(state, static_cast<double>(mixer.bytes()) + (24.0 + 3.0) * texels, [&] {
    for (Rgb& w : mix.weights) w = w * 1.001f;
    const auto codes = tone_lightmap(mixer.mix(mix), auto_exposure(1, 40), find_tone_mapper("drago2006"));
    benchmark::DoNotOptimize(codes.front().data.data());
  });
}

void setting(benchmark::internal::Benchmark* b) {
  b->ArgName("atlas")->Arg(1024)->Arg(2048)->UseRealTime()->MeasureProcessCPUTime()->Unit(
      benchmark::kMillisecond);
}

}  // namespace

BENCHMARK_CAPTURE(show_only, agx, "agx")->Apply(setting);
BENCHMARK_CAPTURE(show_only, drago, "drago")->Apply(setting);
BENCHMARK_CAPTURE(show_only, neutral, "neutral")->Apply(setting);
BENCHMARK_CAPTURE(faders, one, 1)->Apply(setting);
BENCHMARK_CAPTURE(faders, all, kGroups)->Apply(setting);
BENCHMARK(fallback)->Apply(setting);
