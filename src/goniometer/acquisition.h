// SPDX-License-Identifier: Apache-2.0
// Near-field lamps from photographs (Granier, Goesele, Heidrich, Seidel 2003): the lamp is moved to every
// grid position behind a filter that is printed as the dual of the basis, and the pattern it throws onto a
// screen is photographed.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/rgb.h"
#include "image/image.h"
#include "photometry/light_field.h"

namespace sconce {

/// How photographs in a folder were taken: acquire.toml, docs/luminaires.md.
struct Acquisition {
  LightField grid;  ///< everything but the irradiance

  std::array<glm::dvec2, 4>
      corners;        ///< pictures' pixels where M's corners lie: least x and y, then round counter-clockwise
  double lux = 1;     ///< on the screen per picture value (of one second, where exposures are given)
  double gamma = 0;   ///< of 8- and 16-bit codes: value = code^gamma; 0 = the sRGB curve
  bool color = true;  ///< pictures' colours are the light field's, where they have any; else luminance
  Rgb white{1};       ///< channels' shares of what is to be white, of luminance 1
  double saturation = 0;  ///< picture values (codes where 8-bit) from here on are saturated; 0 = not known

  std::string name;               ///< file, {m} = column, {n} = row, {e} = exposure, from 0 on
  std::string negative;           ///< the same through the filter's negative part; empty = none
  std::string dark;               ///< a picture to take off all others; empty = none
  std::vector<double> exposures;  ///< seconds; empty = one picture per position, HDR
};

/// @throws Error naming file:line and what is allowed
Acquisition read_acquisition(const std::filesystem::path& file);

/// The photographs of a folder that have been turned into images of M so far.
class Acquired {
 public:
  Acquired(std::filesystem::path folder, Acquisition acquisition);

  /// Reads what has come since. A position whose pictures are not all there waits.
  /// @throws Error naming the file: saturated, negative, other size than the others, damaged
  /// @return how many positions were read this time
  std::size_t update();

  std::size_t positions() const { return done_.size(); }
  std::size_t present() const;
  bool has(std::size_t term) const { return done_[term] != 0; }
  /// The first picture that is missing; empty when all are there.
  std::string missing() const;
  /// Terms that are missing are dark.
  const LightField& field() const { return field_; }

 private:
  /// The pattern of one position in lux, down-sampled to M's pixels.
  std::vector<Rgb> rectified(const std::string& pattern, int m, int n);
  void set_term(std::size_t term, std::span<const Rgb> lux);
  /// Merged exposures: picture values per second, RGB; saturated in all = NaN.
  Image merged(const std::string& pattern, int m, int n) const;
  std::vector<std::string> files_of(int m, int n) const;

  std::filesystem::path folder_;
  Acquisition acquisition_;
  LightField field_;
  std::vector<uint8_t> done_;  ///< per term
  Image dark_;
  int width_ = 0, height_ = 0;  ///< of the photographs
};

}  // namespace sconce
