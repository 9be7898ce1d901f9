// SPDX-License-Identifier: Apache-2.0
// The options that `mix` and `render` share where codes for a display come out: exposure and tone curve.
#pragma once

#include <string>

#include "app.h"
#include "mix/mix.h"
#include "mix/preset.h"
#include "tone/exposure.h"

namespace sconce::app {

/// How values become exposed ones.
struct ExposureChoice {
  enum class Kind { automatic, ev100 } kind = Kind::automatic;
  double value = 0;         ///< stops, or EV at ISO 100
  bool explicitly = false;  ///< asked for, so that a linear picture is exposed too

  Exposure resolve(const Metering& metering) const;
  std::string text() const;
};

struct ToneOptions {
  std::string exposure, ev100, curve;

  void declare(Options& options);
  /// Values that the command line left open come from the preset.
  void apply(const Preset& preset);
  /// @throws UsageError
  void check() const;
  ExposureChoice exposure_choice() const;
  const ToneMapper& mapper() const;
};

}  // namespace sconce::app
