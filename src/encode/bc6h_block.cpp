// SPDX-License-Identifier: Apache-2.0
#include "encode/bc6h_block.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "encode/bc6h_fields.h"

namespace sconce {

namespace {

using Ints = std::array<int, 3>;
using Colour = std::array<double, 3>;
using Line = std::array<Colour, 2>;  // endpoints in 16 bits
using Lines = std::array<Line, 2>;   // per subset
using Texels = std::array<Colour, 16>;

constexpr int kWeights4[16] = {0, 4, 9, 13, 17, 21, 26, 30, 34, 38, 43, 47, 51, 55, 60, 64};
constexpr int kWeights3[8] = {0, 9, 18, 27, 37, 46, 55, 64};
constexpr int kTop = 0x7bff;  // the largest half

int weight(const Bc6hMode& mode, int index) {
  return mode.subsets == 1 ? kWeights4[index] : kWeights3[index];
}

int unquantise(int v, int bits) {
  if (bits >= 16 || v == 0) return v;
  if (v == (1 << bits) - 1) return 0xffff;
  return ((v << 15) + 0x4000) >> (bits - 1);
}

/// The code nearest to a value of 16 bits.
int quantise(double v, int bits) {
  const int guess = static_cast<int>(v) >> (16 - bits);
  int best = 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (int code = std::max(0, guess - 1); code <= std::min((1 << bits) - 1, guess + 1); ++code) {
    const double d = std::abs(unquantise(code, bits) - v);
    if (d < nearest) nearest = d, best = code;
  }
  return best;
}

int interpolate(int a, int b, int weight) {
  return (a * (64 - weight) + b * weight + 32) >> 6;
}

uint16_t to_half_bits(int v) {
  return static_cast<uint16_t>((v * 31) >> 6);
}

/// The colours that a subset's indices stand for, as halves' bits.
std::array<Ints, 16> palette(const Bc6hFields& fields, std::size_t subset) {
  std::array<Ints, 16> colours{};
  const Bc6hMode& mode = *fields.mode;
  for (std::size_t k = 0; k < 3; ++k) {
    const int a = unquantise(fields.ends[2 * subset][k], mode.bits),
              b = unquantise(fields.ends[2 * subset + 1][k], mode.bits);
    for (int i = 0; i < 1 << mode.index_bits(); ++i)
      colours[static_cast<std::size_t>(i)][k] = to_half_bits(interpolate(a, b, weight(mode, i)));
  }
  return colours;
}

/// Nearest index of every texel. @return what that leaves of error
double choose_indices(const HalfBlock& texels, Bc6hFields& fields) {
  const std::array<std::array<Ints, 16>, 2> palettes{palette(fields, 0), palette(fields, 1)};
  double error = 0;
  for (std::size_t t = 0; t < 16; ++t) {
    const std::array<Ints, 16>& colours = palettes[fields.subset(t)];
    double nearest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 1 << fields.mode->index_bits(); ++i) {
      double d = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const double x = colours[static_cast<std::size_t>(i)][k] - texels[t][k];
        d += x * x;
      }
      if (d < nearest) nearest = d, fields.index[t] = i;
    }
    error += nearest;
  }
  return error;
}

/// Endpoints that fit a subset's texels best with these indices: 2 x 2 normal equations, the same for each
/// channel.
Line fit(const Texels& wide, const Bc6hFields& fields, std::size_t subset) {
  double aa = 0, ab = 0, bb = 0, count = 0;
  Colour at{}, bt{};
  for (std::size_t t = 0; t < 16; ++t) {
    if (fields.subset(t) != subset) continue;
    const double b = weight(*fields.mode, fields.index[t]) / 64.0, a = 1 - b;
    aa += a * a, ab += a * b, bb += b * b, ++count;
    for (std::size_t k = 0; k < 3; ++k) at[k] += a * wide[t][k], bt[k] += b * wide[t][k];
  }
  const double determinant = aa * bb - ab * ab;
  Line ends;
  for (std::size_t k = 0; k < 3; ++k) {
    const double first =
        determinant > 1e-9 ? (bb * at[k] - ab * bt[k]) / determinant : (at[k] + bt[k]) / count;
    const double second = determinant > 1e-9 ? (aa * bt[k] - ab * at[k]) / determinant : first;
    ends[0][k] = std::clamp(first, 0.0, 65535.0);
    ends[1][k] = std::clamp(second, 0.0, 65535.0);
  }
  return ends;
}

struct Principal {
  Line line;
  double off = 0;  ///< squared distances of the texels from the line
};

/// Along the direction in which the texels of a mask vary most.
Principal principal_line(const Texels& wide, unsigned mask) {
  const auto count = static_cast<double>(std::popcount(mask));
  Colour mean{};
  double covariance[3][3] = {}, spread = 0;
  for (std::size_t t = 0; t < 16; ++t)
    for (std::size_t k = 0; k < 3 && (mask >> t & 1) != 0; ++k) mean[k] += wide[t][k] / count;
  for (std::size_t t = 0; t < 16; ++t)
    for (std::size_t i = 0; i < 3 && (mask >> t & 1) != 0; ++i)
      for (std::size_t j = 0; j < 3; ++j) covariance[i][j] += (wide[t][i] - mean[i]) * (wide[t][j] - mean[j]);
  Colour axis{1, 1, 1};
  for (int round = 0; round < 8; ++round) {
    Colour next{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) next[i] += covariance[i][j] * axis[j];
    const double length = std::sqrt(next[0] * next[0] + next[1] * next[1] + next[2] * next[2]);
    if (!(length > 0)) break;
    spread = length;
    for (std::size_t k = 0; k < 3; ++k) axis[k] = next[k] / length;
  }
  double low = 0, high = 0;
  const double norm = axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2];
  for (std::size_t t = 0; t < 16; ++t) {
    if ((mask >> t & 1) == 0) continue;
    double along = 0;
    for (std::size_t k = 0; k < 3; ++k) along += (wide[t][k] - mean[k]) * axis[k] / norm;
    low = std::min(low, along), high = std::max(high, along);
  }
  Principal found;
  for (std::size_t k = 0; k < 3; ++k) {
    found.line[0][k] = std::clamp(mean[k] + low * axis[k], 0.0, 65535.0);
    found.line[1][k] = std::clamp(mean[k] + high * axis[k], 0.0, 65535.0);
  }
  found.off = std::max(0.0, covariance[0][0] + covariance[1][1] + covariance[2][2] - spread);
  return found;
}

/// Turns the lines round whose anchors have too high an index.
void settle_anchors(Bc6hFields& fields) {
  const int highest = (1 << fields.mode->index_bits()) - 1;
  for (std::size_t s = 0; s < static_cast<std::size_t>(fields.mode->subsets); ++s) {
    if (fields.index[fields.anchor(s)] <= highest / 2) continue;
    std::swap(fields.ends[2 * s], fields.ends[2 * s + 1]);
    for (std::size_t t = 0; t < 16; ++t)
      if (fields.subset(t) == s) fields.index[t] = highest - fields.index[t];
  }
}

/// Whether offsets may fit when a subset's endpoints are in the right order.
bool may_fit(Bc6hFields fields) {
  if (fits(fields)) return true;
  std::swap(fields.ends[0], fields.ends[1]);
  return fits(fields);
}

struct Best {
  Bc6hFields fields;
  double error = std::numeric_limits<double>::infinity();

  /// From these lines on, refined, in every mode with so many subsets.
  void search(const HalfBlock& texels, const Texels& wide, int subsets, int shape, const Lines& lines) {
    constexpr int kRefinements = 2;
    for (const Bc6hMode& mode : bc6h_modes()) {
      if (mode.subsets != subsets) continue;
      Lines at = lines;
      for (int round = 0; round <= kRefinements; ++round) {
        Bc6hFields tried{&mode, {}, shape, {}};
        for (std::size_t e = 0; e < 2 * static_cast<std::size_t>(subsets); ++e)
          for (std::size_t k = 0; k < 3; ++k) tried.ends[e][k] = quantise(at[e / 2][e % 2][k], mode.bits);
        if (!may_fit(tried)) break;
        const double left = choose_indices(texels, tried);
        for (std::size_t s = 0; s < static_cast<std::size_t>(subsets); ++s) at[s] = fit(wide, tried, s);
        settle_anchors(tried);
        if (left < error && fits(tried)) error = left, fields = tried;
      }
    }
  }
};

}  // namespace

std::array<uint8_t, 16> encode_bc6h_block(const HalfBlock& texels) {
  Texels wide;  // undoing to_half_bits
  for (std::size_t t = 0; t < 16; ++t)
    for (std::size_t k = 0; k < 3; ++k) wide[t][k] = std::min(65535.0, (texels[t][k] + 0.5) * 64.0 / 31.0);

  constexpr unsigned kAll = 0xffff;
  Best best;
  best.search(texels, wide, 1, 0, {principal_line(wide, kAll).line});
  constexpr double kGoodEnough = 48 * 25;  // 48 values off by 5 steps of halves: 0.34 %
  if (best.error < kGoodEnough) return pack_bc6h(best.fields);
  // Two lines, in the shapes whose texels lie nearest to them.
  struct Split {
    int shape;
    Lines lines;
    double off;
  };
  std::vector<Split> splits;
  for (int shape = 0; shape < kBc6hShapes; ++shape) {
    unsigned second = 0;
    for (std::size_t t = 0; t < 16; ++t) second |= static_cast<unsigned>(Bc6hFields::second(shape, t)) << t;
    const Principal a = principal_line(wide, kAll & ~second), b = principal_line(wide, second);
    splits.push_back({shape, {a.line, b.line}, a.off + b.off});
  }
  constexpr std::size_t kShapesTried = 4;
  std::partial_sort(splits.begin(), splits.begin() + kShapesTried, splits.end(),
                    [](const Split& a, const Split& b) { return a.off < b.off; });
  for (std::size_t i = 0; i < kShapesTried; ++i)
    best.search(texels, wide, 2, splits[i].shape, splits[i].lines);
  return pack_bc6h(best.fields);
}

HalfBlock decode_bc6h_block(std::span<const uint8_t, 16> block) {
  HalfBlock texels{};
  const Bc6hFields fields = unpack_bc6h(block);
  if (fields.mode == nullptr) return texels;
  const std::array<std::array<Ints, 16>, 2> palettes{palette(fields, 0), palette(fields, 1)};
  for (std::size_t t = 0; t < 16; ++t)
    for (std::size_t k = 0; k < 3; ++k)
      texels[t][k] = static_cast<uint16_t>(
          std::min(kTop, palettes[fields.subset(t)][static_cast<std::size_t>(fields.index[t])][k]));
  return texels;
}

}  // namespace sconce
