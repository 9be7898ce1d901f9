// SPDX-License-Identifier: Apache-2.0
// What the readers of ray files share. Used by rays.cpp and the formats' own files only.
#pragma once

#include <cstdint>
#include <fstream>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/observer.h"
#include "photometry/rays.h"

namespace sconce {

using RaySink = std::function<void(std::span<const SourceRay>)>;

/// What a ray carries: watts, lumens, and its colour of luminance 1.
struct RayLight {
  float flux;
  Rgb color{1};
};

/// How a file says the colours of its rays. Where it has watts they become lumens by it.
struct RayColors {
  enum class By : uint8_t { none, wavelength, tristimulus, spectrum } by = By::none;
  std::size_t column = 0;    ///< wavelength; X, with Z after it; number of the spectrum, from 1 on
  bool watts = false;        ///< fluxes are watts, to be lumens
  std::vector<Xyz> spectra;  ///< colour matching functions in the mean over each

  /// @param v  numbers of a ray
  RayLight of(const float* v, float flux) const;
  /// Wavelengths of 100 and more are nanometres, others micrometres.
  static RayLight of_wavelength(float wavelength, float flux, bool watts);
};

/// How many rays at a file's begin tell whether wavelengths are colours: where they are all alike, the
/// wavelength is a mark that programs want, and a lamp of one line would be no lamp.
inline constexpr std::size_t kLookedAt = 1000;
/// What is said then.
std::string one_wavelength(float wavelength);

/// Checks rays as a file gives them, turns them into the luminaire's frame and hands them on in blocks, so
/// that memory does not grow with the file.
class RayBlocks {
 public:
  static constexpr std::size_t kBlock = 65536;

  /// @param unit  of positions, metres
  RayBlocks(const RaySink& sink, std::string where, double unit)
      : sink_(sink), where_(std::move(where)), unit_(static_cast<float>(unit)) {}

  /// @param direction  unit within 1 % @throws Error naming the ray
  void add(const Vec3& position, const Vec3& direction, const RayLight& light);
  void flush();
  uint64_t rays() const { return rays_; }

 private:
  const RaySink& sink_;
  std::string where_;
  float unit_;
  uint64_t rays_ = 0;
  std::vector<SourceRay> block_;
};

/// Where the rays lie in a binary file and what their numbers (32-bit floats) mean.
struct RayLayout {
  RayFile file;
  uint64_t offset = 0;      ///< of the first ray, bytes
  uint64_t tail = 0;        ///< bytes after the last ray
  std::size_t numbers = 7;  ///< floats per ray
  bool placed = true;       ///< a position comes before the direction; else all start at `origin`
  std::size_t flux = 6;     ///< index of the flux among them
  RayColors colors;
  double unit = 1e-3;   ///< of positions, metres
  Vec3 origin{0};       ///< in that unit
  std::string assumed;  ///< what the file does not say, for a warning
};
/// @throws NotMyFormat, Error
RayLayout ray_layout(std::ifstream& in, uint64_t size, const std::string& where);

/// Metres of Zemax' unit codes, binary and text. @throws Error for others
double zemax_unit(double code, const std::string& where);

/// LightTools' and Zemax' texts. @throws NotMyFormat, Error naming file:line
RayFile read_text_rays(std::ifstream& in, uint64_t size, const std::string& where, const RaySink& sink,
                       const Progress& progress);

}  // namespace sconce
