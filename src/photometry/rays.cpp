// SPDX-License-Identifier: Apache-2.0
#include "photometry/rays.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "photometry/ray_formats.h"

namespace sconce {

RayLight RayColors::of_wavelength(float wavelength, float flux, bool watts) {
  const auto length = static_cast<double>(wavelength);
  const Xyz eye = observer(length < 100 ? 1000 * length : length);
  return {watts ? static_cast<float>(static_cast<double>(flux) * kLumensPerWatt * eye[1]) : flux,
          color_of(eye)};
}

RayLight RayColors::of(const float* v, float flux) const {
  switch (by) {
    case By::wavelength:
      return of_wavelength(v[column], flux, watts);
    case By::tristimulus:
      return {flux, color_of({static_cast<double>(v[column]), static_cast<double>(flux),
                              static_cast<double>(v[column + 1])})};
    case By::spectrum: {
      const float number = v[column];
      if (!(number >= 1 && number <= static_cast<float>(spectra.size()))) return {flux};
      const Xyz& eye = spectra[static_cast<std::size_t>(number) - 1];
      return {watts ? static_cast<float>(static_cast<double>(flux) * kLumensPerWatt * eye[1]) : flux,
              color_of(eye)};
    }
    default:
      return {flux};
  }
}

std::string one_wavelength(float wavelength) {
  return fmt::format("all rays have the wavelength {:g}: taken for a mark and not for their colour",
                     wavelength);
}

void RayBlocks::add(const Vec3& position, const Vec3& direction, const RayLight& light) {
  const float flux = light.flux;
  ++rays_;
  const float length = glm::length(direction);
  if (!(std::abs(length - 1) < 0.01f) || !std::isfinite(position.x + position.y + position.z) ||
      !(flux >= 0) || !std::isfinite(flux))
    throw Error(where_, fmt::format("holds no ray at number {}", rays_),
                "a unit direction, a place and a flux from 0 on");
  block_.push_back({Vec3(position.x, -position.y, -position.z) * unit_,
                    Vec3(direction.x, -direction.y, -direction.z) / length, flux, light.color});
  if (block_.size() == kBlock) flush();
}

void RayBlocks::flush() {
  if (!block_.empty()) sink_(block_);
  block_.clear();
}

namespace {

/// Keeps a file's colours where they are some, and lumens of its watts then.
void look_at_colors(RayLayout& layout, std::ifstream& in, const std::string& where,
                    const Progress& progress) {
  RayColors& colors = layout.colors;
  if (colors.by == RayColors::By::wavelength) {
    std::vector<float> numbers(std::min<uint64_t>(kLookedAt, layout.file.rays) * layout.numbers);
    in.seekg(static_cast<std::streamoff>(layout.offset));
    in.read(reinterpret_cast<char*>(numbers.data()), static_cast<std::streamsize>(4 * numbers.size()));
    in.clear();
    bool alike = true;
    for (std::size_t i = colors.column; i < numbers.size(); i += layout.numbers)
      alike &= numbers[i] == numbers[colors.column];
    if (alike) {
      if (!numbers.empty()) progress.warn(where + ": " + one_wavelength(numbers[colors.column]));
      colors.by = RayColors::By::none;
    }
  }
  colors.watts = !layout.file.luminous && colors.by != RayColors::By::none;
  if (colors.watts) layout.file.luminous = true;
}

}  // namespace

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
  look_at_colors(layout, in, where, progress);
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
      layout.file.held += static_cast<double>(v[layout.flux]);
      blocks.add(layout.placed ? Vec3(v[0], v[1], v[2]) : layout.origin, {d[0], d[1], d[2]},
                 layout.colors.of(v, v[layout.flux]));
    }
    blocks.flush();
    done += count;
    progress.at("rays", done, rays);
    progress.check();
  }
  return layout.file;
}

}  // namespace sconce
