// SPDX-License-Identifier: Apache-2.0
// All that stands elsewhere than it was baked, as one lightmap.
#pragma once

#include <algorithm>
#include <set>

#include "session/goals.h"
#include "session/lamp_mover.h"
#include "session/object_mover.h"

namespace sconce {

struct Movers {
  const LampMover* lamps = nullptr;      ///< null where lamps stay
  const ObjectMover* objects = nullptr;  ///< null where objects do

  bool any() const { return (lamps != nullptr && lamps->any()) || (objects != nullptr && objects->any()); }
  /// Counts changes of light.
  uint64_t version() const {
    return (lamps != nullptr ? lamps->version() : 0) + (objects != nullptr ? objects->version() : 0);
  }
  /// Lamps that are elsewhere, for rays.
  std::vector<StandingLamp> standing() const {
    return lamps != nullptr ? lamps->standing() : std::vector<StandingLamp>();
  }
  /// Those that rays do not know, at points.
  std::vector<KnownLamp> known(std::span<const SurfacePoint> points) const {
    return lamps != nullptr ? lamps->known(points) : std::vector<KnownLamp>();
  }
  /// Groups whose light is not as it was baked, of `count`.
  std::vector<std::size_t> changed(std::size_t count) const {
    std::set<std::size_t> groups;
    for (const StandingLamp& one : standing())
      groups.insert(lamps->movable().lamps.all()[one.lamp].group.value);
    if (objects != nullptr && objects->any())
      for (std::size_t g = 0; g < count; ++g) groups.insert(g);
    return {groups.begin(), groups.end()};
  }
  /// A group's lightmap alone at a weight, of `count` groups.
  std::vector<Image> pages(Mixer& mixer, std::size_t group, std::size_t count, const Rgb& weight) const {
    MixSpec alone{std::vector<Rgb>(count, Rgb(0))};
    alone.weights[group] = weight;
    return pages(mixer, alone);
  }
  /// The mixed lightmap.
  std::vector<Image> pages(Mixer& mixer, const MixSpec& mix) const {
    const auto mixed = [&](const MixSpec& of) {
      return objects != nullptr ? objects->pages(mixer.mix(of), of) : mixer.mix(of);
    };
    return lamps != nullptr && lamps->any() ? lamps->pages(mixed, mix) : mixed(mix);
  }
};

/// The lightmap with all that stands elsewhere, for wish_picture().
inline GroupedLight moved_light(const Movers& movers, const std::shared_ptr<const EncodedLayers>& layers) {
  if (!movers.any()) return grouped_light(layers);
  const std::size_t count = layers->colors.size();
  const auto mixer = std::make_shared<Mixer>(layers);
  return {[movers, mixer, count, layers, changed = movers.changed(count)](std::size_t group,
                                                                          std::vector<Image>& pages) {
    if (std::find(changed.begin(), changed.end(), group) == changed.end())
      layers->layer(group, pages);
    else
      pages = movers.pages(*mixer, group, count, Rgb(1));
  }};
}

}  // namespace sconce
