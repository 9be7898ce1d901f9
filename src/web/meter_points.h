// SPDX-License-Identifier: Apache-2.0
// What automatic exposure is metered on, small enough for a browser: mix/meter.cpp on some thousand texels
// that stand for all.
#pragma once

#include <vector>

#include "core/progress.h"
#include "package/shown_scene.h"

namespace sconce::web {

struct MeterPoints {
  std::size_t groups = 0;
  std::vector<float> weights;  ///< per point: of the texels that it stands for
  /// [point * groups + g]: albedo/pi * E_g by channel, each times its share of luminance, cd/m2. The sum of
  /// the channels under a mix is the texel's luminance.
  std::vector<Rgb> values;

  struct Emitter {
    Id<LightGroup> group;  ///< none: no fader reaches it
    Rgb luminance;         ///< by channel as above
    float weight;          ///< area, m2
  };
  std::vector<Emitter> emitters;
};

/// Texels in the order of their luminance when everything is on, every so many square metres one; as many
/// again among those that are bright in some group, for the percentile that stands for the maximum.
MeterPoints choose_meter_points(const Package& package, const ShownScene& shown, const Progress& progress);

}  // namespace sconce::web
