// SPDX-License-Identifier: Apache-2.0
// Packing by what shapes really cover: a page as one bit per texel.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace sconce {

/// The texels of something to be placed, as runs of bits row by row.
class Shape {
 public:
  Shape(int width, int height);

  void set(int x, int y);
  /// Call once after the last set().
  void seal();

  int width() const { return width_; }
  int height() const { return height_; }
  std::size_t count() const;  ///< texels set
  /// Texels within `reach` of one that is set, itself included.
  std::size_t count_dilated(int reach) const;
  bool operator<(const Shape& other) const;  ///< any strict order; equal shapes are equal

  struct Run {
    int from, to;  ///< [from, to)
  };
  const Run* begin(int row) const { return runs_.data() + first_[static_cast<std::size_t>(row)]; }
  const Run* end(int row) const { return runs_.data() + first_[static_cast<std::size_t>(row) + 1]; }

 private:
  int width_, height_;
  std::vector<uint8_t> texels_;  // until sealed
  std::vector<Run> runs_;
  std::vector<uint32_t> first_;
};

/// One page being filled.
class PageBits {
 public:
  /// @param gutter  texels kept free between shapes; half of that along the border
  PageBits(int width, int height, int gutter);

  /// The first free place in reading order, which is then taken; nothing when there is none.
  std::optional<std::pair<int, int>> place(const Shape& shape);

 private:
  std::optional<int> free_column(const Shape& shape, int y);
  void take(const Shape& shape, int x, int y);
  uint64_t* row(int y) { return &bits_[static_cast<std::size_t>(y) * words_]; }

  int width_, height_, gutter_, border_;
  std::size_t words_;
  std::vector<uint64_t> bits_;             // texels that are taken or within the gutter of one
  std::vector<uint64_t> blocked_, smear_;  // one row each
  std::map<Shape, int> searched_;          // rows above hold no place for that shape
};

}  // namespace sconce
