// SPDX-License-Identifier: Apache-2.0
// How a group's layer is kept: an encoding, of its colours or of its luminance alone.
#pragma once

#include <string>
#include <string_view>

#include "encode/encoding.h"

namespace sconce {

/// `f16`, or `lum:f16`: the luminances of four groups share the channels of one texture and take their
/// groups' colours when they are mixed (system A's luminance packing). Colour bleeding is lost, luminance is
/// not.
struct EncodingChoice {
  const Encoding* encoding = nullptr;
  bool luminance = false;

  std::string name() const;
  double bytes_per_texel() const;
  bool operator==(const EncodingChoice&) const = default;
};

/// @throws UsageError naming the choices, or that the encoding's channels share bits
EncodingChoice parse_encoding(std::string_view text);

/// Whether it may hold the signed coefficients of a basis.
inline bool signed_encoding(const EncodingChoice& choice) {
  return choice.encoding->is_signed && !choice.luminance;
}

/// What an encoding does to a layer (contract.md, "Encoding error").
struct EncodingError {
  double relative = 0;  ///< 99.9th percentile of |difference of luminance| / max(luminance, 1 % of the mean)
  /// 99.9th percentile of the CIELAB a*b* distance of the layer alone on a white card, its mean exposed to
  /// middle grey and 4 stops above; the larger one
  double chroma = 0;
};
/// @param original, decoded  RGB of the same size
/// @param receivers          albedo.R/G/B and weight; texels of weight 0 do not count
/// @param mean               area-weighted mean of the layer's luminance
EncodingError measure_encoding(const Image& original, const Image& decoded, const Image& receivers,
                               double mean);

/// The same of a component of g (encode/basis.h), relative to the illuminance that it changes; no chroma.
/// @param illuminance  E of the same page
EncodingError measure_component(const Image& original, const Image& decoded, const Image& illuminance,
                                const Image& receivers, double mean);

/// Stands for what choose_encoding() finds.
inline constexpr std::string_view kAutoEncoding = "auto";

/// The smallest encoding whose error stays below `most` on every page of every coefficient, its chroma below
/// 100 * most; f32 where none does. Luminance packing, a choice of its user, is not among them; unsigned ones
/// are not where there is more than one coefficient.
/// @param coefficients  pages of each
EncodingChoice choose_encoding(std::span<const std::span<const Image>> coefficients,
                               std::span<const Image> receivers, double mean, double most);

/// Luminance (Rec. 709) of an RGB layer as channel `channel` of `packed`.
void pack_luminance(const Image& layer, Image& packed, std::size_t channel);
/// And back: luminance times the group's colour of luminance 1.
Image unpack_luminance(const Image& packed, std::size_t channel, const Rgb& color);

}  // namespace sconce
