// SPDX-License-Identifier: Apache-2.0
#include "photometry/rays.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <numbers>
#include <vector>

#include "core/error.h"

namespace sconce {

namespace {

static_assert(std::endian::native == std::endian::little, "ray files are little-endian");

constexpr double kMillimetre = 1e-3;
constexpr std::size_t kBlock = 65536;  // rays at a time

/// Where the rays lie in a file and what their numbers mean; position and direction come first everywhere.
struct Layout {
  RayFile file;
  uint64_t offset = 0;        ///< of the first ray, bytes
  uint64_t tail = 0;          ///< bytes after the last ray
  std::size_t numbers = 7;    ///< floats per ray
  std::size_t flux = 6;       ///< index of the flux among them
  double unit = kMillimetre;  ///< of positions, metres
};

class Bytes {
 public:
  explicit Bytes(std::string head) : head_(std::move(head)) {}
  template <class T>
  T at(std::size_t offset) const {
    T v{};
    if (offset + sizeof v <= head_.size()) std::memcpy(&v, head_.data() + offset, sizeof v);
    return v;
  }
  bool starts_with(std::string_view text) const { return head_.starts_with(text); }
  std::size_t size() const { return head_.size(); }

 private:
  std::string head_;
};

/// IES TM-25-13: 256 bytes of numbers, 8 flags of what a ray holds, 9 texts of 1000 UTF-32 characters,
/// spectra, labels of further columns, a text, rays.
Layout tm25(const Bytes& head, std::ifstream& in, const std::string& where) {
  constexpr std::size_t kFlags = 256, kTexts = kFlags + 32, kAfterTexts = kTexts + 9 * 4000;
  if (head.size() < kTexts) throw Error(where, "is cut short in its header", "288 bytes at least");
  Layout out;
  out.file = {"IES TM-25", head.at<uint64_t>(20), true, 0};
  if (const int version = head.at<int32_t>(4); version != 2013)
    throw Error(where, fmt::format("is TM-25 version {}", version), "2013");
  const auto flag = [&](std::size_t i) { return head.at<int32_t>(kFlags + 4 * i) != 0; };
  // Position, direction, radiant flux, wavelength, luminous flux, Stokes (3), tristimulus (2), spectrum
  // index.
  if (!flag(0) || !flag(1)) throw Error(where, "holds rays without position or direction");
  const bool radiant = flag(2), wavelength = flag(3), luminous = flag(4);
  if (!radiant && !luminous) throw Error(where, "holds rays without flux");
  out.file.luminous = luminous;
  // Makers leave it at nothing or not a number.
  if (const float total = head.at<float>(luminous ? 12 : 16); total > 0 && std::isfinite(total))
    out.file.stated = static_cast<double>(total);
  out.flux = 6 + (luminous ? (radiant ? 1u : 0u) + (wavelength ? 1u : 0u) : 0u);
  const int spectra = head.at<int32_t>(76), more = head.at<int32_t>(80), text = head.at<int32_t>(84);
  if (spectra < 0 || more < 0 || text < 0) throw Error(where, "has negative counts in its header");
  out.numbers = 6 + (radiant ? 1u : 0u) + (wavelength ? 1u : 0u) + (luminous ? 1u : 0u) +
                (flag(5) ? 3u : 0u) + (flag(6) ? 2u : 0u) + (flag(7) ? 1u : 0u) +
                static_cast<std::size_t>(more);
  out.offset = kAfterTexts;
  for (int i = 0; i < spectra; ++i) {
    int32_t pairs = -1;
    in.seekg(static_cast<std::streamoff>(out.offset));
    in.read(reinterpret_cast<char*>(&pairs), sizeof pairs);
    if (!in || pairs < 0) throw Error(where, fmt::format("is damaged in spectrum {}", i + 1));
    out.offset += 4 + 8 * static_cast<uint64_t>(pairs);
  }
  out.offset += 2048 * static_cast<uint64_t>(more) + 4 * static_cast<uint64_t>(text);
  return out;
}

/// LightTools' binary ray data: 44 bytes, rays, "LTRFEND". Its layout as the shared examples and their texts
/// show it.
Layout light_tools(const Bytes& head, uint64_t size, const std::string& where) {
  Layout out;
  const int kind = head.at<int32_t>(12), color = head.at<int32_t>(20), units = head.at<int32_t>(24);
  if (color != 0 && color != 2)
    throw Error(where, fmt::format("has the colour code {}", color), "0 (none), 2 (wavelength)");
  if (units != 1) throw Error(where, fmt::format("has the unit code {}", units), "1 (millimetres)");
  out.file = {"LightTools", 0, kind == 1, 0};
  out.numbers = color == 2 ? 8 : 7;
  out.offset = 44;
  out.tail = 7;
  if (size > out.offset + out.tail) out.file.rays = (size - out.offset - out.tail) / (4 * out.numbers);
  return out;
}

/// Zemax: 208 bytes, rays; format 0 has a flux, format 2 a wavelength after it.
Layout zemax(const Bytes& head, const std::string& where) {
  constexpr double kUnits[] = {1, 0.0254, 0.01, 0.3048, kMillimetre};
  Layout out;
  const int units = head.at<int32_t>(136), format = head.at<int32_t>(192), kind = head.at<int32_t>(196);
  if (units < 0 || units > 4) throw Error(where, fmt::format("has the unit code {}", units), "0 to 4");
  if (format != 0 && format != 2) throw Error(where, fmt::format("is Zemax ray format {}", format), "0, 2");
  out.file = {"Zemax", head.at<uint32_t>(4), kind == 1, static_cast<double>(head.at<float>(112))};
  out.numbers = format == 2 ? 8 : 7;
  out.unit = kUnits[units];
  out.offset = 208;
  return out;
}

Layout layout_of(const Bytes& head, std::ifstream& in, uint64_t size, const std::string& where) {
  if (head.starts_with("TM25")) return tm25(head, in, where);
  if (head.starts_with("LTRF")) return light_tools(head, size, where);
  if (head.at<int32_t>(0) == 1010 && head.size() >= 208) return zemax(head, where);
  throw NotMyFormat(where, "is no ray file that can be read", "IES TM-25, LightTools .ray, Zemax .dat");
}

}  // namespace

RayFile read_rays(const std::filesystem::path& path,
                  const std::function<void(std::span<const SourceRay>)>& sink, const Progress& progress) {
  const std::string where = path.string();
  std::error_code ec;
  const uint64_t size = std::filesystem::file_size(path, ec);
  std::ifstream in(path, std::ios::binary);
  if (ec || !in) throw Error(where, "cannot be read");
  std::string start(512, '\0');
  in.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(in.gcount()));
  in.clear();
  const Layout layout = layout_of(Bytes(start), in, size, where);
  const uint64_t per_ray = 4 * layout.numbers, rays = layout.file.rays;
  if (size < layout.offset || rays > (size - layout.offset) / per_ray ||
      rays * per_ray + layout.offset + layout.tail != size)
    throw Error(where,
                fmt::format("has {} bytes, which do not fit {} rays of {} numbers after a header of {} bytes",
                            size, rays, layout.numbers, layout.offset));
  in.seekg(static_cast<std::streamoff>(layout.offset));
  std::vector<float> numbers(std::min<uint64_t>(kBlock, rays) * layout.numbers);
  std::vector<SourceRay> block;
  for (uint64_t done = 0; done < rays;) {
    const auto count = static_cast<std::size_t>(std::min<uint64_t>(kBlock, rays - done));
    in.read(reinterpret_cast<char*>(numbers.data()), static_cast<std::streamsize>(count * per_ray));
    if (!in) throw Error(where, fmt::format("is cut short after ray {}", done));
    block.clear();
    for (std::size_t i = 0; i < count; ++i) {
      const float* v = &numbers[i * layout.numbers];
      const Vec3 direction(v[3], -v[4], -v[5]);
      const float length = glm::length(direction), flux = v[layout.flux];
      if (!(std::abs(length - 1) < 0.01f) || !std::isfinite(v[0] + v[1] + v[2]) || !(flux >= 0) ||
          !std::isfinite(flux))
        throw Error(where, fmt::format("holds no ray at number {}", done + i + 1),
                    "a unit direction, a place and a flux from 0 on");
      block.push_back({Vec3(v[0], -v[1], -v[2]) * static_cast<float>(layout.unit), direction / length, flux});
    }
    sink(block);
    done += count;
    progress.at("rays", done, rays);
    progress.check();
  }
  return layout.file;
}

FarFieldBins::FarFieldBins(int planes, int zones)
    : planes_(planes),
      zones_(zones),
      bins_(static_cast<std::size_t>(planes) * static_cast<std::size_t>(zones + 1)) {}

void FarFieldBins::add(std::span<const SourceRay> rays) {
  for (const SourceRay& ray : rays) {
    const auto [c, gamma] = angles_of(Photometry::Type::c, ray.direction);
    const auto plane = static_cast<std::size_t>(std::lround(c / 360 * planes_) % planes_);
    const auto zone = static_cast<std::size_t>(std::lround(gamma / 180 * zones_));
    const auto flux = static_cast<double>(ray.flux);
    bins_[plane * static_cast<std::size_t>(zones_ + 1) + zone] += flux;
    flux_ += flux;
  }
}

Photometry FarFieldBins::table() const {
  Photometry out;
  out.format = "rays";
  out.absolute = true;
  out.lamps = {LampSet{}};
  const auto zones = static_cast<std::size_t>(zones_) + 1, planes = static_cast<std::size_t>(planes_);
  for (std::size_t g = 0; g < zones; ++g) out.polars.push_back(180.0 * static_cast<double>(g) / zones_);
  const auto solid_angle = [&](std::size_t g) {
    const double half = 0.5 * std::numbers::pi / zones_, at = static_cast<double>(g) * 2 * half;
    return 2 * std::numbers::pi / planes_ *
           (std::cos(std::max(0.0, at - half)) - std::cos(std::min(std::numbers::pi, at + half)));
  };
  for (std::size_t a = 0; a <= planes; ++a) {
    out.azimuths.push_back(360.0 * static_cast<double>(a) / planes_);
    for (std::size_t g = 0; g < zones; ++g) {
      double flux = bins_[a % planes * zones + g], parts = 1;
      // At a pole all planes are one direction.
      if (g == 0 || g + 1 == zones) {
        flux = 0, parts = planes_;
        for (std::size_t other = 0; other < planes; ++other) flux += bins_[other * zones + g];
      }
      out.candela.push_back(flux / parts / solid_angle(g));
    }
  }
  const double scale = flux_ / sconce::flux(out);
  for (double& v : out.candela) v *= scale;
  return out;
}

}  // namespace sconce
