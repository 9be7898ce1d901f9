// SPDX-License-Identifier: Apache-2.0
// The software mix: by vectors as plainly, for every encoding; faders moved one by one as all at once.
#include "mix/mixer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/error.h"
#include "core/parallel.h"
#include "mix/mix.h"
#include "package/test_package.h"

namespace sconce {
namespace {

/// Smooth light over 1:400,000, negative in places where the encoding is signed.
Image test_layer(int width, int height, int channels, const Encoding& e) {
  Image image(width, height, std::vector<std::string>(static_cast<std::size_t>(channels), "c"));
  for (std::size_t i = 0; i < image.data.size(); ++i) {
    const double t = static_cast<double>(i) / static_cast<double>(image.data.size());
    image.data[i] =
        static_cast<float>(3000 * std::pow(400000.0, t - 1) * (1.5 + std::sin(static_cast<double>(i))));
    if (e.is_signed && i % 7 == 3) image.data[i] *= -1;
  }
  return image;
}

TEST(Weigh, VectorsEqualThePlainSum) {
  for (const Encoding& e : encodings())
    for (const bool luminance : {false, true})
      for (int channels = luminance ? 1 : 3; channels <= (luminance ? 4 : 3); ++channels) {
        if (e.type == TexelType::bc6h || (luminance && !e.per_channel)) continue;
        SCOPED_TRACE(std::string(e.name) + " " + std::to_string(channels));
        const EncodedImage texture =
            encode(test_layer(37, 12, channels, e), e);  // no whole number of vectors
        std::vector<Rgb> weights;
        for (int c = 0; c < (luminance ? channels : 1); ++c)
          weights.emplace_back(0.5f + static_cast<float>(c), -0.25f, 1.75f);
        std::vector<float> fast(37 * 8 * 3, 1), plain = fast;
        const WeighTables tables(e);
        // More than go together in one pass, and not a whole number of passes.
        const std::vector<Weighted> terms(6, {tables, texture, weights, luminance});
        add_weighted(terms, 4, 8, fast.data());
        for (std::size_t i = 0; i < terms.size(); ++i)
          add_weighted_plain(texture, 4, 8, weights, luminance, plain.data());
        for (std::size_t i = 0; i < fast.size(); ++i)
          ASSERT_NEAR(fast[i], plain[i], 2e-6f * (1 + std::abs(plain[i]))) << i;
      }
}

PackageContents six_encodings() {
  PackageContents c = test_package(8, 2, 21, 13);
  c.encodings = {"f16", "f32", "lum:f16", "exp8", "lum:f16", "rgbe8", "multi8", "bc6h"};
  c.manifest.groups[2].color = Rgb(1, 2, 3) * (1 / luminance(Rgb(1, 2, 3)));
  return c;
}

MixSpec random_mix(std::mt19937& random, std::size_t groups) {
  MixSpec mix;
  for (std::size_t g = 0; g < groups; ++g)
    mix.weights.emplace_back(static_cast<float>(random() % 256) / 64, static_cast<float>(random() % 256) / 64,
                             static_cast<float>(random() % 256) / 64);
  return mix;
}

TEST(Mixer, EqualsTheReferenceMix) {
  const TemporaryFolder folder;
  write_package(folder / "x.sconce", six_encodings());
  const Package package = Package::open(folder / "x.sconce");
  Mixer mixer(package);
  std::mt19937 random(1);
  for (int round = 0; round < 5; ++round) {
    const MixSpec mix = random_mix(random, 8);
    const std::vector<Image> expected = mix_pages(package, mix);
    const std::vector<Image>& got = mixer.mix(mix);
    ASSERT_EQ(got.size(), 2u);
    for (std::size_t p = 0; p < 2; ++p)
      for (std::size_t i = 0; i < got[p].data.size(); ++i)
        ASSERT_NEAR(got[p].data[i], expected[p].data[i], 1e-5f * (1 + std::abs(expected[p].data[i])));
  }
  EXPECT_EQ(mixer.mix({std::vector<Rgb>(8)})[0].data, std::vector<float>(21 * 13 * 3, 0.0f))
      << "all off is black";
  EXPECT_THROW(mixer.mix({std::vector<Rgb>(3)}), Error);
}

/// One fader reads one texture, however many groups there are (test 27 of methods.md).
TEST(Mixer, TenThousandMovesDoNotDrift) {
  const TemporaryFolder folder;
  write_package(folder / "x.sconce", six_encodings());
  const Package package = Package::open(folder / "x.sconce");
  Mixer moved(package);
  std::mt19937 random(2);
  MixSpec mix = random_mix(random, 8);
  moved.mix(mix);
  EXPECT_EQ(moved.bytes_read(), moved.bytes());
  std::size_t least = moved.bytes();
  for (int move = 0; move < 10000; ++move) {
    mix.weights[random() % 8] = random_mix(random, 1).weights[0];
    moved.mix(mix);
    least = std::min(least, moved.bytes_read());
  }
  EXPECT_LT(least, moved.bytes() / 8);
  Mixer fresh(package);
  const std::vector<Image>&a = moved.mix(mix), &b = fresh.mix(mix);
  for (std::size_t p = 0; p < 2; ++p)
    for (std::size_t i = 0; i < a[p].data.size(); ++i)
      ASSERT_NEAR(a[p].data[i], b[p].data[i], 1e-4f * (1 + std::abs(b[p].data[i])));
}

TEST(Mixer, SameBitsAtAnyNumberOfThreads) {
  const TemporaryFolder folder;
  write_package(folder / "x.sconce", six_encodings());
  const Package package = Package::open(folder / "x.sconce");
  std::vector<std::vector<float>> results;
  for (const int threads : {1, 2, 0}) {
    const ThreadLimit limit(threads);
    Mixer mixer(package);
    std::mt19937 random(3);
    MixSpec mix = random_mix(random, 8);
    mixer.mix(mix);
    mix.weights[3] = Rgb(2, 1, 0);
    results.push_back(mixer.mix(mix)[1].data);
  }
  EXPECT_EQ(results[0], results[1]);
  EXPECT_EQ(results[0], results[2]);
}

/// A single group at weight 1 in full floats is what was baked, bit for bit.
TEST(Mixer, OneGroupIsItsLayer) {
  const TemporaryFolder folder;
  const PackageContents c = test_package(1, 1, 21, 13);
  write_package(folder / "x.sconce", c);
  Mixer mixer(Package::open(folder / "x.sconce"));
  EXPECT_EQ(mixer.mix({{Rgb(1)}})[0].data, c.layers[0][0].data);
}

TEST(EncodedLayers, LayersByVectorsAreThePlainOnes) {
  const std::vector<Rgb> colors{Rgb(0.5f, 1, 2), Rgb(1.2f, 1, 0.4f), Rgb(1)};
  for (const char* name : {"f32", "f16", "exp8", "rgbe8", "srgbe8", "bc6h", "lum:f16", "lum:multi8"}) {
    SCOPED_TRACE(name);
    const EncodingChoice choice = parse_encoding(name);
    const EncodedLayers layers =
        encode_layers(std::vector(3, choice), 2, colors, [&](std::size_t g, int page) {
          Image layer = test_layer(40, 36, 3, *choice.encoding);
          for (float& v : layer.data)
            v = std::abs(v) * static_cast<float>(1 + g + 3 * static_cast<std::size_t>(page));
          return layer;
        });
    std::vector<Image> pages;
    for (const std::size_t g : {2u, 0u, 1u}) {
      layers.layer(g, pages);
      const std::vector<Image> plain = layers.layer(g);
      ASSERT_EQ(pages.size(), 2u);
      for (std::size_t p = 0; p < 2; ++p)
        for (std::size_t i = 0; i < plain[p].data.size(); ++i)
          ASSERT_NEAR(pages[p].data[i], plain[p].data[i], 1e-6f * std::abs(plain[p].data[i])) << i;
    }
  }
}

}  // namespace
}  // namespace sconce
