// SPDX-License-Identifier: Apache-2.0
#include "encode/bc6h_fields.h"

#include <vector>

namespace sconce {

namespace {

constexpr int kShapeBits = 5;

constexpr std::array<Bc6hMode, 14> kModes{{
    {0x00,
     2,
     2,
     10,
     {5, 5, 5},
     "gy4 by4 bz4 rw9:0 gw9:0 bw9:0 rx4:0 gz4 gy3:0 gx4:0 bz0 gz3:0 bx4:0 bz1 by3:0 ry4:0 bz2 rz4:0 bz3"},
    {0x01,
     2,
     2,
     7,
     {6, 6, 6},
     "gy5 gz4 gz5 rw6:0 bz0 bz1 by4 gw6:0 by5 bz2 gy4 bw6:0 bz3 bz5 bz4 rx5:0 gy3:0 gx5:0 gz3:0 bx5:0 by3:0 "
     "ry5:0 "
     "rz5:0"},
    {0x02,
     5,
     2,
     11,
     {5, 4, 4},
     "rw9:0 gw9:0 bw9:0 rx4:0 rw10 gy3:0 gx3:0 gw10 bz0 gz3:0 bx3:0 bw10 bz1 by3:0 ry4:0 bz2 rz4:0 bz3"},
    {0x06,
     5,
     2,
     11,
     {4, 5, 4},
     "rw9:0 gw9:0 bw9:0 rx3:0 rw10 gz4 gy3:0 gx4:0 gw10 gz3:0 bx3:0 bw10 bz1 by3:0 ry3:0 bz0 bz2 rz3:0 gy4 "
     "bz3"},
    {0x0a,
     5,
     2,
     11,
     {4, 4, 5},
     "rw9:0 gw9:0 bw9:0 rx3:0 rw10 by4 gy3:0 gx3:0 gw10 bz0 gz3:0 bx4:0 bw10 by3:0 ry3:0 bz1 bz2 rz3:0 bz4 "
     "bz3"},
    {0x0e,
     5,
     2,
     9,
     {5, 5, 5},
     "rw8:0 by4 gw8:0 gy4 bw8:0 bz4 rx4:0 gz4 gy3:0 gx4:0 bz0 gz3:0 bx4:0 bz1 by3:0 ry4:0 bz2 rz4:0 bz3"},
    {0x12,
     5,
     2,
     8,
     {6, 5, 5},
     "rw7:0 gz4 by4 gw7:0 bz2 gy4 bw7:0 bz3 bz4 rx5:0 gy3:0 gx4:0 bz0 gz3:0 bx4:0 bz1 by3:0 ry5:0 rz5:0"},
    {0x16,
     5,
     2,
     8,
     {5, 6, 5},
     "rw7:0 bz0 by4 gw7:0 gy5 gy4 bw7:0 gz5 bz4 rx4:0 gz4 gy3:0 gx5:0 gz3:0 bx4:0 bz1 by3:0 ry4:0 bz2 rz4:0 "
     "bz3"},
    {0x1a,
     5,
     2,
     8,
     {5, 5, 6},
     "rw7:0 bz1 by4 gw7:0 by5 gy4 bw7:0 bz5 bz4 rx4:0 gz4 gy3:0 gx4:0 bz0 gz3:0 bx5:0 by3:0 ry4:0 bz2 rz4:0 "
     "bz3"},
    {0x1e,
     5,
     2,
     6,
     {0, 0, 0},
     "rw5:0 gz4 bz0 bz1 by4 gw5:0 gy5 by5 bz2 gy4 bw5:0 gz5 bz3 bz5 bz4 rx5:0 gy3:0 gx5:0 gz3:0 bx5:0 by3:0 "
     "ry5:0 "
     "rz5:0"},
    {0x03, 5, 1, 10, {0, 0, 0}, "rw9:0 gw9:0 bw9:0 rx9:0 gx9:0 bx9:0"},
    {0x07, 5, 1, 11, {9, 9, 9}, "rw9:0 gw9:0 bw9:0 rx8:0 rw10 gx8:0 gw10 bx8:0 bw10"},
    {0x0b, 5, 1, 12, {8, 8, 8}, "rw9:0 gw9:0 bw9:0 rx7:0 rw10:11 gx7:0 gw10:11 bx7:0 bw10:11"},
    {0x0f, 5, 1, 16, {4, 4, 4}, "rw9:0 gw9:0 bw9:0 rx3:0 rw10:15 gx3:0 gw10:15 bx3:0 bw10:15"},
}};

/// Bit t: texel t is of the second subset.
constexpr std::array<uint16_t, kBc6hShapes> kSecond{
    0xcccc, 0x8888, 0xeeee, 0xecc8, 0xc880, 0xfeec, 0xfec8, 0xec80, 0xc800, 0xffec, 0xfe80,
    0xe800, 0xffe8, 0xff00, 0xfff0, 0xf000, 0xf710, 0x008e, 0x7100, 0x08ce, 0x008c, 0x7310,
    0x3100, 0x8cce, 0x088c, 0x3110, 0x6666, 0x366c, 0x17e8, 0x0ff0, 0x718e, 0x399c};
constexpr std::array<uint8_t, kBc6hShapes> kSecondAnchor{15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15,
                                                         15, 15, 15, 15, 15, 15, 2,  8,  2,  2,  8,
                                                         8,  15, 2,  8,  2,  2,  8,  8,  2,  2};

/// One bit of an endpoint.
struct Place {
  std::size_t end, channel;
  int bit;
};

std::vector<Place> places(std::string_view layout) {
  std::vector<Place> all;
  const auto number = [&] {
    int value = 0;
    for (; !layout.empty() && layout[0] >= '0' && layout[0] <= '9'; layout.remove_prefix(1))
      value = 10 * value + (layout[0] - '0');
    return value;
  };
  while (!layout.empty()) {
    const std::size_t channel = std::string_view("rgb").find(layout[0]),
                      end = static_cast<std::size_t>(layout[1] - 'w');
    layout.remove_prefix(2);
    const int last = number();
    int first = last;
    if (!layout.empty() && layout[0] == ':') layout.remove_prefix(1), first = number();
    for (int bit = first;; bit += first < last ? 1 : -1) {
      all.push_back({end, channel, bit});
      if (bit == last) break;
    }
    if (!layout.empty()) layout.remove_prefix(1);
  }
  return all;
}

const std::vector<Place>& places(const Bc6hMode& mode) {
  static const std::array<std::vector<Place>, kModes.size()> kPlaces = [] {
    std::array<std::vector<Place>, kModes.size()> all;
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = places(kModes[i].layout);
    return all;
  }();
  return kPlaces[static_cast<std::size_t>(&mode - kModes.data())];
}

class BitWriter {
 public:
  explicit BitWriter(std::array<uint8_t, 16>& bytes) : bytes_(bytes) {}
  /// Lowest bit first.
  void put(int value, int count) {
    for (int i = 0; i < count; ++i, ++at_)
      bytes_[at_ / 8] = static_cast<uint8_t>(bytes_[at_ / 8] | (value >> i & 1) << at_ % 8);
  }

 private:
  std::array<uint8_t, 16>& bytes_;
  std::size_t at_ = 0;
};

class BitReader {
 public:
  explicit BitReader(std::span<const uint8_t, 16> bytes) : bytes_(bytes) {}
  int get(int count) {
    int value = 0;
    for (int i = 0; i < count; ++i, ++at_) value |= (bytes_[at_ / 8] >> at_ % 8 & 1) << i;
    return value;
  }

 private:
  std::span<const uint8_t, 16> bytes_;
  std::size_t at_ = 0;
};

int index_bits(const Bc6hFields& fields, std::size_t texel) {
  return fields.mode->index_bits() - (texel == fields.anchor(fields.subset(texel)) ? 1 : 0);
}

}  // namespace

std::span<const Bc6hMode> bc6h_modes() {
  return kModes;
}

std::size_t Bc6hFields::second(int shape, std::size_t texel) {
  return kSecond[static_cast<std::size_t>(shape)] >> texel & 1;
}

std::size_t Bc6hFields::anchor(std::size_t subset) const {
  return subset == 0 ? 0 : kSecondAnchor[static_cast<std::size_t>(shape)];
}

bool fits(const Bc6hFields& fields) {
  for (std::size_t k = 0; k < 3; ++k) {
    const int bits = fields.mode->offset_bits[k];
    for (std::size_t e = 1; bits > 0 && e < 2 * static_cast<std::size_t>(fields.mode->subsets); ++e) {
      const int offset = fields.ends[e][k] - fields.ends[0][k], reach = 1 << (bits - 1);
      if (offset < -reach || offset >= reach) return false;
    }
  }
  return true;
}

std::array<uint8_t, 16> pack_bc6h(const Bc6hFields& fields) {
  const Bc6hMode& mode = *fields.mode;
  std::array<uint8_t, 16> block{};
  BitWriter bits(block);
  bits.put(mode.id, mode.id_bits);
  for (const Place& p : places(mode)) {
    const bool relative = p.end > 0 && mode.offset_bits[p.channel] > 0;
    bits.put((fields.ends[p.end][p.channel] - (relative ? fields.ends[0][p.channel] : 0)) >> p.bit, 1);
  }
  if (mode.subsets == 2) bits.put(fields.shape, kShapeBits);
  for (std::size_t t = 0; t < 16; ++t) bits.put(fields.index[t], index_bits(fields, t));
  return block;
}

Bc6hFields unpack_bc6h(std::span<const uint8_t, 16> block) {
  Bc6hFields fields;
  for (const Bc6hMode& mode : kModes)
    if (BitReader(block).get(mode.id_bits) == mode.id) fields.mode = &mode;
  if (fields.mode == nullptr) return fields;
  const Bc6hMode& mode = *fields.mode;
  BitReader bits(block);
  bits.get(mode.id_bits);
  for (const Place& p : places(mode)) fields.ends[p.end][p.channel] |= bits.get(1) << p.bit;
  for (std::size_t k = 0; k < 3; ++k) {
    if (mode.offset_bits[k] == 0) continue;
    const int sign = 1 << (mode.offset_bits[k] - 1);
    for (std::size_t e = 1; e < fields.ends.size(); ++e)
      fields.ends[e][k] = (fields.ends[0][k] + (fields.ends[e][k] ^ sign) - sign) & ((1 << mode.bits) - 1);
  }
  if (mode.subsets == 2) fields.shape = bits.get(kShapeBits);
  for (std::size_t t = 0; t < 16; ++t) fields.index[t] = bits.get(index_bits(fields, t));
  return fields;
}

}  // namespace sconce
