// SPDX-License-Identifier: Apache-2.0
// meter() while faders move: what does not change is read once.
#pragma once

#include "mix/mix.h"

namespace sconce {

class LightMeter {
 public:
  /// @param scene  of the package; needed here alone
  LightMeter(const Package& package, const Scene& scene);
  /// As meter() of mix/mix.h, the same bits. @throws Error when the pages are of another package
  Metering operator()(const MixSpec& mix, std::span<const Image> mixed) const;

  /// A lamp's triangle.
  struct Emitter {
    Id<LightGroup> group;
    Rgb emission;  ///< cd/m2 at weight 1
    double area;   ///< m2, of both sides where both shine
  };

 private:
  struct Texel {
    Rgb albedo;
    float weight;
    uint32_t index;  ///< on its page
  };
  std::string where_;
  std::vector<std::vector<std::vector<Texel>>> pages_;  ///< [page][band of rows]
  std::vector<Emitter> emitters_;
};

}  // namespace sconce
