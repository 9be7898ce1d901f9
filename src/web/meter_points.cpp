// SPDX-License-Identifier: Apache-2.0
#include "web/meter_points.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

#include "mix/mix.h"

namespace sconce::web {

namespace {

constexpr std::size_t kPoints = 3072;          // of each kind
constexpr double kBright = 0.004;              // share of the area that counts as bright, per group
const Rgb kShares{0.2126f, 0.7152f, 0.0722f};  // of luminance, Rec. 709

/// Texels that are metered.
struct Texels {
  std::vector<Rgb> albedo;  ///< over pi, times the shares of luminance
  std::vector<float> weight;
  std::vector<std::size_t> place;  ///< page * size of a page + index
};

Texels metered_texels(const Package& package) {
  Texels texels;
  for (int page = 0; page < package.manifest().pages; ++page) {
    const Image receivers = package.receivers(page);
    for (std::size_t i = 0; i < receivers.pixels(); ++i) {
      const float* r = &receivers.data[4 * i];
      const Rgb albedo(r[0], r[1], r[2]);
      if (!is_metered(albedo, r[3])) continue;
      texels.albedo.push_back(kShares * albedo * kInvPi);
      texels.weight.push_back(r[3]);
      texels.place.push_back(static_cast<std::size_t>(page) * receivers.pixels() + i);
    }
  }
  return texels;
}

/// Of a group, or of all where there is none.
std::vector<Rgb> luminances(const Package& package, const Texels& texels, std::optional<std::size_t> group) {
  const Manifest& m = package.manifest();
  MixSpec mix;
  for (std::size_t g = 0; g < m.groups.size(); ++g)
    mix.weights.emplace_back(!group || *group == g ? 1.0f : 0.0f);
  const std::vector<Image> pages = mix_pages(package, mix);
  std::vector<Rgb> out;
  out.reserve(texels.place.size());
  for (std::size_t i = 0; i < texels.place.size(); ++i) {
    const Image& page = pages[texels.place[i] / pages.front().pixels()];
    const float* e = &page.data[3 * (texels.place[i] % page.pixels())];
    out.push_back(texels.albedo[i] * Rgb(e[0], e[1], e[2]));
  }
  return out;
}

float sum(const Rgb& c) {
  return c.r + c.g + c.b;
}

/// Indices by rising luminance; ties by index.
std::vector<std::size_t> in_order(const std::vector<Rgb>& luminance) {
  std::vector<std::size_t> order(luminance.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return sum(luminance[a]) < sum(luminance[b]); });
  return order;
}

/// The brightest texels that make up `share` of the weight.
void mark_bright(const std::vector<Rgb>& luminance, const std::vector<float>& weight, double share,
                 std::vector<bool>& bright) {
  const std::vector<std::size_t> order = in_order(luminance);
  double left = share * std::accumulate(weight.begin(), weight.end(), 0.0);
  for (auto i = order.rbegin(); i != order.rend() && left > 0; ++i) {
    if (!(sum(luminance[*i]) > 0)) break;
    bright[*i] = true;
    left -= static_cast<double>(weight[*i]);
  }
}

/// Every `step`-th part of the weight chooses the texel that it falls on.
void choose(const std::vector<std::size_t>& order, const std::vector<bool>& bright, bool wanted,
            const std::vector<float>& weight, std::vector<std::pair<std::size_t, float>>& chosen) {
  double total = 0;
  for (const std::size_t i : order)
    if (bright[i] == wanted) total += static_cast<double>(weight[i]);
  const double step = total / static_cast<double>(kPoints);
  double seen = 0, next = 0.5 * step;
  for (const std::size_t i : order) {
    if (bright[i] != wanted) continue;
    seen += static_cast<double>(weight[i]);
    if (seen < next) continue;
    const double times = std::floor((seen - next) / step) + 1;
    chosen.emplace_back(i, static_cast<float>(times * step));
    next += times * step;
  }
}

std::vector<MeterPoints::Emitter> emitters_of(const ShownScene& shown) {
  std::map<std::array<float, 4>, MeterPoints::Emitter> found;
  for (std::size_t t = 0; t < shown.world.size(); ++t) {
    const Material& material = shown.scene[shown.world.materials[t]];
    if (!material.emits()) continue;
    const Id<LightGroup> group = shown.scene[shown.world.instances[t]].group;
    const Rgb emission = kShares * shade(shown.scene, shown.world, t, Vec2(1.0f / 3)).emission;
    const float area = shown.world.area(t);
    auto& emitter = found
                        .try_emplace({static_cast<float>(group.value), emission.r, emission.g, emission.b},
                                     MeterPoints::Emitter{group, emission, 0})
                        .first->second;
    emitter.weight += material.double_sided ? 2 * area : area;
  }
  std::vector<MeterPoints::Emitter> out;
  for (const auto& [key, emitter] : found) out.push_back(emitter);
  return out;
}

}  // namespace

MeterPoints choose_meter_points(const Package& package, const ShownScene& shown, const Progress& progress) {
  MeterPoints points;
  points.groups = package.manifest().groups.size();
  points.emitters = emitters_of(shown);
  const Texels texels = metered_texels(package);
  if (texels.weight.empty()) return points;

  std::vector<bool> bright(texels.weight.size(), false);
  for (std::size_t g = 0; g < points.groups; ++g) {
    progress.check();
    mark_bright(luminances(package, texels, g), texels.weight, kBright, bright);
  }
  const std::vector<std::size_t> order = in_order(luminances(package, texels, std::nullopt));
  std::vector<std::pair<std::size_t, float>> chosen;
  choose(order, bright, false, texels.weight, chosen);
  choose(order, bright, true, texels.weight, chosen);
  for (const auto& [i, weight] : chosen) points.weights.push_back(weight);
  points.values.resize(chosen.size() * points.groups);
  for (std::size_t g = 0; g < points.groups; ++g) {
    progress.check();
    const std::vector<Rgb> luminance = luminances(package, texels, g);
    for (std::size_t i = 0; i < chosen.size(); ++i)
      points.values[i * points.groups + g] = luminance[chosen[i].first];
  }
  return points;
}

}  // namespace sconce::web
