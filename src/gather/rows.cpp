// SPDX-License-Identifier: Apache-2.0
#include "gather/rows.h"

#include <algorithm>
#include <atomic>

#include "core/parallel.h"
#include "core/sobol.h"

namespace sconce {

Gathered gather(const World& world, const Tracer& tracer, const GatherCloud& cloud, int rays, uint32_t seed,
                const DirectLight& direct, const Progress& progress) {
  constexpr std::size_t kBlock = 256;
  const std::size_t blocks = (cloud.size() + kBlock - 1) / kBlock;
  std::vector<SparseRows> parts(blocks);
  const std::size_t width = 3 * direct.groups;
  Gathered result;
  result.rows.unit = 1.0f / static_cast<float>(rays);
  result.once.assign(width * cloud.size(), 0.0f);
  std::atomic<uint64_t> done = 0;
  parallel_for(blocks, 1, [&](std::size_t block) {
    progress.check();
    SparseRows& part = parts[block];
    std::vector<uint32_t> met;
    std::vector<double> sums(width), once(width);
    for (std::size_t i = block * kBlock; i < std::min(cloud.size(), (block + 1) * kBlock); ++i) {
      const Footprint footprint = cloud.footprint(i);
      const uint32_t stream = mix32(mix32(seed, 0x726f7773u), footprint.id);
      std::fill(once.begin(), once.end(), 0.0);
      met.clear();
      for (uint32_t r = 0; r < static_cast<uint32_t>(rays); ++r) {
        const SurfacePoint at = footprint.sample(sobol_pair(r, 0, stream));
        const Vec3 direction = Frame(at.shading_normal).to_world(square_to_cosine(sobol_pair(r, 1, stream)));
        if (!(glm::dot(direction, at.geometric_normal) > 0)) continue;
        const Hit hit =
            tracer.closest({offset_origin(at.position, at.geometric_normal, direction), direction});
        if (!hit || !cloud.reflects(hit)) continue;
        const uint32_t cell = cloud.cell(hit);
        met.push_back(cloud.owner(cell).sample);
        if (width == 0) continue;
        if (cloud.owner(cell).trust == Trust::whole) {
          for (std::size_t c = 0; c < width; ++c)
            sums[c] = static_cast<double>(direct.on_cells[width * cell + c]);
        } else {
          std::fill(sums.begin(), sums.end(), 0.0);
          direct.at_point(surface_point(world, hit), mix32(stream, r), sums);
        }
        const Rgb& albedo = cloud.cell_albedo(cell);
        for (std::size_t c = 0; c < width; c += 3) {
          once[c] += static_cast<double>(albedo.r) * sums[c];
          once[c + 1] += static_cast<double>(albedo.g) * sums[c + 1];
          once[c + 2] += static_cast<double>(albedo.b) * sums[c + 2];
        }
      }
      for (std::size_t c = 0; c < width; ++c) result.once[width * i + c] = static_cast<float>(once[c] / rays);
      std::sort(met.begin(), met.end());
      for (std::size_t k = 0; k < met.size();) {
        std::size_t end = k;
        while (end < met.size() && met[end] == met[k]) ++end;
        part.columns.push_back(met[k]);
        part.counts.push_back(static_cast<uint16_t>(end - k));
        k = end;
      }
      part.first.push_back(part.columns.size());
    }
    progress.at("gather rows", ++done, blocks);
  });
  SparseRows& rows = result.rows;
  for (SparseRows& part : parts) {
    const uint64_t base = rows.columns.size();
    for (std::size_t i = 1; i < part.first.size(); ++i) rows.first.push_back(base + part.first[i]);
    rows.columns.insert(rows.columns.end(), part.columns.begin(), part.columns.end());
    rows.counts.insert(rows.counts.end(), part.counts.begin(), part.counts.end());
    part = {};
  }
  return result;
}

namespace {

/// next = add + K (rho light), `width` numbers per sample, three channels in turn.
void sweep(const SparseRows& rows, const GatherCloud& cloud, std::span<const float> add,
           std::vector<float>& light, std::vector<float>& exitance) {
  const std::size_t n = cloud.size(), width = light.size() / n;
  parallel_for(n, 512, [&](std::size_t i) {
    const Rgb& albedo = cloud.albedo(i);
    for (std::size_t c = i * width; c < (i + 1) * width; c += 3) {
      exitance[c] = albedo.r * light[c];
      exitance[c + 1] = albedo.g * light[c + 1];
      exitance[c + 2] = albedo.b * light[c + 2];
    }
  });
  parallel_for(n, 64, [&](std::size_t i) {
    rows.apply(i, exitance, std::span(light).subspan(i * width, width));
    if (!add.empty())
      for (std::size_t c = i * width; c < (i + 1) * width; ++c) light[c] += add[c];
  });
}

}  // namespace

int enough_bounces(const SparseRows& rows, const GatherCloud& cloud, double tolerance) {
  constexpr int kMost = 1000;
  std::vector<float> light(3 * cloud.size(), 1.0f), exitance(light.size());
  double before[3] = {0, 0, 0};
  for (int bounces = 0; bounces < kMost; ++bounces) {
    double still = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      double left = 0;
      for (std::size_t i = 0; i < cloud.size(); ++i) left += static_cast<double>(light[3 * i + c]);
      left /= static_cast<double>(cloud.size());
      // All that is still to come, were it to fall off from now on as in the last bounce.
      const double ratio = before[c] > 0 ? left / before[c] : 1;
      still = std::max(still, ratio < 1 ? left / (1 - ratio) : left > 0 ? 1.0 : 0.0);
      before[c] = left;
    }
    if (still <= tolerance) return bounces;
    sweep(rows, cloud, {}, light, exitance);
  }
  return kMost;
}

std::vector<float> bounce(const SparseRows& rows, const GatherCloud& cloud, std::span<const float> once,
                          int bounces, const Progress& progress) {
  std::vector<float> light(once.size()), exitance(once.size());
  if (bounces > 0) light.assign(once.begin(), once.end());
  for (int i = 1; i < bounces; ++i) {
    progress.check();
    progress.at("bounces", static_cast<uint64_t>(i), static_cast<uint64_t>(bounces));
    sweep(rows, cloud, once, light, exitance);
  }
  return light;
}

}  // namespace sconce
