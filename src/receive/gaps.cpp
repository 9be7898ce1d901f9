// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "receive/atlas.h"
#include "receive/raster.h"

namespace sconce {

namespace {

constexpr uint32_t kNobody = 0;
constexpr int kGutterRings = 4;  // what block compression reaches
constexpr int kSmoothing =
    16;  // passes over filled texels, so that fronts from several sides meet without a step

struct Step {
  int x, y;
  float weight;
};
constexpr std::array<Step, 8> kAround{
    {{-1, 0, 2}, {1, 0, 2}, {0, -1, 2}, {0, 1, 2}, {-1, -1, 1}, {1, -1, 1}, {-1, 1, 1}, {1, 1, 1}}};

class Filler {
 public:
  Filler(const Atlas& atlas, int page, const std::vector<uint8_t>& valid, Image& image)
      : width_(atlas.width),
        height_(atlas.height),
        image_(image),
        owner_(image.pixels(), kNobody),
        known_(valid.begin(), valid.end()) {
    for (const auto* sides : {&atlas.front, &atlas.back})
      for (const TexelTriangle& t : *sides)
        if (t.page == page)
          cover_texels(t.uv, width_, height_, [&](int x, int y) { owner_[at(x, y)] = t.chart + 1; });
  }

  void fill_charts() {
    std::vector<std::size_t> filled;
    for (;;) {
      const std::vector<std::size_t> ring = next_ring(false);
      if (ring.empty()) break;
      filled.insert(filled.end(), ring.begin(), ring.end());
    }
    std::vector<float> next(filled.size() * image_.stride());
    for (int pass = 0; pass < kSmoothing && !filled.empty(); ++pass) {
      for (std::size_t i = 0; i < filled.size(); ++i)
        mean(filled[i], owner_[filled[i]], &next[i * image_.stride()]);
      for (std::size_t i = 0; i < filled.size(); ++i) set(filled[i], &next[i * image_.stride()]);
    }
  }

  void fill_gutters() {
    for (int ring = 0; ring < kGutterRings; ++ring)
      if (next_ring(true).empty()) break;
  }

 private:
  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }
  void set(std::size_t i, const float* value) {
    std::copy(value, value + image_.stride(), &image_.data[i * image_.stride()]);
  }

  /// Weighted mean of known texels of that chart around i. False where there is none.
  bool mean(std::size_t i, uint32_t owner, float* out) const {
    const int x = static_cast<int>(i % static_cast<std::size_t>(width_)),
              y = static_cast<int>(i / static_cast<std::size_t>(width_));
    const std::size_t stride = image_.stride();
    std::fill(out, out + stride, 0.0f);
    float total = 0;
    for (const Step& step : kAround) {
      const int u = x + step.x, v = y + step.y;
      if (u < 0 || v < 0 || u >= width_ || v >= height_) continue;
      const std::size_t j = at(u, v);
      if (known_[j] == 0 || owner_[j] != owner) continue;
      for (std::size_t c = 0; c < stride; ++c) out[c] += step.weight * image_.data[j * stride + c];
      total += step.weight;
    }
    if (total > 0)
      for (std::size_t c = 0; c < stride; ++c) out[c] /= total;
    return total > 0;
  }

  uint32_t neighbour_owner(std::size_t i) const {
    const int x = static_cast<int>(i % static_cast<std::size_t>(width_)),
              y = static_cast<int>(i / static_cast<std::size_t>(width_));
    for (const Step& step : kAround) {
      const int u = x + step.x, v = y + step.y;
      if (u < 0 || v < 0 || u >= width_ || v >= height_) continue;
      if (known_[at(u, v)] != 0 && owner_[at(u, v)] != kNobody) return owner_[at(u, v)];
    }
    return kNobody;
  }

  /// Fills the texels next to known ones: inside charts, or around them (which then belong to that chart).
  std::vector<std::size_t> next_ring(bool gutter) {
    // The first ring looks everywhere, later ones only around the last.
    std::vector<std::size_t> open;
    if (front_.empty() || gutter != front_is_gutter_) {
      for (std::size_t i = 0; i < owner_.size(); ++i) open.push_back(i);
    } else {
      for (const std::size_t i : front_) {
        const int x = static_cast<int>(i % static_cast<std::size_t>(width_)),
                  y = static_cast<int>(i / static_cast<std::size_t>(width_));
        for (const Step& step : kAround) {
          const int u = x + step.x, v = y + step.y;
          if (u >= 0 && v >= 0 && u < width_ && v < height_) open.push_back(at(u, v));
        }
      }
      std::sort(open.begin(), open.end());
      open.erase(std::unique(open.begin(), open.end()), open.end());
    }
    std::vector<std::size_t> ring;
    std::vector<uint32_t> owners;
    std::vector<float> values, value(image_.stride());
    for (const std::size_t i : open) {
      if (known_[i] != 0 || (owner_[i] == kNobody) != gutter) continue;
      const uint32_t owner = gutter ? neighbour_owner(i) : owner_[i];
      if (owner == kNobody || !mean(i, owner, value.data())) continue;
      ring.push_back(i);
      owners.push_back(owner);
      values.insert(values.end(), value.begin(), value.end());
    }
    for (std::size_t k = 0; k < ring.size(); ++k) {
      known_[ring[k]] = 1;
      owner_[ring[k]] = owners[k];
      set(ring[k], &values[k * image_.stride()]);
    }
    front_ = ring;
    front_is_gutter_ = gutter;
    return ring;
  }

  int width_, height_;
  Image& image_;
  std::vector<uint32_t> owner_;  // chart + 1
  std::vector<uint8_t> known_;
  std::vector<std::size_t> front_;
  bool front_is_gutter_ = false;
};

}  // namespace

void fill_gaps(const Atlas& atlas, int page, const std::vector<uint8_t>& valid, Image& image) {
  Filler filler(atlas, page, valid, image);
  filler.fill_charts();
  filler.fill_gutters();
}

}  // namespace sconce
