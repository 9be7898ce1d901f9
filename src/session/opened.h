// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mix/encoded_layers.h"
#include "mix/light_meter.h"
#include "session/measure.h"

namespace sconce {

/// All that is read of a package before it can be looked at; made beside the window, then drawn by it.
struct Opened {
  /// @throws Error naming the damaged file
  explicit Opened(const std::filesystem::path& path) : Opened(Package::open(path)) {}
  explicit Opened(Package package);
  Opened(const Opened&) = delete;
  Opened& operator=(const Opened&) = delete;

  Package package;
  View rays;
  EncodedLayers layers;  ///< all coefficients where normal maps are seen
  LightMeter meter;
  std::vector<MeasuredPlane> planes;  ///< baked with it
  std::optional<ProbeGrid> probes;    ///< likewise
};

/// Relative standard error of a mix in percent, per page: groups taken as independent, so that squares add.
/// Reads noise and layers of the package.
std::vector<Image> mixed_noise(const Opened& opened, const MixSpec& mix);

}  // namespace sconce
