// SPDX-License-Identifier: Apache-2.0
#include "package/points.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "core/text.h"
#include "encode/basis.h"
#include "image/io.h"
#include "package/manifest.h"

namespace sconce {

namespace {

constexpr std::string_view kPlane = "plane.", kProbes = "probes.";

std::string print(const Vec3& v) {
  return fmt::format("{} {} {}", v.x, v.y, v.z);
}

/// Attributes of a file, read strictly.
class Attributes {
 public:
  Attributes(const Image& image, std::string where) : image_(image), where_(std::move(where)) {}

  std::string text(const std::string& key) const {
    const auto found = image_.text.find("sconce:" + key);
    if (found == image_.text.end()) throw Error(where_, "lacks the attribute sconce:" + key);
    return found->second;
  }
  double number(const std::string& key) const { return numbers(key, 1)[0]; }
  Vec3 vector(const std::string& key) const {
    const auto v = numbers(key, 3);
    return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
  }
  std::size_t channel(const std::string& name) const {
    const int c = image_.channel(name);
    if (c < 0) throw Error(where_, "lacks the channel " + name);
    return static_cast<std::size_t>(c);
  }

 private:
  std::vector<double> numbers(const std::string& key, std::size_t count) const {
    std::vector<double> all;
    for (const std::string& word : split(text(key), ' '))
      if (const auto number = parse_number(word)) all.push_back(*number);
    if (all.size() != count) throw Error(where_, "its attribute sconce:" + key + " is damaged");
    return all;
  }

  const Image& image_;
  std::string where_;
};

constexpr std::array<const char*, 3> kChannels{".R", ".G", ".B"};

void put(float* channels, const Rgb& c) {
  channels[0] = c.r, channels[1] = c.g, channels[2] = c.b;
}

Image plane_image(const PlaneLight& light, const std::vector<std::string>& names) {
  std::vector<std::string> channels;
  for (const std::string& name : names)
    for (const char* channel : kChannels) channels.push_back(name + channel);
  Image image(light.plane.columns, light.plane.rows, channels);
  for (std::size_t i = 0; i < light.values.size(); ++i) put(&image.data[3 * i], light.values[i]);
  image.text = {{"sconce:unit", "lux"},
                {"sconce:plane", light.name},
                {"sconce:corner", print(light.plane.corner)},
                {"sconce:across", print(light.plane.across)},
                {"sconce:along", print(light.plane.along)},
                {"sconce:samples", std::to_string(light.samples)}};
  return image;
}

std::vector<std::string> probe_channels(std::span<const GroupInfo> groups, std::size_t g) {
  std::vector<std::string> channels;
  for (std::size_t k = 0; k < 4; ++k)
    for (const char* channel : kChannels) channels.push_back(layer_names(groups, k)[g] + channel);
  channels.push_back("valid");
  return channels;
}

Image probe_image(const ProbeGrid& grid, std::span<const GroupInfo> groups, std::size_t g) {
  Image image(grid.size[0], grid.size[1] * grid.size[2], probe_channels(groups, g));
  for (std::size_t i = 0; i < grid.probes(); ++i) {
    float* pixel = &image.data[i * image.stride()];
    for (std::size_t k = 0; k < 4; ++k) put(pixel + 3 * k, grid.values[i * grid.groups + g][k]);
    pixel[12] = grid.valid[i] != 0 ? 1.0f : 0.0f;
  }
  image.text = {{"sconce:unit", "lux"},
                {"sconce:group", groups[g].name},
                {"sconce:origin", print(grid.origin)},
                {"sconce:spacing", fmt::format("{}", grid.spacing)},
                {"sconce:size", fmt::format("{} {} {}", grid.size[0], grid.size[1], grid.size[2])}};
  return image;
}

/// @param at  the group's first channel and those after it
Rgb rgb_of(const Image& image, std::size_t pixel, const std::array<std::size_t, 3>& at) {
  const float* data = &image.data[pixel * image.stride()];
  return {data[at[0]], data[at[1]], data[at[2]]};
}

std::array<std::size_t, 3> channels_of(const Attributes& attributes, const std::string& name) {
  return {attributes.channel(name + ".R"), attributes.channel(name + ".G"), attributes.channel(name + ".B")};
}

std::string probe_file(const GroupInfo& group) {
  return std::string(kProbes) + safe_file_name(group.name) + ".exr";
}

}  // namespace

Vec3 ProbeGrid::position(std::size_t probe) const {
  const std::size_t x = static_cast<std::size_t>(size[0]), y = static_cast<std::size_t>(size[1]);
  return origin + spacing * Vec3(static_cast<float>(probe % x), static_cast<float>(probe / x % y),
                                 static_cast<float>(probe / x / y));
}

ProbeValue ProbeGrid::at(const Vec3& point, std::size_t g) const {
  std::array<int, 3> low{};
  Vec3 share(0);
  for (int axis = 0; axis < 3; ++axis) {
    const int last = size[static_cast<std::size_t>(axis)] - 1;
    const float place = std::clamp((point[axis] - origin[axis]) / spacing, 0.0f, static_cast<float>(last));
    low[static_cast<std::size_t>(axis)] = std::min(static_cast<int>(place), std::max(last - 1, 0));
    share[axis] = place - static_cast<float>(low[static_cast<std::size_t>(axis)]);
  }
  ProbeValue sum{};
  float all = 0;
  for (int corner = 0; corner < 8; ++corner) {
    float weight = 1;
    std::array<int, 3> at = low;
    for (int axis = 0; axis < 3; ++axis) {
      const int up = corner >> axis & 1;
      at[static_cast<std::size_t>(axis)] += up;
      weight *= up != 0 ? share[axis] : 1 - share[axis];
    }
    if (!(weight > 0)) continue;
    const auto probe = static_cast<std::size_t>((at[2] * size[1] + at[1]) * size[0] + at[0]);
    if (valid[probe] == 0) continue;
    for (std::size_t k = 0; k < 4; ++k) sum[k] += weight * values[probe * groups + g][k];
    all += weight;
  }
  if (all > 0)
    for (Rgb& k : sum) k = k * (1 / all);
  return sum;
}

ProbeValue ProbeGrid::mixed(const Vec3& point, std::span<const Rgb> weights) const {
  ProbeValue sum{};
  for (std::size_t g = 0; g < groups; ++g) {
    const ProbeValue part = at(point, g);
    for (std::size_t k = 0; k < 4; ++k) sum[k] += weights[g] * part[k];
  }
  return sum;
}

Rgb facing(const ProbeValue& light, const Vec3& normal) {
  return light[0] + normal.x * light[1] + normal.y * light[2] + normal.z * light[3];
}

Rgb ProbeGrid::illuminance(const Vec3& point, const Vec3& normal, std::span<const Rgb> weights) const {
  const Rgb e = facing(mixed(point, weights), normal);
  return {std::max(0.0f, e.r), std::max(0.0f, e.g), std::max(0.0f, e.b)};
}

std::map<std::string, Image> print_points(std::span<const PlaneLight> planes, const ProbeGrid* probes,
                                          std::span<const GroupInfo> groups) {
  std::map<std::string, Image> files;
  for (const PlaneLight& plane : planes)
    files[std::string(kPlane) + safe_file_name(plane.name) + ".exr"] =
        plane_image(plane, layer_names(groups));
  for (std::size_t g = 0; probes != nullptr && g < groups.size(); ++g)
    files[probe_file(groups[g])] = probe_image(*probes, groups, g);
  return files;
}

std::vector<PlaneLight> read_planes(const Package& package) {
  std::vector<PlaneLight> planes;
  const std::vector<std::string> names = layer_names(package.manifest().groups);
  for (const auto& [file, hash] : package.manifest().hashes) {
    if (!file.starts_with(kPlane)) continue;
    const std::string where = (package.path() / file).string();
    const Image image = read_exr(where);
    const Attributes attributes(image, where);
    PlaneLight& light = planes.emplace_back();
    light.name = attributes.text("plane");
    light.plane = {attributes.vector("corner"), attributes.vector("across"), attributes.vector("along"),
                   image.width, image.height};
    light.samples = static_cast<int>(attributes.number("samples"));
    light.values.resize(image.pixels() * names.size());
    for (std::size_t g = 0; g < names.size(); ++g) {
      const auto at = channels_of(attributes, names[g]);
      for (std::size_t i = 0; i < image.pixels(); ++i)
        light.values[i * names.size() + g] = rgb_of(image, i, at);
    }
  }
  return planes;
}

std::optional<ProbeGrid> read_probes(const Package& package) {
  const Manifest& m = package.manifest();
  if (m.groups.empty() || m.hashes.count(probe_file(m.groups[0])) == 0) return std::nullopt;
  ProbeGrid grid;
  grid.groups = m.groups.size();
  for (std::size_t g = 0; g < grid.groups; ++g) {
    const std::string where = (package.path() / probe_file(m.groups[g])).string();
    const Image image = read_exr(where);
    const Attributes attributes(image, where);
    const Vec3 size = attributes.vector("size");
    if (!(size.x >= 1 && size.x == static_cast<float>(image.width) && size.y >= 1 && size.z >= 1 &&
          size.y * size.z == static_cast<float>(image.height)))
      throw Error(where, "its attribute sconce:size does not fit the picture");
    if (g == 0) {
      grid.size = {static_cast<int>(size.x), static_cast<int>(size.y), static_cast<int>(size.z)};
      grid.origin = attributes.vector("origin");
      grid.spacing = static_cast<float>(attributes.number("spacing"));
      if (!(grid.spacing > 0)) throw Error(where, "its attribute sconce:spacing is damaged");
      grid.values.resize(image.pixels() * grid.groups);
      grid.valid.resize(image.pixels());
      const std::size_t valid = attributes.channel("valid");
      for (std::size_t i = 0; i < grid.probes(); ++i)
        grid.valid[i] = image.data[i * image.stride() + valid] > 0.5f ? 1 : 0;
    } else if (image.pixels() != grid.probes()) {
      throw Error(where, "has another size than the first group's probes");
    }
    for (std::size_t k = 0; k < 4; ++k) {
      const auto at = channels_of(attributes, layer_names(m.groups, k)[g]);
      for (std::size_t i = 0; i < grid.probes(); ++i)
        grid.values[i * grid.groups + g][k] = rgb_of(image, i, at);
    }
  }
  return grid;
}

}  // namespace sconce
