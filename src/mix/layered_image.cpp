// SPDX-License-Identifier: Apache-2.0
#include "mix/layered_image.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/error.h"
#include "core/text.h"
#include "image/primaries.h"
#include "mix/accumulate.h"

namespace sconce {

namespace {

std::string layer_of(const std::string& channel) {
  const std::size_t dot = channel.rfind('.');
  return dot == std::string::npos ? "" : channel.substr(0, dot);
}

/// Every channel is R, G, B or A of some layer.
bool all_colours(const std::vector<std::string>& channels) {
  return std::all_of(channels.begin(), channels.end(), [](const std::string& channel) {
    const std::string layer = layer_of(channel),
                      leaf = layer.empty() ? channel : channel.substr(layer.size() + 1);
    return leaf.size() == 1 && std::string_view("RGBA").find(leaf[0]) != std::string_view::npos;
  });
}

LayeredImage::Rgbs rgb_of(const Image& image, const std::string& layer) {
  const std::string dot = layer.empty() ? "" : layer + ".";
  LayeredImage::Rgbs channels{};
  for (std::size_t k = 0; k < 3; ++k) channels[k] = static_cast<std::size_t>(image.channel(dot + "RGB"[k]));
  return channels;
}

/// What an expression could find: " among 'a', 'b', ..."; colours without a layer's name are none.
std::string listed(const std::vector<std::string>& layers) {
  constexpr std::size_t kMost = 12;
  std::vector<std::string> names;
  for (const std::string& layer : layers)
    if (!layer.empty()) names.push_back("'" + layer + "'");
  if (names.empty()) return {};
  if (names.size() > kMost) names.resize(kMost), names.emplace_back("...");
  return " among " + join(names, ", ");
}

GroupInfo group_named(const std::string& name) {
  GroupInfo group;
  group.name = name;
  group.color_spread = -1;
  return group;
}

}  // namespace

LayeredImage find_layers(ExrParts picture, const std::string& where, const std::string& expression) {
  LayeredImage out;
  const Image& image = picture.image;
  std::vector<std::string> layers;
  for (const std::string& channel : image.channels) {
    const std::string layer = layer_of(channel), dot = layer.empty() ? "" : layer + ".";
    if (channel == dot + "R" && image.channel(dot + "G") >= 0 && image.channel(dot + "B") >= 0)
      layers.push_back(layer);
  }
  FoundGroups found = find_groups(layers, expression);
  const std::optional<std::string> beauty = find_beauty(layers, found);
  if (const auto own = image.text.find("sconce:groups"); own != image.text.end() && expression.empty()) {
    found = {"sconce", {}, {}};
    for (const std::string& layer : split(own->second, '\n'))
      if (std::find(layers.begin(), layers.end(), layer) != layers.end())
        found.groups.push_back({layer, layer});
  }
  const bool views = beauty && beauty->find('.') != std::string::npos;
  if (found.groups.empty() && expression.empty() && !views && all_colours(image.channels))
    for (const std::string& layer : layers)
      if (layer != beauty) found.groups.push_back({layer, layer});
  if (found.groups.empty()) {
    std::vector<std::string> known;
    for (const GroupNaming& naming : group_namings()) known.push_back(naming.renderer);
    throw Error(where, "has no light-group layers" + listed(layers),
                expression.empty() ? "names by " + join(known, ", ") + "; others by --groups-from REGEX"
                                   : "layers that --groups-from finds");
  }
  out.renderer = found.renderer;
  for (const NamedGroup& group : found.groups) {
    const bool twice = std::any_of(out.groups.begin(), out.groups.end(),
                                   [&](const GroupInfo& other) { return other.name == group.name; });
    if (twice) throw Error(where, "has two layers of the light group '" + group.name + "'");
    out.groups.push_back(group_named(group.name));
    out.layers.push_back(group.layer);
    out.channels.push_back(rgb_of(image, group.layer));
  }
  if (beauty) {
    out.beauty = rgb_of(image, *beauty);
    if (const int alpha = image.channel(beauty->empty() ? "A" : *beauty + ".A"); alpha >= 0)
      out.alpha = static_cast<std::size_t>(alpha);
    std::string name = "rest";
    for (const GroupInfo& group : out.groups)
      if (group.name == name) name = "beauty's rest";
    out.groups.push_back(group_named(name));
  }
  for (std::size_t c = 0; c < image.channels.size(); ++c) {
    const std::string layer = layer_of(image.channels[c]);
    const bool mixed = std::find(out.layers.begin(), out.layers.end(), layer) != out.layers.end() ||
                       (beauty && (c == out.alpha || std::find(out.beauty->begin(), out.beauty->end(), c) !=
                                                         out.beauty->end()));
    if (!mixed) out.others.push_back(c);
  }
  out.picture = std::move(picture);
  return out;
}

Rest measure_rest(const LayeredImage& layered) {
  constexpr float kRounding = 1.0f / 1024;  // of halves, on both sides
  Rest rest;
  if (!layered.beauty) return rest;
  const Image& image = layered.picture.image;
  double beauty = 0, groups = 0;
  std::size_t negative = 0;
  for (std::size_t i = 0; i < image.pixels(); ++i) {
    const float* p = &image.data[i * image.stride()];
    bool below = false;
    Rgb whole, parts;
    for (std::size_t k = 0; k < 3; ++k) {
      float sum = 0, size = std::abs(p[(*layered.beauty)[k]]);
      for (const LayeredImage::Rgbs& c : layered.channels) sum += p[c[k]], size += std::abs(p[c[k]]);
      below |= p[(*layered.beauty)[k]] - sum < -kRounding * size;
      (&whole.r)[k] = p[(*layered.beauty)[k]];
      (&parts.r)[k] = sum;
    }
    negative += below ? 1 : 0;
    if (const float l = luminance(whole), m = luminance(parts); std::isfinite(l) && std::isfinite(m))
      beauty += l, groups += m;
  }
  rest.share = beauty > 0 ? 1 - groups / beauty : 0;
  rest.negative = static_cast<double>(negative) / static_cast<double>(image.pixels());
  return rest;
}

Image mix_layers(const LayeredImage& layered, const MixSpec& mix) {
  const Image& image = layered.picture.image;
  Image sum = Image::rgb(image.width, image.height);
  sum.text = image.text;
  sum.number = image.number;
  sum.primaries = image.primaries;
  const Rgb rest = layered.beauty ? mix.weights.at(layered.channels.size()) : Rgb(0);
  if (rest == Rgb(1)) {  // the sign of zeros, too
    for (std::size_t i = 0; i < image.pixels(); ++i)
      for (std::size_t k = 0; k < 3; ++k)
        sum.data[3 * i + k] = image.data[i * image.stride() + (*layered.beauty)[k]];
  } else if (!rest.is_black()) {
    accumulate(sum, rest, image, *layered.beauty);
  }
  for (std::size_t g = 0; g < layered.channels.size(); ++g)
    if (const Rgb w = mix.weights.at(g) - rest; !w.is_black()) accumulate(sum, w, image, layered.channels[g]);
  return sum;
}

ExrParts with_mixed(const LayeredImage& layered, const Image& mixed) {
  const Image& image = layered.picture.image;
  ExrParts out;
  out.data = layered.picture.data;
  out.display = layered.picture.display;
  out.attributes = layered.picture.attributes;
  out.integer.assign(3, false);
  std::vector<std::string> names = mixed.channels;
  std::vector<std::size_t> from;
  const auto keep = [&](std::size_t channel, const std::string& name) {
    if (std::find(names.begin(), names.end(), name) != names.end()) return;
    names.push_back(name);
    from.push_back(channel);
    out.integer.push_back(layered.picture.integer[channel]);
  };
  if (layered.alpha) keep(*layered.alpha, "A");
  for (const std::size_t c : layered.others) keep(c, image.channels[c]);
  out.image = Image(image.width, image.height, names);
  out.image.primaries = mixed.primaries;
  for (std::size_t i = 0; i < image.pixels(); ++i) {
    float* to = &out.image.data[i * names.size()];
    std::copy_n(&mixed.data[3 * i], 3, to);
    for (std::size_t k = 0; k < from.size(); ++k)
      std::memcpy(to + 3 + k, &image.data[i * image.stride() + from[k]], sizeof(float));
  }
  return out;
}

Image shown(const LayeredImage& layered, const Image& mixed) {
  const ExrWindow &data = layered.picture.data, &display = layered.picture.display;
  Image out = Image::rgb(display.width, display.height);
  out.primaries = mixed.primaries;
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x) {
      const int from_x = x + display.x - data.x, from_y = y + display.y - data.y;
      if (from_x >= 0 && from_y >= 0 && from_x < mixed.width && from_y < mixed.height)
        out.set_rgb(x, y, mixed.rgb_at(from_x, from_y));
    }
  to_rec709(out);
  return out;
}

}  // namespace sconce
