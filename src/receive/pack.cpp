// SPDX-License-Identifier: Apache-2.0
#include "receive/pack.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <tuple>

#include "core/error.h"

#define STB_RECT_PACK_IMPLEMENTATION
#define STBRP_STATIC
#include <stb/stb_rect_pack.h>

namespace sconce {

namespace {

constexpr int kManyPages = 4096;
constexpr int kTries = 6;           // page sizes tried after the first that works
constexpr double kPageCost = 0.15;  // of a page's texels, for every page after the first

/// Texels that a length covers when it is centred in them.
int texels(float length) {
  return std::max(1, static_cast<int>(std::ceil(length - 1e-3f)));
}

struct Box {
  int width, height;  // with gutter
  float texels_per_metre;
};

class Packer {
 public:
  Packer(const std::vector<Block>& blocks, int gutter) : blocks_(blocks), gutter_(gutter) {}

  /// Boxes at a density; a block larger than a page is made to fit. Counts those.
  std::size_t set_density(float density, int page) {
    std::size_t shrunk = 0;
    boxes_.clear();
    density_ = density;
    const auto room = static_cast<float>(page - gutter_ - 1);
    for (const Block& block : blocks_) {
      float k = density * block.scale;
      const float longest = std::max(block.size.x, block.size.y) * k;
      if (longest > room) k *= room / longest, ++shrunk;
      boxes_.push_back({texels(block.size.x * k) + gutter_, texels(block.size.y * k) + gutter_, k});
    }
    return shrunk;
  }

  double total() const {
    double sum = 0;
    for (const Box& box : boxes_) sum += static_cast<double>(box.width) * static_cast<double>(box.height);
    return sum;
  }
  bool fits(int width, int height) const {
    return std::ranges::all_of(boxes_,
                               [&](const Box& box) { return box.width <= width && box.height <= height; });
  }

  /// Nothing when more than `most_pages` are needed.
  std::optional<Packing> pack(int width, int height, int most_pages) const {
    Packing packing;
    packing.width = width;
    packing.height = height;
    packing.density = density_;
    packing.blocks.resize(blocks_.size());
    std::vector<stbrp_rect> open;
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      stbrp_rect rect{};
      rect.id = static_cast<int>(i);
      rect.w = static_cast<stbrp_coord>(boxes_[i].width);
      rect.h = static_cast<stbrp_coord>(boxes_[i].height);
      open.push_back(rect);
    }
    std::vector<stbrp_node> nodes(static_cast<std::size_t>(width));
    while (!open.empty()) {
      if (packing.pages == most_pages) return std::nullopt;
      stbrp_context context;
      stbrp_init_target(&context, width, height, nodes.data(), width);
      stbrp_pack_rects(&context, open.data(), static_cast<int>(open.size()));
      std::vector<stbrp_rect> rest;
      for (const stbrp_rect& rect : open) {
        if (!rect.was_packed) {
          rest.push_back(rect);
          continue;
        }
        const auto i = static_cast<std::size_t>(rect.id);
        packing.blocks[i] = place(i, packing.pages, rect.x, rect.y);
      }
      if (rest.size() == open.size()) return std::nullopt;
      open = std::move(rest);
      ++packing.pages;
    }
    return packing;
  }

 private:
  Placement place(std::size_t i, int page, int x, int y) const {
    const Box& box = boxes_[i];
    // Centred in its texels, so that it touches no more of them than it must.
    const Vec2 inner(static_cast<float>(box.width - gutter_), static_cast<float>(box.height - gutter_));
    const Vec2 margin = 0.5f * (inner - blocks_[i].size * box.texels_per_metre);
    const Vec2 corner(static_cast<float>(x + gutter_ / 2), static_cast<float>(y + gutter_ / 2));
    return {page, corner + margin, box.texels_per_metre};
  }

  const std::vector<Block>& blocks_;
  int gutter_;
  float density_ = 0;
  std::vector<Box> boxes_;
};

Packing pack_density(Packer& packer, const AtlasParams& params, std::vector<std::string>& warnings) {
  const int most = params.page_size > 0 ? params.page_size : params.max_page;
  const std::size_t shrunk = packer.set_density(params.density, most);
  if (shrunk > 0)
    warnings.push_back(std::to_string(shrunk) + " charts are longer than a page of " + std::to_string(most) +
                       " texels and are baked at lower density");
  if (params.page_size > 0) {
    if (auto packing = packer.pack(params.page_size, params.page_size, kManyPages)) return *packing;
    throw Error("atlas",
                "a page of " + std::to_string(params.page_size) + " texels is too small for the charts");
  }
  // The least memory; every further page costs a little, as it is one more file and one more draw call.
  struct Candidate {
    double cost;
    int width, height;
  };
  const auto cost = [](double pages, int width, int height) {
    return pages * width * height * (1 + kPageCost * (pages - 1));
  };
  std::vector<Candidate> candidates;
  for (int width = 16; width <= params.max_page; width *= 2) {
    for (int height = std::max(16, width / 4); height <= width; height *= 2) {
      if (!packer.fits(width, height)) continue;
      const double pages = std::ceil(packer.total() / (static_cast<double>(width) * height));
      candidates.push_back({cost(pages, width, height), width, height});
    }
  }
  if (candidates.empty()) candidates.push_back({0.0, params.max_page, params.max_page});
  std::ranges::stable_sort(candidates, {}, &Candidate::cost);
  std::optional<Packing> best;
  double best_cost = 0;
  int tries = 0;
  for (const auto& [bound, width, height] : candidates) {
    if (best && (bound >= best_cost || ++tries > kTries)) break;
    auto packing = packer.pack(width, height, kManyPages);
    if (!packing) continue;
    const double real = cost(packing->pages, width, height);
    if (!best || real < best_cost) best = std::move(packing), best_cost = real;
  }
  if (!best)
    throw Error("atlas", "the charts do not fit pages of " + std::to_string(params.max_page) + " texels");
  return *best;
}

Packing pack_one_page(Packer& packer, const std::vector<Block>& blocks, int page) {
  double area = 0;
  for (const Block& block : blocks)
    area += static_cast<double>(block.size.x * block.scale) * static_cast<double>(block.size.y * block.scale);
  const double side = page;
  double high = side / std::sqrt(std::max(area, 1e-20)), low = 0;
  std::optional<Packing> best;
  for (int i = 0; i < 24 && (high - low > 0.005 * high); ++i) {
    const double density = low > 0 ? 0.5 * (low + high) : 0.7 * high;
    packer.set_density(static_cast<float>(density), page);
    std::optional<Packing> packing;
    if (packer.total() <= side * side) packing = packer.pack(page, page, 1);
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

Packing pack(const std::vector<Block>& blocks, const AtlasParams& params,
             std::vector<std::string>& warnings) {
  const int gutter = std::max(2, params.gutter);
  Packer packer(blocks, gutter);
  if (params.density > 0) return pack_density(packer, params, warnings);
  const int page = params.page_size > 0 ? params.page_size : params.max_page;
  return pack_one_page(packer, blocks, page);
}

}  // namespace sconce
