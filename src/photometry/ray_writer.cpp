// SPDX-License-Identifier: Apache-2.0
#include "photometry/ray_writer.h"

#include <cmath>
#include <cstring>
#include <limits>

#include "core/error.h"
#include "core/observer.h"

namespace sconce {

namespace {

constexpr std::size_t kHeader = 256 + 8 * 4 + 9 * 4000;  // numbers, flags, texts of 1000 UTF-32 characters
constexpr float kMetre = 1000;                           // millimetres

template <class T>
void put(std::string& bytes, std::size_t at, T value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

std::string header(bool luminous, bool colored, uint64_t rays, double flux) {
  std::string out(kHeader, '\0');
  out.replace(0, 4, "TM25");
  put<int32_t>(out, 4, 2013);
  const float none = std::numeric_limits<float>::quiet_NaN();
  put(out, 12, luminous ? static_cast<float>(flux) : none);
  put(out, 16, luminous ? none : static_cast<float>(flux));
  put(out, 20, rays);
  constexpr std::string_view kDate = "1970-01-01T00:00:00+00:00";  // the same rays, the same bytes
  out.replace(28, kDate.size(), kDate);
  for (const std::size_t at : {64, 68, 72}) put(out, at, none);  // wavelengths
  // Place, direction, radiant flux, wavelength, luminous flux, Stokes, X and Z, spectrum.
  put<int32_t>(out, 256, 1), put<int32_t>(out, 260, 1);
  put<int32_t>(out, luminous ? 272 : 264, 1);
  put<int32_t>(out, 280, colored ? 1 : 0);
  return out;
}

}  // namespace

RayWriter::RayWriter(const std::filesystem::path& path, bool luminous, bool colored)
    : path_(path),
      beside_(path),
      out_(beside_.path(), std::ios::binary),
      luminous_(luminous),
      colored_(colored) {
  out_ << header(luminous, colored, 0, 0);
}

void RayWriter::add(std::span<const SourceRay> rays) {
  for (const SourceRay& ray : rays) {
    const Vec3 p = ray.position * kMetre, &d = ray.direction;
    const Xyz xyz = xyz_of(ray.color);
    const auto beside_y = [&](std::size_t i) {
      return static_cast<float>(static_cast<double>(ray.flux) * xyz[i] / xyz[1]);
    };
    const float numbers[] = {p.x, -p.y, -p.z, d.x, -d.y, -d.z, ray.flux, beside_y(0), beside_y(2)};
    out_.write(reinterpret_cast<const char*>(numbers), (colored_ ? 9 : 7) * sizeof(float));
    flux_ += static_cast<double>(ray.flux);
  }
  rays_ += rays.size();
}

void RayWriter::finish() {
  out_.seekp(0);
  out_ << header(luminous_, colored_, rays_, flux_);
  out_.close();
  if (!out_) throw Error(path_.string(), "cannot be written");
  beside_.commit();
}

}  // namespace sconce
