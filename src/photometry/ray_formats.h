// SPDX-License-Identifier: Apache-2.0
// What the readers of ray files share. Used by rays.cpp and the formats' own files only.
#pragma once

#include <cstdint>
#include <fstream>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "photometry/rays.h"

namespace sconce {

using RaySink = std::function<void(std::span<const SourceRay>)>;

/// Checks rays as a file gives them, turns them into the luminaire's frame and hands them on in blocks, so
/// that memory does not grow with the file.
class RayBlocks {
 public:
  static constexpr std::size_t kBlock = 65536;

  /// @param unit  of positions, metres
  RayBlocks(const RaySink& sink, std::string where, double unit)
      : sink_(sink), where_(std::move(where)), unit_(static_cast<float>(unit)) {}

  /// @param direction  unit within 1 % @throws Error naming the ray
  void add(const Vec3& position, const Vec3& direction, float flux);
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
  double unit = 1e-3;       ///< of positions, metres
  Vec3 origin{0};           ///< in that unit
  std::string assumed;      ///< what the file does not say, for a warning
};
/// @throws NotMyFormat, Error
RayLayout ray_layout(std::ifstream& in, uint64_t size, const std::string& where);

/// Metres of Zemax' unit codes, binary and text. @throws Error for others
double zemax_unit(double code, const std::string& where);

/// LightTools' and Zemax' texts. @throws NotMyFormat, Error naming file:line
RayFile read_text_rays(std::ifstream& in, uint64_t size, const std::string& where, const RaySink& sink,
                       const Progress& progress);

}  // namespace sconce
