// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <vector>

#include "core/error.h"
#include "core/text.h"
#include "tone/curve.h"

namespace sconce {

namespace {

constexpr ToneMapper kToneMappers[] = {
    {"agx", "AgX, base look: filmic, highlights lose colour gently", tone_agx, false, false},
    {"drago", "adaptive logarithm (Drago 2003), kept monotone", tone_drago, true, true},
    {"drago2006", "adaptive logarithm as in the 2006 paper: BT.601 luminance, no guard", tone_drago2006, true,
     true},
    {"reinhard", "photographic curve on luminance, white at the scene's maximum", tone_reinhard, true, true},
    {"aces", "ACES RRT and sRGB ODT, Hill's fit", tone_aces, false, false},
    {"neutral", "Khronos PBR Neutral: colours as they are, highlights compressed", tone_neutral, false,
     false},
    {"linear", "no curve, clipped at 1", tone_linear, false, false},
};

}  // namespace

std::span<const ToneMapper> tone_mappers() {
  return kToneMappers;
}

const ToneMapper& find_tone_mapper(std::string_view name) {
  std::vector<std::string> names;
  for (const ToneMapper& mapper : kToneMappers) {
    if (mapper.name == name) return mapper;
    names.emplace_back(mapper.name);
  }
  throw UsageError({}, "unknown tone curve '" + std::string(name) + "'", join(names, ", "));
}

}  // namespace sconce
