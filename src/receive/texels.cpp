// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <atomic>

#include "core/parallel.h"
#include "receive/atlas.h"
#include "receive/buried.h"
#include "receive/raster.h"

namespace sconce {

namespace {

/// Texels covered by any side, ascending, and the sides of each, ascending.
struct Coverage {
  std::vector<uint32_t> texels, first, sides;

  std::span<const uint32_t> of(std::size_t i) const {
    return {sides.data() + first[i], sides.data() + first[i + 1]};
  }
};

Coverage cover(const Atlas& atlas) {
  const std::size_t width = static_cast<std::size_t>(atlas.width),
                    page = width * static_cast<std::size_t>(atlas.height);
  const std::size_t total = page * static_cast<std::size_t>(atlas.pages), sides = 2 * atlas.front.size();
  constexpr std::size_t kGrain = 4096;
  const auto for_each = [&](auto&& f) {
    parallel_for((sides + kGrain - 1) / kGrain, 1, [&](std::size_t block) {
      for (std::size_t s = block * kGrain; s < std::min(sides, (block + 1) * kGrain); ++s) {
        const TexelTriangle& t = side_of(atlas, static_cast<uint32_t>(s));
        if (t.page < 0) continue;
        const std::size_t base = page * static_cast<std::size_t>(t.page);
        cover_texels(t.uv, atlas.width, atlas.height, [&](int x, int y) {
          f(base + static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x),
            static_cast<uint32_t>(s));
        });
      }
    });
  };
  std::vector<uint32_t> cursor(total, 0);
  for_each([&](std::size_t texel, uint32_t) {
    std::atomic_ref(cursor[texel]).fetch_add(1, std::memory_order_relaxed);
  });
  Coverage result;
  uint32_t sum = 0;
  for (std::size_t texel = 0; texel < total; ++texel) {
    const uint32_t n = cursor[texel];
    if (n == 0) continue;
    result.texels.push_back(static_cast<uint32_t>(texel));
    result.first.push_back(sum);
    cursor[texel] = sum;
    sum += n;
  }
  result.first.push_back(sum);
  result.sides.resize(sum);
  for_each([&](std::size_t texel, uint32_t side) {
    result.sides[std::atomic_ref(cursor[texel]).fetch_add(1, std::memory_order_relaxed)] = side;
  });
  parallel_for(result.texels.size(), 8192, [&](std::size_t i) {
    std::sort(result.sides.begin() + result.first[i], result.sides.begin() + result.first[i + 1]);
  });
  return result;
}

/// values[i] = f(i) for all of them, in blocks that ranks share; check() before each block.
template <class T, class F, class Check>
void fill(std::vector<T>& values, const Ranks& ranks, const F& f, const Check& check) {
  constexpr std::size_t kBlock = 2048;
  const std::size_t blocks = (values.size() + kBlock - 1) / kBlock;
  parallel_for(blocks, 1, [&](std::size_t block) {
    if (!ranks.mine(block)) return;
    check(blocks);
    for (std::size_t i = block * kBlock; i < std::min(values.size(), (block + 1) * kBlock); ++i)
      values[i] = f(i);
  });
  ranks.share(std::span(values), kBlock);
}

/// Texels that need a closer look: those where a first look met something, and their neighbours.
std::vector<uint8_t> suspects(const Atlas& atlas, const Coverage& coverage, const BurialTest& test,
                              const Progress& progress, const Ranks& ranks) {
  const std::size_t n = coverage.texels.size();
  std::vector<uint8_t> found(n, 0);
  std::atomic<uint64_t> done = 0;
  fill(
      found, ranks,
      [&](std::size_t i) -> uint8_t { return test.clearly_free(coverage.texels[i], coverage.of(i)) ? 0 : 1; },
      [&](std::size_t blocks) {
        progress.check();
        progress.at("texels", ++done, blocks);
      });
  std::vector<uint8_t> result = found;
  const auto width = static_cast<uint32_t>(atlas.width);
  parallel_for(n, 2048, [&](std::size_t i) {
    if (found[i] != 0) return;
    for (const int64_t step : {-1 - int64_t{width}, -int64_t{width}, 1 - int64_t{width}, int64_t{-1},
                               int64_t{1}, int64_t{width} - 1, int64_t{width}, int64_t{width} + 1}) {
      const int64_t texel = int64_t{coverage.texels[i]} + step;
      const auto it = std::lower_bound(coverage.texels.begin(), coverage.texels.end(), texel);
      if (it != coverage.texels.end() && *it == texel &&
          found[static_cast<std::size_t>(it - coverage.texels.begin())] != 0)
        result[i] = 1;
    }
  });
  return result;
}

}  // namespace

TexelReceivers::TexelReceivers(const World& world, const Tracer& tracer, Atlas& atlas,
                               const Progress& progress, const Ranks& ranks, bool all)
    : world_(&world), tracer_(&tracer), atlas_(&atlas) {
  const Coverage coverage = cover(atlas);
  const std::size_t n = coverage.texels.size();
  const BurialTest test(world, tracer, atlas);
  const std::vector<uint8_t> suspect = suspects(atlas, coverage, test, progress, ranks);
  std::vector<uint16_t> cells(n, kAllCells);
  fill(
      cells, ranks,
      [&](std::size_t i) {
        return suspect[i] != 0 ? test.free_cells(coverage.texels[i], coverage.of(i)) : kAllCells;
      },
      [&](std::size_t) { progress.check(); });

  // A chart that probe rays reach, yet whose every point seems buried, lies in a crack: dark, but there to be
  // seen.
  std::vector<uint8_t> alive(atlas.seen_charts.size(), 0);
  const auto chart_of = [&](std::size_t i) {
    return side_of(atlas, coverage.sides[coverage.first[i]]).chart;
  };
  for (std::size_t i = 0; i < n; ++i)
    if (cells[i] != 0) alive[chart_of(i)] = 1;
  first_.push_back(0);
  for (std::size_t i = 0; i < n; ++i) {
    const uint32_t chart = chart_of(i);
    if (cells[i] == 0 && alive[chart] == 0 && atlas.seen_charts[chart] != 0) cells[i] = kAllCells;
    if (cells[i] == 0 && !all) continue;
    texels_.push_back(coverage.texels[i]);
    cells_.push_back(cells[i] != 0 ? cells[i] : kAllCells);
    for (const uint32_t side : coverage.of(i)) sides_.push_back(side);
    first_.push_back(static_cast<uint32_t>(sides_.size()));
  }
  atlas.report.texels = n;
  atlas.report.invalid = n - texels_.size();
  const double room = static_cast<double>(atlas.width) * atlas.height * atlas.pages;
  atlas.report.utilisation = room > 0 ? static_cast<double>(n) / room : 0;
}

Footprint TexelReceivers::footprint(std::size_t i) const {
  Footprint result;
  result.kind = ReceiverKind::texel;
  result.id = texels_[i];
  const std::span<const uint32_t> sides(sides_.data() + first_[i], sides_.data() + first_[i + 1]);
  const TexelRect rect = texel_rect(*atlas_, texels_[i]);
  const uint16_t cells = cells_[i];
  if (cells == kAllCells) {
    clip_to_rect(*world_, *atlas_, sides, rect, result.pieces);
  } else {
    for (int row = 0; row < kCells; ++row) {
      for (int x = 0; x < kCells; ++x) {
        const auto free = [&](int column) { return ((cells >> (row * kCells + column)) & 1) != 0; };
        if (!free(x)) continue;
        // Neighbouring cells of a row are clipped as one.
        TexelRect run = cell_rect(rect, row * kCells + x);
        while (x + 1 < kCells && free(x + 1)) run.hi.x = cell_rect(rect, row * kCells + ++x).hi.x;
        clip_to_rect(*world_, *atlas_, sides, run, result.pieces);
      }
    }
  }
  if (result.pieces.empty()) result.pieces.push_back(whole_side(*world_, sides.front()));
  result.area = finish(result.pieces);
  return result;
}

bool TexelReceivers::covered(std::size_t i) const {
  const std::span<const uint32_t> sides(sides_.data() + first_[i], sides_.data() + first_[i + 1]);
  const BurialTest test(*world_, *tracer_, *atlas_);
  return !test.clearly_free(texels_[i], sides) && test.free_cells(texels_[i], sides) == 0;
}

Rgb TexelReceivers::albedo(const Scene& scene, std::size_t i) const {
  const TexelRect rect = texel_rect(*atlas_, texels_[i]);
  Rgb sum;
  float total = 0;
  for (uint32_t k = first_[i]; k < first_[i + 1]; ++k) {
    const uint32_t triangle = sides_[k] / 2;
    std::vector<FootprintPiece> pieces;
    clip_to_rect(*world_, *atlas_, {&sides_[k], 1}, rect, pieces);
    if (pieces.empty() && first_[i + 1] - first_[i] == 1) pieces.push_back(whole_side(*world_, sides_[k]));
    const auto& v = world_->triangles[triangle].v;
    const Vec3 p0 = world_->positions[v[0]], e1 = world_->positions[v[1]] - p0,
               e2 = world_->positions[v[2]] - p0;
    const Vec3 normal = glm::cross(e1, e2);
    for (const FootprintPiece& piece : pieces) {
      const Vec3 d = (piece.p0 + piece.p1 + piece.p2) / 3.0f - p0;
      const float scale = 1.0f / glm::dot(normal, normal);
      const Vec2 barycentric(scale * glm::dot(glm::cross(d, e2), normal),
                             scale * glm::dot(glm::cross(e1, d), normal));
      sum += piece.cumulative * shade(scene, *world_, triangle, barycentric).receiver_albedo();
      total += piece.cumulative;
    }
  }
  return total > 0 ? sum / total : Rgb(0);
}

}  // namespace sconce
