// SPDX-License-Identifier: Apache-2.0
// What `probe` found, as numbers in a file.
#pragma once

#include <string>
#include <utility>

#include "probe_points.h"

namespace sconce::app {

struct ProbeReport {
  ProbePoints at;
  std::vector<std::string> groups;
  std::vector<Rgb> colors;                ///< lux of the mix, RGB, maintained
  std::vector<float> lux;                 ///< its luminance; NaN where no light reaches: inside of things
  std::vector<std::vector<float>> parts;  ///< [group][point], weighted
  std::vector<float> daylight;            ///< daylight factors, percent; empty where there is no sky
  std::vector<std::pair<std::string, std::string>> assumptions;

  /// Of the points that light reaches. @param values  lux or daylight
  LuxStatistics statistics(const std::vector<float>& values) const;
};

/// A line per point: place, normal, lux, daylight factor where there is one, each group's share.
std::string probe_csv(const ProbeReport& report);
/// `R G B` in lux per point, as rtrace -I writes irradiance.
std::string probe_lines(const ProbeReport& report);
/// One page without other files: figures, the plane's picture, table, assumptions.
std::string probe_html(const ProbeReport& report);
/// @throws UsageError where there is no plane
Image8 probe_picture(const ProbeReport& report);

}  // namespace sconce::app
