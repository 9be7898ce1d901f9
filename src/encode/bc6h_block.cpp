// SPDX-License-Identifier: Apache-2.0
#include "encode/bc6h_block.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace sconce {

namespace {

using Ints = std::array<int, 3>;
using Line = std::array<Ints, 2>;  // endpoints, as stored or in 16 bits
using Colour = std::array<double, 3>;

/// Bits of the first endpoint and of the second: of the difference where `delta` says so.
struct Mode {
  unsigned id;
  int bits, second_bits;
  bool delta;
};
constexpr Mode kModes[] = {
    {0x03, 10, 10, false}, {0x07, 11, 9, true}, {0x0b, 12, 8, true}, {0x0f, 16, 4, true}};
constexpr int kModeBits = 5, kLowBits = 10;  // the first endpoints' low bits come first
constexpr int kWeights[16] = {0, 4, 9, 13, 17, 21, 26, 30, 34, 38, 43, 47, 51, 55, 60, 64};
constexpr int kTop = 0x7bff;  // the largest half

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

int interpolate(int a, int b, int index) {
  return (a * (64 - kWeights[index]) + b * kWeights[index] + 32) >> 6;
}

uint16_t to_half_bits(int v) {
  return static_cast<uint16_t>((v * 31) >> 6);
}

/// A block in the making.
struct Candidate {
  const Mode* mode = nullptr;
  Line stored{};
  std::array<int, 16> index{};
  double error = std::numeric_limits<double>::infinity();
};

class Bits {
 public:
  explicit Bits(uint8_t* bytes) : bytes_(bytes) {}
  void put(int value, int count) {
    for (int i = 0; i < count; ++i) put_bit(value >> i & 1);
  }
  /// Highest bit first, as the modes with wide endpoints want their upper bits.
  void put_reversed(int value, int count) {
    for (int i = count - 1; i >= 0; --i) put_bit(value >> i & 1);
  }
  int get(int count) {
    int value = 0;
    for (int i = 0; i < count; ++i) value |= get_bit() << i;
    return value;
  }
  int get_reversed(int count) {
    int value = 0;
    for (int i = 0; i < count; ++i) value = value << 1 | get_bit();
    return value;
  }

 private:
  void put_bit(int bit) {
    bytes_[at_ / 8] = static_cast<uint8_t>(bytes_[at_ / 8] | bit << (at_ % 8));
    ++at_;
  }
  int get_bit() {
    const int bit = bytes_[at_ / 8] >> (at_ % 8) & 1;
    ++at_;
    return bit;
  }
  uint8_t* bytes_;
  int at_ = 0;
};

/// Endpoints as stored in this mode; none where their difference does not fit.
std::optional<Line> store(const std::array<Colour, 2>& ends, const Mode& mode) {
  Line stored;
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t e = 0; e < 2; ++e) stored[e][k] = quantise(ends[e][k], mode.bits);
    const int reach = 1 << (mode.second_bits - 1), difference = stored[1][k] - stored[0][k];
    if (mode.delta && (difference < -reach || difference >= reach)) return {};
  }
  return stored;
}

Line unquantise(const Line& stored, const Mode& mode) {
  Line ends = stored;
  for (Ints& end : ends)
    for (int& v : end) v = unquantise(v, mode.bits);
  return ends;
}

/// Nearest index of every texel, and what that leaves of error.
void choose_indices(const HalfBlock& texels, Candidate& c) {
  const Line ends = unquantise(c.stored, *c.mode);
  std::array<Ints, 16> palette;
  for (int i = 0; i < 16; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      palette[static_cast<std::size_t>(i)][k] = to_half_bits(interpolate(ends[0][k], ends[1][k], i));
  c.error = 0;
  for (std::size_t t = 0; t < 16; ++t) {
    double nearest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 16; ++i) {
      double d = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const double x = palette[static_cast<std::size_t>(i)][k] - texels[t][k];
        d += x * x;
      }
      if (d < nearest) nearest = d, c.index[t] = i;
    }
    c.error += nearest;
  }
}

/// Endpoints that fit the texels best with these indices: 2 x 2 normal equations, the same for each channel.
std::array<Colour, 2> fit(const std::array<Colour, 16>& wide, const std::array<int, 16>& index) {
  double aa = 0, ab = 0, bb = 0;
  Colour at{}, bt{};
  for (std::size_t t = 0; t < 16; ++t) {
    const double b = kWeights[index[t]] / 64.0, a = 1 - b;
    aa += a * a, ab += a * b, bb += b * b;
    for (std::size_t k = 0; k < 3; ++k) at[k] += a * wide[t][k], bt[k] += b * wide[t][k];
  }
  const double determinant = aa * bb - ab * ab;
  std::array<Colour, 2> ends;
  for (std::size_t k = 0; k < 3; ++k) {
    const double first = determinant > 1e-9 ? (bb * at[k] - ab * bt[k]) / determinant : (at[k] + bt[k]) / 16;
    const double second = determinant > 1e-9 ? (aa * bt[k] - ab * at[k]) / determinant : first;
    ends[0][k] = std::clamp(first, 0.0, 65535.0);
    ends[1][k] = std::clamp(second, 0.0, 65535.0);
  }
  return ends;
}

/// Along the direction in which the texels vary most.
std::array<Colour, 2> principal_line(const std::array<Colour, 16>& wide) {
  Colour mean{};
  for (const Colour& c : wide)
    for (std::size_t k = 0; k < 3; ++k) mean[k] += c[k] / 16;
  double covariance[3][3] = {};
  for (const Colour& c : wide)
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) covariance[i][j] += (c[i] - mean[i]) * (c[j] - mean[j]);
  Colour axis{1, 1, 1};
  for (int round = 0; round < 8; ++round) {
    Colour next{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) next[i] += covariance[i][j] * axis[j];
    const double length = std::sqrt(next[0] * next[0] + next[1] * next[1] + next[2] * next[2]);
    if (!(length > 0)) break;
    for (std::size_t k = 0; k < 3; ++k) axis[k] = next[k] / length;
  }
  double low = 0, high = 0;
  const double norm = axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2];
  for (const Colour& c : wide) {
    double along = 0;
    for (std::size_t k = 0; k < 3; ++k) along += (c[k] - mean[k]) * axis[k] / norm;
    low = std::min(low, along), high = std::max(high, along);
  }
  std::array<Colour, 2> ends;
  for (std::size_t k = 0; k < 3; ++k) {
    ends[0][k] = std::clamp(mean[k] + low * axis[k], 0.0, 65535.0);
    ends[1][k] = std::clamp(mean[k] + high * axis[k], 0.0, 65535.0);
  }
  return ends;
}

std::array<uint8_t, 16> pack(Candidate c) {
  // The first index has one bit less: its highest is 0.
  if (c.index[0] >= 8) {
    std::swap(c.stored[0], c.stored[1]);
    for (int& i : c.index) i = 15 - i;
  }
  std::array<uint8_t, 16> block{};
  Bits bits(block.data());
  bits.put(static_cast<int>(c.mode->id), kModeBits);
  for (std::size_t k = 0; k < 3; ++k) bits.put(c.stored[0][k], kLowBits);
  for (std::size_t k = 0; k < 3; ++k) {
    bits.put(c.mode->delta ? c.stored[1][k] - c.stored[0][k] : c.stored[1][k], c.mode->second_bits);
    bits.put_reversed(c.stored[0][k] >> kLowBits, c.mode->bits - kLowBits);
  }
  for (std::size_t t = 0; t < 16; ++t) bits.put(c.index[t], t == 0 ? 3 : 4);
  return block;
}

/// Swapping the endpoints turns a difference of -reach into one that does not fit.
bool packs(const Candidate& c) {
  if (!c.mode->delta || c.index[0] < 8) return true;
  for (std::size_t k = 0; k < 3; ++k)
    if (c.stored[0][k] - c.stored[1][k] >= 1 << (c.mode->second_bits - 1)) return false;
  return true;
}

}  // namespace

std::array<uint8_t, 16> encode_bc6h_block(const HalfBlock& texels) {
  std::array<Colour, 16> wide;  // undoing to_half_bits
  for (std::size_t t = 0; t < 16; ++t)
    for (std::size_t k = 0; k < 3; ++k) wide[t][k] = std::min(65535.0, (texels[t][k] + 0.5) * 64.0 / 31.0);

  constexpr int kRefinements = 2;
  Candidate best;
  const std::array<Colour, 2> line = principal_line(wide);
  for (const Mode& mode : kModes) {
    std::array<Colour, 2> ends = line;
    for (int round = 0; round <= kRefinements; ++round) {
      const std::optional<Line> stored = store(ends, mode);
      if (!stored) break;
      Candidate c{&mode, *stored};
      choose_indices(texels, c);
      if (c.error < best.error && packs(c)) best = c;
      ends = fit(wide, c.index);
    }
  }
  return pack(best);
}

HalfBlock decode_bc6h_block(std::span<const uint8_t, 16> block) {
  HalfBlock texels{};
  std::array<uint8_t, 16> bytes;
  std::copy(block.begin(), block.end(), bytes.begin());
  Bits bits(bytes.data());
  const auto id = static_cast<unsigned>(bits.get(kModeBits));
  const auto mode =
      std::find_if(std::begin(kModes), std::end(kModes), [&](const Mode& m) { return m.id == id; });
  if (mode == std::end(kModes)) return texels;
  Line stored;
  for (std::size_t k = 0; k < 3; ++k) stored[0][k] = bits.get(kLowBits);
  for (std::size_t k = 0; k < 3; ++k) {
    stored[1][k] = bits.get(mode->second_bits);
    stored[0][k] |= bits.get_reversed(mode->bits - kLowBits) << kLowBits;
    if (!mode->delta) continue;
    const int sign = 1 << (mode->second_bits - 1);
    stored[1][k] = (stored[0][k] + (stored[1][k] ^ sign) - sign) & ((1 << mode->bits) - 1);
  }
  const Line ends = unquantise(stored, *mode);
  for (std::size_t t = 0; t < 16; ++t) {
    const int index = bits.get(t == 0 ? 3 : 4);
    for (std::size_t k = 0; k < 3; ++k)
      texels[t][k] = std::min<uint16_t>(kTop, to_half_bits(interpolate(ends[0][k], ends[1][k], index)));
  }
  return texels;
}

}  // namespace sconce
