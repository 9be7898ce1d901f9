// SPDX-License-Identifier: Apache-2.0
// "300 lx here, 50 there" and "look like this picture" as wishes over the faders. Faders keep their colours;
// their gains are what is sought.
#pragma once

#include <functional>

#include "mix/encoded_layers.h"
#include "mix/fit.h"
#include "session/fader.h"
#include "session/measure.h"

namespace sconce {

/// Each fader's weight at gain 1: its colour alone.
std::vector<Rgb> unit_weights(std::span<const GroupInfo> groups, const Faders& faders);

/// One number wished for at a point; differences count relative to it.
/// @param lux   of each group there, RGB at unit weight
/// @param unit  unit_weights()
/// @param given  lux that are there whatever the gains
void wish_lux(Wishes& wishes, std::span<const Rgb> lux, std::span<const Rgb> unit, double target,
              double given = 0);

/// A picture wished for; every pixel counts relative to its own luminance and the picture's mean.
/// @param parts     pictures of every group alone at unit weight, as large as `wanted`
/// @param left_out  per pixel: 1 = does not count; may be empty
/// @param given     a picture of what shines whatever the gains; or none
/// @throws Error where it is black
void wish_pixels(Wishes& wishes, std::span<const Image> parts, std::span<const Rgb> unit, const Image& wanted,
                 std::span<const uint8_t> left_out = {}, const Image* given = nullptr);
/// Box-filtered, where it is wider than kFitWidth. @throws Error where it has no R, G and B
Image fit_sized(const Image& image);
inline constexpr int kFitWidth = 160;

/// A lightmap, group by group.
struct GroupedLight {
  std::function<void(std::size_t group, std::vector<Image>& pages)> group;  ///< alone at unit weight, lux
  std::vector<Image> given{};  ///< what shines whatever the gains, lux; or none
};
/// As it was baked.
GroupedLight grouped_light(std::shared_ptr<const EncodedLayers> layers);

/// A picture of the package, in cd/m2, at places kFitWidth across. Left out are those at visible lamps and
/// the sky, and what gains do not explain: edges, mirrors.
/// @param view    with objects where `light` has them
/// @param camera  that the picture was taken with
/// @throws as fit_sized(), wish_pixels()
void wish_picture(Wishes& wishes, const View& view, const GroupedLight& light, const Camera& camera,
                  std::span<const Rgb> unit, const Image& target, const Progress& progress = {});

/// A display's codes back to linear light, as if there were no tone curve: middle grey is `grey` cd/m2.
Image from_display(const Image8& picture, float grey);

/// Gains as fader positions; colours, and what is not a gain, stay.
Faders with_gains(Faders faders, std::span<const double> gains);

}  // namespace sconce
