// SPDX-License-Identifier: Apache-2.0
// How many shadow rays each lamp gets for a receiver's own rays (docs/adr/0043-shadow-rays-by-need.md). Where
// a lamp is seen evenly, or not at all, few tell as much as many. What a batch gets follows from the batches
// before it, so the mean stays right, and from the lamp alone: never from strength, grouping or other lamps'
// light (contract.md, "Which lamp is sampled").
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "light/lamp.h"
#include "trace/tracer.h"

namespace sconce {

/// Light of a sample, were its radiance 1 (delta lamps: its intensity, or illuminance) and nothing in the
/// way.
inline float unit_light(const LightSample& light, float cosine) {
  if (!light.delta) return cosine / (light.pdf + cosine * kInvPi);
  return light.distance < kInfinite ? cosine / (light.distance * light.distance) : cosine;
}

/// Per lamp its mean unit_light() over the surfaces that it shines on, by a few particles: what its light is
/// measured by. Empty beyond ShadowRates::kMostLamps.
std::vector<double> usual_light(const World& world, const Tracer& tracer, const Lamps& lamps);

/// For one receiver.
class ShadowRates {
 public:
  static constexpr std::size_t kMostLamps = 64;  ///< beyond, lamps are not looked at one by one
  /// Levels of rates, each half of the one before: from four samples for one of the receiver to an eighth.
  static constexpr uint32_t kLevels = 6, kOne = 2;

  /// @param usual  usual_light()
  explicit ShadowRates(std::span<const double> usual);

  /// Decides for samples [first, first + count) of the receiver.
  void decide(uint32_t first, uint32_t count);
  uint32_t level(std::size_t i) const { return lamps_[i].level; }
  /// The samples of a level's lamps: [first, first + count) of a sequence.
  uint32_t first(uint32_t level) const { return first_ << kOne >> level; }
  uint32_t count(uint32_t level) const { return count_ << kOne >> level; }
  /// For one sample of the receiver: the factor of lamp i's density in MIS weights.
  float rate(std::size_t i) const { return rates_[lamps_[i].level]; }

  /// What a sample of lamp i has met.
  /// @param light   unit_light(); 0 where the lamp does not shine
  /// @param passed  share of it that nothing held back
  void note(std::size_t i, float light, float passed) {
    Seen& seen = lamps_[i];
    const double unit = static_cast<double>(light), value = unit * static_cast<double>(passed);
    seen.count += 1;
    seen.light += unit;
    seen.sum += value;
    seen.squares += value * value;
  }

 private:
  struct Seen {
    double usual;
    uint32_t level;
    double count = 0, light = 0, sum = 0, squares = 0;
  };

  std::vector<Seen> lamps_;
  uint32_t first_ = 0, count_ = 1;
  float rates_[kLevels] = {};
};

}  // namespace sconce
