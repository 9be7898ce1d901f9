// SPDX-License-Identifier: Apache-2.0
// Ray files: what a source sends out, ray by ray. Optical design programs make them of lamps, near field
// included.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>

#include "core/progress.h"
#include "core/rgb.h"
#include "core/vec.h"
#include "photometry/photometry.h"

namespace sconce {

struct SourceRay {
  Vec3 position;   ///< where it starts, metres, in the luminaire's frame
  Vec3 direction;  ///< unit
  float flux;      ///< as RayFile::luminous says
  Rgb color{1};    ///< of luminance 1; its parts may be negative, as those of one wavelength are
};

struct RayFile {
  std::string format;
  uint64_t rays = 0;
  bool luminous = true;  ///< flux in lm; else in W, and only shares of it mean anything here
  double stated = 0;     ///< flux of all rays by the header, in the file's own unit; 0 = not said
  double held = 0;       ///< flux of all rays in that unit
};

/// TM-25 (.tm25ray), LightTools (.ray, binary and text), Zemax (.dat, .sdf, binary and text), SPEOS (.ray)
/// and ASAP
/// (.dis) by content, in blocks, so that memory stays small. Light that goes along +z of the file goes
/// towards nadir here: the file's y and z are turned about x. What a file leaves open about its units is a
/// warning. Rays keep their colours by tristimulus values, spectra or wavelengths; with the last two watts
/// become lumens.
/// @param sink  called with blocks of rays in file order
/// @throws NotMyFormat, Error: cut short, sizes that do not agree
RayFile read_rays(const std::filesystem::path& path,
                  const std::function<void(std::span<const SourceRay>)>& sink, const Progress& progress = {});

/// Far field of rays: flux by direction in zones around the angles of a type C table.
class FarFieldBins {
 public:
  /// @param planes  C planes over 360 degrees
  /// @param zones   steps of gamma over 180 degrees
  FarFieldBins(int planes, int zones);

  void add(std::span<const SourceRay> rays);
  double flux() const { return flux_; }
  /// The table; scaled so that its integral is the flux of the rays, exactly. @pre flux() > 0
  Photometry table() const;

 private:
  int planes_, zones_;
  std::vector<double> bins_;  ///< [plane][zone], lm
  double flux_ = 0;
};

}  // namespace sconce
