// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "core/find_row.h"
#include "tone/curve.h"

namespace sconce {

namespace {

constexpr std::string_view kCommonGlsl =
#include "tone/common.glsl.h"
    ;
constexpr ToneMapper kToneMappers[] = {
    {
        "agx",
        "AgX, base look: filmic, highlights lose colour gently",
        tone_agx,
        false,
        &kAgxCurve,
#include "tone/agx.glsl.h"
    },
    {
        "drago",
        "adaptive logarithm (Drago 2003), kept monotone",
        tone_drago,
        true,
        &kDragoCurve,
#include "tone/drago.glsl.h"
    },
    {
        "drago2006",
        "adaptive logarithm as in the 2006 paper: BT.601 luminance, no guard",
        tone_drago2006,
        true,
        &kDrago2006Curve,
#include "tone/drago.glsl.h"
    },
    {
        "reinhard",
        "photographic curve on luminance, white at the scene's maximum",
        tone_reinhard,
        true,
        &kReinhardCurve,
#include "tone/reinhard.glsl.h"
    },
    {
        "aces",
        "ACES RRT and sRGB ODT, Hill's fit",
        tone_aces,
        false,
        &kAcesCurve,
#include "tone/aces.glsl.h"
    },
    {
        "neutral",
        "Khronos PBR Neutral: colours as they are, highlights compressed",
        tone_neutral,
        false,
        nullptr,
#include "tone/neutral.glsl.h"
    },
    {
        "linear",
        "no curve, clipped at 1",
        tone_linear,
        false,
        nullptr,
#include "tone/linear.glsl.h"
    },
};

}  // namespace

std::span<const ToneMapper> tone_mappers() {
  return kToneMappers;
}

std::string tone_glsl(const ToneMapper& mapper) {
  return std::string(kCommonGlsl) + std::string(mapper.glsl) +
         "\nvec3 tone_map(vec3 exposed, ToneParams p) {\n  return tone_" + std::string(mapper.name) +
         "(exposed, p);\n}\n";
}

const ToneMapper& find_tone_mapper(std::string_view name) {
  return find_row(tone_mappers(), name, "tone curve");
}

}  // namespace sconce
