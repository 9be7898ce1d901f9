// SPDX-License-Identifier: Apache-2.0
#include "photometry/rays.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "photometry/ray_formats.h"

namespace sconce {

void RayBlocks::add(const Vec3& position, const Vec3& direction, float flux) {
  ++rays_;
  const float length = glm::length(direction);
  if (!(std::abs(length - 1) < 0.01f) || !std::isfinite(position.x + position.y + position.z) ||
      !(flux >= 0) || !std::isfinite(flux))
    throw Error(where_, fmt::format("holds no ray at number {}", rays_),
                "a unit direction, a place and a flux from 0 on");
  block_.push_back({Vec3(position.x, -position.y, -position.z) * unit_,
                    Vec3(direction.x, -direction.y, -direction.z) / length, flux});
  if (block_.size() == kBlock) flush();
}

void RayBlocks::flush() {
  if (!block_.empty()) sink_(block_);
  block_.clear();
}

RayFile read_rays(const std::filesystem::path& path,
                  const std::function<void(std::span<const SourceRay>)>& sink, const Progress& progress) {
  const std::string where = path.string();
  std::error_code ec;
  const uint64_t size = std::filesystem::file_size(path, ec);
  std::ifstream in(path, std::ios::binary);
  if (ec || !in) throw Error(where, "cannot be read");
  RayLayout layout;
  try {
    layout = ray_layout(in, size, where);
  } catch (const NotMyFormat& binary) {
    in.clear();
    in.seekg(0);
    try {
      return read_text_rays(in, size, where, sink, progress);
    } catch (const NotMyFormat&) {
      throw binary;
    }
  }
  const uint64_t per_ray = 4 * layout.numbers, rays = layout.file.rays;
  if (size < layout.offset || rays > (size - layout.offset) / per_ray ||
      rays * per_ray + layout.offset + layout.tail != size)
    throw Error(where,
                fmt::format("has {} bytes, which do not fit {} rays of {} numbers after a header of {} bytes",
                            size, rays, layout.numbers, layout.offset));
  if (!layout.assumed.empty()) progress.warn(where + ": " + layout.assumed);
  in.seekg(static_cast<std::streamoff>(layout.offset));
  std::vector<float> numbers(std::min<uint64_t>(RayBlocks::kBlock, rays) * layout.numbers);
  RayBlocks blocks(sink, where, layout.unit);
  const std::size_t direction = layout.placed ? 3 : 0;
  for (uint64_t done = 0; done < rays;) {
    const auto count = static_cast<std::size_t>(std::min<uint64_t>(RayBlocks::kBlock, rays - done));
    in.read(reinterpret_cast<char*>(numbers.data()), static_cast<std::streamsize>(count * per_ray));
    if (!in) throw Error(where, fmt::format("is cut short after ray {}", done));
    for (std::size_t i = 0; i < count; ++i) {
      const float *v = &numbers[i * layout.numbers], *d = v + direction;
      blocks.add(layout.placed ? Vec3(v[0], v[1], v[2]) : layout.origin, {d[0], d[1], d[2]}, v[layout.flux]);
    }
    blocks.flush();
    done += count;
    progress.at("rays", done, rays);
    progress.check();
  }
  return layout.file;
}

}  // namespace sconce
