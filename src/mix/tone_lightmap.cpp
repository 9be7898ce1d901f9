// SPDX-License-Identifier: Apache-2.0
#include "mix/tone_lightmap.h"

#include "core/vec.h"
#include "tone/codes.h"

namespace sconce {

std::vector<Image8> tone_lightmap(std::span<const Image> pages, const Exposure& exposure,
                                  const ToneMapper& mapper) {
  Exposure of_lux = exposure;
  of_lux.scale *= kInvPi;
  const ToneCodes codes(of_lux, mapper);
  std::vector<Image8> toned;
  for (const Image& page : pages) toned.push_back(codes.map(page));
  return toned;
}

}  // namespace sconce
