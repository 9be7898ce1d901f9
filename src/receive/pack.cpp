// SPDX-License-Identifier: Apache-2.0
#include "receive/pack.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <tuple>

#include "core/error.h"
#include "core/parallel.h"
#include "receive/page_bits.h"
#include "receive/raster.h"

namespace sconce {

namespace {

constexpr int kManyPages = 4096;
constexpr int kTries = 4;           // page sizes tried after the first that works
constexpr double kPageCost = 0.15;  // of a page's texels, for every page after the first
constexpr double kFillable = 0.97;  // of a page, at best

/// Texels that a length covers when it is centred in them.
int texels(float length) {
  return std::max(1, static_cast<int>(std::ceil(length - 1e-3f)));
}

/// A block at one density.
struct Item {
  Shape shape;
  Vec2 margin;  ///< from the shape's corner to the block's
  float texels_per_metre;
};

class Packer {
 public:
  Packer(const std::vector<Block>& blocks, const std::vector<Chart>& charts, int gutter)
      : blocks_(blocks), charts_(charts), gutter_(gutter) {}

  /// Shapes at a density; a block larger than a page is made to fit. Counts those.
  std::size_t set_density(float density, int page) {
    density_ = density;
    items_.assign(blocks_.size(), {Shape(1, 1), Vec2(0), 1});
    const auto room = static_cast<float>(page - gutter_ - 1);
    std::vector<uint8_t> shrunk(blocks_.size(), 0);
    std::vector<std::size_t> needs(blocks_.size());
    parallel_for(blocks_.size(), 64, [&](std::size_t i) {
      const Block& block = blocks_[i];
      float k = density * block.scale;
      const float longest = std::max(block.size.x, block.size.y) * k;
      if (longest > room) k *= room / longest, shrunk[i] = 1;
      items_[i] = make_item(block, k);
      needs[i] = items_[i].shape.count_dilated(gutter_ / 2);
    });
    total_ = 0;
    for (const std::size_t need : needs) total_ += static_cast<double>(need);
    order_.resize(blocks_.size());
    std::iota(order_.begin(), order_.end(), 0u);
    const auto key = [&](uint32_t i) {
      const Shape& s = items_[i].shape;
      return std::tuple(-s.height(), -s.width(), i);
    };
    std::sort(order_.begin(), order_.end(), [&](uint32_t a, uint32_t b) { return key(a) < key(b); });
    return static_cast<std::size_t>(std::count(shrunk.begin(), shrunk.end(), 1));
  }

  /// Texels that all blocks need, half gutters included.
  double total() const { return total_; }
  bool fits(int width, int height) const {
    return std::ranges::all_of(items_, [&](const Item& item) {
      return item.shape.width() + gutter_ <= width && item.shape.height() + gutter_ <= height;
    });
  }

  /// Every block on the first page that has room, larger ones first. Nothing when more than `most_pages` are
  /// needed.
  std::optional<Packing> pack(int width, int height, int most_pages) const {
    Packing packing;
    packing.width = width;
    packing.height = height;
    packing.density = density_;
    packing.blocks.resize(blocks_.size());
    std::vector<PageBits> pages;
    for (const uint32_t i : order_) {
      const Item& item = items_[i];
      std::optional<std::pair<int, int>> place;
      std::size_t page = 0;
      while (!place && page < pages.size()) place = pages[page++].place(item.shape);
      if (!place) {
        if (static_cast<int>(pages.size()) == most_pages) return std::nullopt;
        pages.emplace_back(width, height, gutter_);
        place = pages.back().place(item.shape);
        page = pages.size();
        if (!place) return std::nullopt;
      }
      const Vec2 corner(static_cast<float>(place->first), static_cast<float>(place->second));
      packing.blocks[i] = {static_cast<int>(page) - 1, corner + item.margin, item.texels_per_metre};
    }
    packing.pages = static_cast<int>(pages.size());
    return packing;
  }

 private:
  Item make_item(const Block& block, float k) const {
    const int width = texels(block.size.x * k), height = texels(block.size.y * k);
    // Centred in its texels, so that it touches no more of them than it must.
    const Vec2 margin = 0.5f * (Vec2(static_cast<float>(width), static_cast<float>(height)) - block.size * k);
    Shape shape(width, height);
    for (const uint32_t c : block.charts) {
      for (auto uv : charts_[c].uv) {
        for (Vec2& p : uv) p = margin + p * k;
        // Stricter than when texels are found: far from the page's corner coordinates are rounder.
        cover_texels(
            uv, width, height, [&](int x, int y) { shape.set(x, y); }, 0.4f * kTouch);
      }
    }
    shape.seal();
    return {std::move(shape), margin, k};
  }

  const std::vector<Block>& blocks_;
  const std::vector<Chart>& charts_;
  int gutter_;
  float density_ = 0;
  double total_ = 0;
  std::vector<Item> items_;
  std::vector<uint32_t> order_;
};

Packing pack_best_size(const Packer& packer, int max_page) {
  // The least memory; every further page costs a little, as it is one more file and one more draw call.
  struct Candidate {
    double cost;
    int width, height;
  };
  const auto cost = [](double pages, int width, int height) {
    return pages * width * height * (1 + kPageCost * (pages - 1));
  };
  std::vector<Candidate> candidates;
  for (int width = 16; width <= max_page; width *= 2) {
    for (int height = std::max(16, width / 4); height <= width; height *= 2) {
      if (!packer.fits(width, height)) continue;
      const double pages = std::ceil(packer.total() / (kFillable * width * height));
      candidates.push_back({cost(pages, width, height), width, height});
    }
  }
  if (candidates.empty()) candidates.push_back({0.0, max_page, max_page});
  std::ranges::stable_sort(candidates, {}, &Candidate::cost);
  std::optional<Packing> best;
  double best_cost = 1e300;
  int tries = 0;
  for (const auto& [bound, width, height] : candidates) {
    if (best && (bound >= best_cost || ++tries > kTries)) break;
    int most_pages = kManyPages;
    while (most_pages > 1 && best && cost(most_pages, width, height) >= best_cost) --most_pages;
    auto packing = packer.pack(width, height, most_pages);
    if (!packing) continue;
    const double real = cost(packing->pages, width, height);
    if (real < best_cost) best = std::move(packing), best_cost = real;
  }
  if (!best) throw Error("atlas", "the charts do not fit pages of " + std::to_string(max_page) + " texels");
  return *best;
}

Packing pack_density(Packer& packer, const AtlasParams& params, std::vector<std::string>& warnings) {
  const int most = params.page_size > 0 ? params.page_size : params.max_page;
  const std::size_t shrunk = packer.set_density(params.density, most);
  if (shrunk > 0)
    warnings.push_back(std::to_string(shrunk) + " charts are longer than a page of " + std::to_string(most) +
                       " texels and are baked at lower density");
  if (params.page_size == 0) return pack_best_size(packer, params.max_page);
  if (auto packing = packer.pack(params.page_size, params.page_size, kManyPages)) return *packing;
  throw Error("atlas",
              "a page of " + std::to_string(params.page_size) + " texels is too small for the charts");
}

Packing pack_one_page(Packer& packer, const std::vector<Block>& blocks, const std::vector<Chart>& charts,
                      int page) {
  double area = 0;
  for (const Block& block : blocks)
    for (const uint32_t c : block.charts)
      area += charts[c].area * static_cast<double>(block.scale * block.scale);
  const double side = page;
  double high = side / std::sqrt(std::max(area, 1e-20)), low = 0;
  std::optional<Packing> best;
  for (int i = 0; i < 24 && high - low > 0.01 * high; ++i) {
    const double density = low > 0 ? 0.5 * (low + high) : 0.75 * high;
    packer.set_density(static_cast<float>(density), page);
    std::optional<Packing> packing;
    if (packer.total() <= kFillable * side * side) packing = packer.pack(page, page, 1);
    if (packing) {
      best = std::move(packing);
      low = density;
    } else {
      high = density;
    }
  }
  if (!best)
    throw Error("atlas", "a page of " + std::to_string(page) + " texels is too small for " +
                             std::to_string(blocks.size()) + " charts");
  return *best;
}

}  // namespace

Packing pack(const std::vector<Block>& blocks, const std::vector<Chart>& charts, const AtlasParams& params,
             std::vector<std::string>& warnings) {
  Packer packer(blocks, charts, std::max(2, params.gutter));
  if (params.density > 0) return pack_density(packer, params, warnings);
  return pack_one_page(packer, blocks, charts, params.page_size);
}

}  // namespace sconce
