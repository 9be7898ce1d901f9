// SPDX-License-Identifier: Apache-2.0
#include "picture/hits.h"

#include <atomic>
#include <cmath>

#include "core/error.h"
#include "core/parallel.h"
#include "core/sobol.h"
#include "encode/half.h"
#include "picture/render.h"
#include "picture/seen.h"

namespace sconce {

namespace {

constexpr uint32_t kPaneStream = 0x70616e65u;

/// At the far edge the place is whole rather than the texel one further, so that four texels always exist.
void set_place(CameraHits::Pixel& pixel, Vec2 uv, const CameraHits& hits) {
  const TexelPlace at[] = {{uv.x, hits.page_width}, {uv.y, hits.page_height}};
  const int last[] = {std::max(hits.page_width - 2, 0), std::max(hits.page_height - 2, 0)};
  std::array<uint32_t, 2> low{};
  for (std::size_t i = 0; i < 2; ++i) {
    const int kept = std::min(at[i].low, last[i]);
    const float place = at[i].fraction + static_cast<float>(at[i].low - kept);
    low[i] = static_cast<uint32_t>(kept);
    pixel.place[i] = static_cast<uint16_t>(place * static_cast<float>(CameraHits::kWhole) + 0.5f);
  }
  pixel.texel = low[1] * static_cast<uint32_t>(hits.page_width) + low[0];
}

}  // namespace

CameraHits View::hits(const Camera& camera, const PictureParams& params, int s,
                      const Progress& progress) const {
  static_assert(sizeof(CameraHits::Pixel) == 16);
  params.check();
  const Lens lens(camera, params);
  const Manifest& m = package_->manifest();
  if (m.pages > 65535) throw Error(package_->path().string(), "has too many pages for cached camera hits");
  CameraHits hits;
  hits.width = params.width, hits.height = params.height;
  hits.pages = m.pages, hits.page_width = m.width, hits.page_height = m.height;
  hits.groups = m.groups.size();
  const auto rows = static_cast<std::size_t>(params.height);
  hits.pixels.resize(rows * static_cast<std::size_t>(params.width));
  std::vector<std::vector<CameraHits::Shine>> shines(rows);

  const auto meet = [&](int x, std::size_t y) {
    const Ray ray{lens.eye(), lens.direction(ray_point(params, x, static_cast<int>(y), s))};
    // Whether a pane or what is behind it is seen goes by chance: right over many samples.
    const auto id = static_cast<uint32_t>(y) * static_cast<uint32_t>(params.width) + static_cast<uint32_t>(x);
    const auto [hit, passed] = tracer_.follow(
        ray, [&] { return sobol_pair(static_cast<uint32_t>(s), 0, mix32(id, params.seed ^ kPaneStream)).x; });
    Shade surface;
    if (hit) {
      surface = shade(scene(), world(), hit.triangle, hit.barycentric);
      const LightmapSide& side = (hit.back ? shown_.back : shown_.front)[hit.triangle];
      if (side.page >= 0) {
        CameraHits::Pixel& pixel =
            hits.pixels[y * static_cast<std::size_t>(params.width) + static_cast<std::size_t>(x)];
        pixel.page = static_cast<uint16_t>(side.page);
        set_place(pixel, side.at(hit.barycentric), hits);
        const Rgb albedo = passed * surface.base_color * kInvPi;  // metals as if matt
        pixel.albedo = {float_to_half(albedo.r), float_to_half(albedo.g), float_to_half(albedo.b)};
      }
    }
    for_each_shine(scene(), world(), ray, hit, surface.emission, [&](Id<LightGroup> group, const Rgb& shine) {
      if (!shine.is_black()) shines[y].push_back({static_cast<uint32_t>(x), group, passed * shine});
    });
  };
  std::atomic<std::size_t> done = 0;
  progress.at("camera rays", 0, rows);
  parallel_for(rows, 4, [&](std::size_t y) {
    progress.check();
    for (int x = 0; x < params.width; ++x) meet(x, y);
    progress.at("camera rays", ++done, rows);
  });
  for (const auto& row : shines) {
    hits.shines.insert(hits.shines.end(), row.begin(), row.end());
    hits.row_end.push_back(hits.shines.size());
  }
  return hits;
}

}  // namespace sconce
