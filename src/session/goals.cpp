// SPDX-License-Identifier: Apache-2.0
#include "session/goals.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/parallel.h"
#include "picture/show.h"

namespace sconce {

namespace {

constexpr int kFitSamples = 16;  // rays per pixel

/// Whether a lamp or the sky is seen in a pixel or beside it: edges of what is brightest say most about where
/// the rays of another picture went.
std::vector<uint8_t> beside_lamps(const std::vector<CameraHits>& hits) {
  const int width = hits.front().width, height = hits.front().height;
  std::vector<uint8_t> found(hits.front().pixels.size(), 0);
  for (const CameraHits& sample : hits)
    for (int y = 0; y < height; ++y)
      sample.for_each_shine(y, [&](const CameraHits::Shine& shine) {
        const int x = static_cast<int>(shine.x);
        for (int j = std::max(y - 1, 0); j <= std::min(y + 1, height - 1); ++j)
          for (int i = std::max(x - 1, 0); i <= std::min(x + 1, width - 1); ++i)
            found[static_cast<std::size_t>(j * width + i)] = 1;
      });
  return found;
}

/// Pictures of every group alone at unit weight, of surfaces only.
std::vector<Image> group_pictures(const std::vector<CameraHits>& hits, const EncodedLayers& layers,
                                  const PictureParams& params) {
  std::vector<Image> pictures;
  const float share = 1 / static_cast<float>(params.samples);
  for (std::size_t g = 0; g < layers.colors.size(); ++g) {
    const std::vector<Image> pages = layers.layer(g);
    Image& picture = pictures.emplace_back(Image::rgb(params.width, params.height));
    parallel_for(static_cast<std::size_t>(params.height), 4, [&](std::size_t row) {
      const int y = static_cast<int>(row);
      std::vector<float> rgb(3 * static_cast<std::size_t>(params.width) + 1);
      for (const CameraHits& sample : hits) {
        shade_row(sample, y, pages, rgb.data());
        for (std::size_t i = 0; i + 1 < rgb.size(); ++i) picture.at(0, y)[i] += share * rgb[i];
      }
    });
  }
  return pictures;
}

}  // namespace

std::vector<Rgb> unit_weights(std::span<const GroupInfo> groups, const Faders& faders) {
  Faders unit = faders;
  unit.master = 1;
  for (Fader& fader : unit.groups) fader.on = true, fader.solo = fader.mute = false, fader.gain = 1;
  return make_mix(groups, unit).weights;
}

void wish_lux(Wishes& wishes, std::span<const Rgb> lux, std::span<const Rgb> unit, double target) {
  std::vector<double> row;
  for (std::size_t g = 0; g < unit.size(); ++g)
    row.push_back(static_cast<double>(luminance(unit[g] * lux[g])));
  wishes.add(row, target, 1 / std::max(target * target, 1.0));
}

Image fit_sized(const Image& image) {
  if (image.stride() < 3) throw Error({}, "the picture to look like has no R, G and B");
  const int factor =
      std::min(std::max(1, (image.width + kFitWidth - 1) / kFitWidth), std::max(1, image.height));
  Image out = Image::rgb(image.width / factor, image.height / factor);
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x) {
      Rgb sum;
      for (int j = 0; j < factor; ++j)
        for (int i = 0; i < factor; ++i) sum += image.rgb_at(x * factor + i, y * factor + j);
      out.set_rgb(x, y, sum / static_cast<float>(factor * factor));
    }
  return out;
}

void wish_pixels(Wishes& wishes, std::span<const Image> parts, std::span<const Rgb> unit, const Image& wanted,
                 std::span<const uint8_t> left_out) {
  double mean = 0;
  for (int y = 0; y < wanted.height; ++y)
    for (int x = 0; x < wanted.width; ++x) {
      const auto l = static_cast<double>(luminance(wanted.rgb_at(x, y)));
      mean += std::log(std::max(l, 0.0) + 1e-4) / static_cast<double>(wanted.pixels());
    }
  mean = std::exp(mean);
  if (!(mean > 1.1e-4)) throw Error({}, "the picture to look like is black");
  std::vector<double> row(unit.size());
  for (int y = 0; y < wanted.height; ++y)
    for (int x = 0; x < wanted.width; ++x) {
      if (!left_out.empty() && left_out[static_cast<std::size_t>(y * wanted.width + x)] != 0) continue;
      const Rgb goal = wanted.rgb_at(x, y);
      const double scale = static_cast<double>(luminance(goal)) + mean;
      for (const auto channel : {&Rgb::r, &Rgb::g, &Rgb::b}) {
        for (std::size_t g = 0; g < unit.size(); ++g)
          row[g] = static_cast<double>((unit[g] * parts[g].rgb_at(x, y)).*channel);
        wishes.add(row, static_cast<double>(goal.*channel), 1 / (scale * scale));
      }
    }
}

void wish_picture(Wishes& wishes, const View& view, const EncodedLayers& layers, const Camera& camera,
                  std::span<const Rgb> unit, const Image& target, const Progress& progress) {
  const Image wanted = fit_sized(target);
  const PictureParams params{.width = wanted.width, .height = wanted.height, .samples = kFitSamples};
  std::vector<CameraHits> hits;
  for (int s = 0; s < params.samples; ++s) hits.push_back(view.hits(camera, params, s, progress));
  wish_pixels(wishes, group_pictures(hits, layers, params), unit, wanted, beside_lamps(hits));
}

Image from_display(const Image8& picture, float grey) {
  Image out = Image::rgb(picture.width, picture.height);
  const float scale = grey / 0.18f;
  const auto channels = static_cast<std::size_t>(picture.channels);
  for (std::size_t i = 0; i < out.pixels(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      out.data[3 * i + c] =
          scale *
          srgb_to_linear(static_cast<float>(picture.data[i * channels + (channels < 3 ? 0 : c)]) / 255.0f);
  return out;
}

Faders with_gains(Faders faders, std::span<const double> gains) {
  faders.master = 1;
  for (std::size_t g = 0; g < faders.groups.size(); ++g) {
    Fader& fader = faders.groups[g];
    fader.on = gains[g] > 1e-4;
    fader.solo = fader.mute = false;
    if (fader.on) fader.gain = gains[g];
  }
  return faders;
}

}  // namespace sconce
