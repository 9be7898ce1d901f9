// SPDX-License-Identifier: Apache-2.0
#include "session/goals.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/parallel.h"
#include "picture/show.h"

namespace sconce {

namespace {

/// Whether a lamp or the sky is seen in a pixel or beside it: edges of what is brightest say most about where
/// the rays of another picture went.
std::vector<uint8_t> beside_lamps(const CameraHits& hits) {
  std::vector<uint8_t> found(hits.pixels.size(), 0);
  for (int y = 0; y < hits.height; ++y)
    hits.for_each_shine(y, [&](const CameraHits::Shine& shine) {
      const int x = static_cast<int>(shine.x);
      for (int j = std::max(y - 1, 0); j <= std::min(y + 1, hits.height - 1); ++j)
        for (int i = std::max(x - 1, 0); i <= std::min(x + 1, hits.width - 1); ++i)
          found[static_cast<std::size_t>(j * hits.width + i)] = 1;
    });
  return found;
}

/// A picture's places that are compared: a coarse grid's middles, a whole number of pixels apart. Light
/// hardly changes within a pixel, so that one ray says what is seen there.
struct Places {
  Camera camera;  ///< the grid is all that it sees
  Image wanted;

  Places(const Camera& of, const Image& target) : camera(of) {
    if (target.stride() < 3) throw Error({}, "the picture to look like has no R, G and B");
    const int step = std::clamp((target.width + kFitWidth - 1) / kFitWidth, 1, target.height);
    wanted = Image::rgb(target.width / step, target.height / step);
    const auto rows = static_cast<float>(wanted.height * step) / static_cast<float>(target.height);
    camera.yfov = 2 * std::atan(rows * std::tan(0.5f * of.yfov));
    const auto middle = [&](int i, int count, int size) {
      return 0.5f * static_cast<float>(size + (2 * i + 1 - count) * step);
    };
    for (int y = 0; y < wanted.height; ++y)
      for (int x = 0; x < wanted.width; ++x)
        wanted.set_rgb(x, y,
                       between_pixels(target, middle(x, wanted.width, target.width),
                                      middle(y, wanted.height, target.height)));
  }

 private:
  /// @param x, y  in pixels from the top left; their middles are at halves
  static Rgb between_pixels(const Image& image, float x, float y) {
    const float left = std::clamp(x - 0.5f, 0.0f, static_cast<float>(image.width - 1)),
                top = std::clamp(y - 0.5f, 0.0f, static_cast<float>(image.height - 1));
    const int i = std::min(static_cast<int>(left), std::max(image.width - 2, 0)),
              j = std::min(static_cast<int>(top), std::max(image.height - 2, 0));
    const int right = std::min(i + 1, image.width - 1), below = std::min(j + 1, image.height - 1);
    const float u = left - static_cast<float>(i), v = top - static_cast<float>(j);
    return (1 - v) * ((1 - u) * image.rgb_at(i, j) + u * image.rgb_at(right, j)) +
           v * ((1 - u) * image.rgb_at(i, below) + u * image.rgb_at(right, below));
  }
};

Image picture_of(const CameraHits& hits, const std::vector<Image>& pages) {
  Image picture = Image::rgb(hits.width, hits.height);
  parallel_for(static_cast<std::size_t>(hits.height), 8, [&](std::size_t row) {
    const int y = static_cast<int>(row);
    std::vector<float> rgb(3 * static_cast<std::size_t>(hits.width) + 1);
    shade_row(hits, y, pages, rgb.data());
    std::copy(rgb.begin(), rgb.end() - 1, picture.at(0, y));
  });
  return picture;
}

/// Pictures of every group alone at unit weight, of surfaces only.
std::vector<Image> group_pictures(const CameraHits& hits, const GroupedLight& light, std::size_t groups) {
  std::vector<Image> pictures, pages;
  for (std::size_t g = 0; g < groups; ++g) {
    light.group(g, pages);
    pictures.push_back(picture_of(hits, pages));
  }
  return pictures;
}

constexpr int kRounds = 4;

/// Edges, mirrors, whatever else gains do not explain: pixels that are off by several times the usual.
void leave_out_strangers(std::span<const Image> parts, std::span<const Rgb> unit,
                         std::span<const double> gains, const Image& wanted, const Image* given,
                         std::vector<uint8_t>& left_out) {
  constexpr float kTimes = 1.5f;
  std::vector<float> off(wanted.pixels()), usual;
  for (std::size_t i = 0; i < off.size(); ++i) {
    Rgb sum;
    if (given != nullptr) sum = {given->data[3 * i], given->data[3 * i + 1], given->data[3 * i + 2]};
    for (std::size_t g = 0; g < unit.size(); ++g) {
      const float* p = &parts[g].data[3 * i];
      sum += static_cast<float>(gains[g]) * unit[g] * Rgb(p[0], p[1], p[2]);
    }
    const float* goal = &wanted.data[3 * i];
    const Rgb difference = sum - Rgb(goal[0], goal[1], goal[2]);
    off[i] = (std::abs(difference.r) + std::abs(difference.g) + std::abs(difference.b)) /
             std::max(goal[0] + goal[1] + goal[2], 1e-6f);
    if (left_out[i] == 0) usual.push_back(off[i]);
  }
  if (usual.empty()) return;
  const auto middle = usual.begin() + static_cast<std::ptrdiff_t>(usual.size() / 2);
  std::nth_element(usual.begin(), middle, usual.end());
  for (std::size_t i = 0; i < off.size(); ++i)
    if (off[i] > kTimes * *middle + 1e-4f) left_out[i] = 1;
}

}  // namespace

std::vector<Rgb> unit_weights(std::span<const GroupInfo> groups, const Faders& faders) {
  Faders unit = faders;
  unit.master = 1;
  for (Fader& fader : unit.groups) fader.on = true, fader.solo = fader.mute = false, fader.gain = 1;
  return make_mix(groups, unit).weights;
}

void wish_lux(Wishes& wishes, std::span<const Rgb> lux, std::span<const Rgb> unit, double target,
              double given) {
  std::vector<double> row;
  for (std::size_t g = 0; g < unit.size(); ++g)
    row.push_back(static_cast<double>(luminance(unit[g] * lux[g])));
  wishes.add(row, target - given, 1 / std::max(target * target, 1.0));
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
                 std::span<const uint8_t> left_out, const Image* given) {
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
        const float there = given != nullptr ? given->rgb_at(x, y).*channel : 0;
        wishes.add(row, static_cast<double>(goal.*channel - there), 1 / (scale * scale));
      }
    }
}

GroupedLight grouped_light(std::shared_ptr<const EncodedLayers> layers) {
  return {[layers = std::move(layers)](std::size_t group, std::vector<Image>& pages) {
    layers->layer(group, pages);
  }};
}

void wish_picture(Wishes& wishes, const View& view, const GroupedLight& light, const Camera& camera,
                  std::span<const Rgb> unit, const Image& target, const Progress& progress) {
  const Places places(camera, target);
  const Image& wanted = places.wanted;
  const CameraHits hits =
      view.hits(places.camera, {.width = wanted.width, .height = wanted.height, .samples = 1}, 0, progress);
  const std::vector<Image> parts = group_pictures(hits, light, unit.size());
  const Image others = light.given.empty() ? Image() : picture_of(hits, light.given);
  const Image* given = light.given.empty() ? nullptr : &others;
  std::vector<uint8_t> left_out = beside_lamps(hits);
  for (int round = 0; round < kRounds; ++round) {
    Wishes some(unit.size());
    wish_pixels(some, parts, unit, wanted, left_out, given);
    leave_out_strangers(parts, unit, fit(some).gains, wanted, given, left_out);
  }
  wish_pixels(wishes, parts, unit, wanted, left_out, given);
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
