// SPDX-License-Identifier: Apache-2.0
#include <bit>
#include <cmath>

#include "core/error.h"
#include "core/parallel.h"
#include "mix/light_meter.h"
#include "scene/world.h"

namespace sconce {

namespace {

constexpr double kDelta = 1e-4;                     // cd/m2, contract.md, "Exposure"
constexpr double kMaximum = 0.999, kBright = 0.8;  // percentiles

/// Weighted luminances by size, 64 bins from each power of two to the next; each bin keeps its largest
/// member, so few values come back exactly.
class Histogram {
 public:
  void add(float luminance, double weight) {
    Bin& bin = bins_[index(luminance)];
    bin.weight += weight;
    bin.largest = std::max(bin.largest, luminance);
    total_ += weight;
  }
  void add(const Histogram& other) {
    for (std::size_t i = 0; i < bins_.size(); ++i) {
      bins_[i].weight += other.bins_[i].weight;
      bins_[i].largest = std::max(bins_[i].largest, other.bins_[i].largest);
    }
    total_ += other.total_;
  }
  double percentile(double share) const {
    double below = 0;
    for (const Bin& bin : bins_) {
      below += bin.weight;
      if (bin.weight > 0 && below >= share * total_) return bin.largest;
    }
    return 0;
  }

 private:
  static constexpr uint32_t kBits = 6;                                                  // of the mantissa
  static constexpr uint32_t kFirst = (127 - 40) << kBits, kLast = (127 + 40) << kBits;  // 2^-40, 2^40
  static std::size_t index(float luminance) {
    if (!(luminance > 0)) return 0;
    return std::clamp(std::bit_cast<uint32_t>(luminance) >> (23 - kBits), kFirst, kLast) - kFirst + 1;
  }

  struct Bin {
    double weight = 0;
    float largest = 0;
  };
  std::vector<Bin> bins_ = std::vector<Bin>(kLast - kFirst + 2);
  double total_ = 0;
};

struct Sums {
  double log_sum = 0, weight = 0;
  Histogram histogram;

  void add(float luminance, double of_weight) {
    const float l = std::max(0.0f, luminance);
    log_sum += of_weight * std::log(static_cast<double>(l) + kDelta);
    weight += of_weight;
    histogram.add(l, of_weight);
  }
  void add(const Sums& other) {
    log_sum += other.log_sum;
    weight += other.weight;
    histogram.add(other.histogram);
  }
};

constexpr std::size_t kBand = 64;  // rows

// Twins repeat the triangles of their front, which counts both sides; a View's scene has none.
std::vector<bool> find_twins(const Scene& scene, const Manifest& m) {
  std::vector<bool> twins(scene.instances.size(), false);
  if (twins.size() != m.instance_twins.size()) return twins;
  for (const int twin : m.instance_twins)
    if (twin >= 0) twins[static_cast<std::size_t>(twin)] = true;
  return twins;
}

std::vector<LightMeter::Emitter> find_emitters(const Scene& scene, const Manifest& m) {
  std::vector<LightMeter::Emitter> emitters;
  const std::vector<bool> twins = find_twins(scene, m);
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    if (twins[i] || !scene.emits(instance)) continue;
    const Mesh& mesh = scene[instance.mesh];
    const Material& material = scene[mesh.material];
    const TextureUse& use = material.emission_texture;
    const bool textured = use.texture.valid() && use.texcoord < mesh.texcoords.size();
    for (const Triangle& t : mesh.triangles) {
      Vec3 p[3];
      Vec2 uv(0);
      for (std::size_t k = 0; k < 3; ++k) {
        p[k] = Vec3(instance.transform * glm::vec4(mesh.positions[t.v[k]], 1.0f));
        if (textured) uv += mesh.texcoords[use.texcoord][t.v[k]] / 3.0f;
      }
      const float area = 0.5f * glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
      Rgb emission = material.emission;
      if (textured) emission *= sample_texture(scene, use, uv, true).rgb;
      if (area > 0)
        emitters.push_back(
            {instance.group, emission, static_cast<double>(material.double_sided ? 2 * area : area)});
    }
  }
  return emitters;
}

}  // namespace

LightMeter::LightMeter(const Package& package, const Scene& scene)
    : where_(package.path().string()), emitters_(find_emitters(scene, package.manifest())) {
  for (int page = 0; page < package.manifest().pages; ++page) {
    const Image receivers = package.receivers(page);
    const std::size_t band = kBand * static_cast<std::size_t>(receivers.width);
    std::vector<std::vector<Texel>>& bands = pages_.emplace_back();
    for (std::size_t i = 0; i < receivers.pixels(); ++i) {
      if (i % band == 0) bands.emplace_back();
      const float* r = &receivers.data[i * 4];
      const Rgb albedo(r[0], r[1], r[2]);
      if (is_metered(albedo, r[3])) bands.back().push_back({albedo, r[3], static_cast<uint32_t>(i)});
    }
  }
}

// Bands of rows are summed apart and folded in order: the same bits with any number of threads.
Metering LightMeter::operator()(const MixSpec& mix, std::span<const Image> mixed) const {
  if (mixed.size() != pages_.size())
    throw Error(where_, "the mix has another number of pages than the package");
  Sums sums;
  for (std::size_t page = 0; page < mixed.size(); ++page) {
    std::vector<Sums> bands(pages_[page].size());
    parallel_for(bands.size(), 1, [&](std::size_t band) {
      Sums own;  // beside the others' it would share cache lines with them
      for (const Texel& texel : pages_[page][band]) {
        const float* e = &mixed[page].data[3 * std::size_t{texel.index}];
        own.add(luminance(texel.albedo * Rgb(e[0], e[1], e[2])) * kInvPi, static_cast<double>(texel.weight));
      }
      bands[band] = std::move(own);
    });
    Sums total;
    for (const Sums& band : bands) total.add(band);
    sums.add(total);
  }
  Metering metering;
  metering.log_mean = sums.weight > 0 ? std::exp(sums.log_sum / sums.weight) : kDelta;
  metering.bright = sums.histogram.percentile(kBright);
  for (const Emitter& emitter : emitters_) {
    const Rgb weight = emitter.group ? mix.weights.at(emitter.group.value) : Rgb(1);
    if (!weight.is_black()) sums.histogram.add(luminance(weight * emitter.emission), emitter.area);
  }
  metering.maximum = sums.histogram.percentile(kMaximum);
  return metering;
}

Metering meter(const Package& package, const Scene& scene, const MixSpec& mix, std::span<const Image> mixed) {
  return LightMeter(package, scene)(mix, mixed);
}

Metering meter_picture(const Image& picture) {
  Sums sums;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) sums.add(luminance(picture.rgb_at(x, y)), 1);
  return {std::exp(sums.log_sum / std::max(sums.weight, 1.0)), sums.histogram.percentile(kMaximum),
          sums.histogram.percentile(kBright)};
}

Metering meter(const Package& package, const MixSpec& mix, std::span<const Image> mixed) {
  return meter(package, package.scene(), mix, mixed);
}

}  // namespace sconce
