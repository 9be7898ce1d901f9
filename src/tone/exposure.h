// SPDX-License-Identifier: Apache-2.0
// From metering and options to exposed colour and ToneParams: the one rule that CPU, GL and web share.
#pragma once

#include "tone/tone.h"

namespace sconce {

/// exposed = scale * luminance in cd/m2, and what the curves need to know of the scene.
struct Exposure {
  float scale = 1;    ///< 1/(cd/m2)
  ToneParams params;  ///< hand to ToneMapper::map

  /// OpenEXR's `whiteLuminance` of an exposed picture: cd/m2 of the value 1.
  float white_luminance() const { return 1.0f / scale; }
};

/// `--exposure auto` (stops = 0) and `--exposure STOPS`: the metered log-mean becomes kMiddleGrey * 2^stops.
/// For drago that is L / L_wa with L_wa divided by 2^stops.
/// @param log_mean  cd/m2, of the metering; values below 1e-4 (a scene without light) count as 1e-4
/// @param maximum   cd/m2, of the metering
Exposure auto_exposure(double log_mean, double maximum, double stops = 0);

/// `--ev100`: absolute; higher is darker. The value 1 is L_max = 1.2 * 2^ev100 cd/m2, the luminance that
/// saturates a sensor (ISO 12232, saturation-based speed, lens factor q = 0.65: 78 / (100 q)).
/// @param maximum  cd/m2, of the metering
Exposure ev100_exposure(double ev100, double maximum);

/// The EV100 at which ev100_exposure() has the same scale.
double ev100_of(const Exposure& exposure);

/// No exposure: values stay cd/m2 (`--tone linear` to EXR).
Exposure unit_exposure(double maximum);

}  // namespace sconce
