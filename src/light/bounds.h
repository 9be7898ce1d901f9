// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "light/lamp.h"

namespace sconce {

template <class... F>
struct Overload : F... {
  using F::operator()...;
};
template <class... F>
Overload(F...) -> Overload<F...>;

/// @param scene_radius2  squared half diagonal of the scene, m2: importance is relative to a lamp that far
/// away
LampBounds make_bounds(std::span<const Lamp> lamps, float scene_radius2);

}  // namespace sconce
