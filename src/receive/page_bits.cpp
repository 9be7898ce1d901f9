// SPDX-License-Identifier: Apache-2.0
#include "receive/page_bits.h"

#include <algorithm>
#include <bit>
#include <compare>
#include <tuple>

namespace sconce {

namespace {

/// out |= in moved down by `shift` bits (towards x = 0), over rows of `words` words.
void or_shifted(const uint64_t* in, uint64_t* out, std::size_t words, std::size_t shift) {
  const std::size_t whole = shift / 64, part = shift % 64;
  if (whole >= words) return;
  const std::size_t last = words - whole;
  if (part == 0) {
    for (std::size_t i = 0; i < last; ++i) out[i] |= in[i + whole];
    return;
  }
  for (std::size_t i = 0; i + 1 < last; ++i)
    out[i] |= in[i + whole] >> part | in[i + whole + 1] << (64 - part);
  out[last - 1] |= in[words - 1] >> part;
}

void set_range(uint64_t* row, int from, int to) {
  for (int x = from; x < to;) {
    const int bit = x % 64, n = std::min(64 - bit, to - x);
    row[x / 64] |= (n == 64 ? ~uint64_t{0} : (uint64_t{1} << n) - 1) << bit;
    x += n;
  }
}

/// First zero in [from, to), or -1.
int first_zero(const uint64_t* row, int from, int to) {
  for (int x = from; x < to;) {
    const uint64_t open = ~row[x / 64] >> (x % 64);
    if (open != 0) {
      x += std::countr_zero(open);
      return x < to ? x : -1;
    }
    x += 64 - x % 64;
  }
  return -1;
}

}  // namespace

Shape::Shape(int width, int height)
    : width_(width),
      height_(height),
      texels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0) {}

void Shape::set(int x, int y) {
  texels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)] = 1;
}

void Shape::seal() {
  first_.push_back(0);
  for (int y = 0; y < height_; ++y) {
    const uint8_t* row = &texels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_)];
    for (int x = 0; x < width_; ++x) {
      if (row[x] == 0) continue;
      const int from = x;
      while (x < width_ && row[x] != 0) ++x;
      runs_.push_back({from, x});
    }
    first_.push_back(static_cast<uint32_t>(runs_.size()));
  }
  std::vector<uint8_t>().swap(texels_);
}

std::size_t Shape::count() const {
  std::size_t sum = 0;
  for (const Run& run : runs_) sum += static_cast<std::size_t>(run.to - run.from);
  return sum;
}

std::size_t Shape::count_dilated(int reach) const {
  std::size_t sum = 0;
  std::vector<Run> near;
  for (int y = -reach; y < height_ + reach; ++y) {
    near.clear();
    for (int v = std::max(0, y - reach); v <= std::min(height_ - 1, y + reach); ++v)
      for (const Run* run = begin(v); run != end(v); ++run)
        near.push_back({run->from - reach, run->to + reach});
    std::sort(near.begin(), near.end(), [](const Run& a, const Run& b) { return a.from < b.from; });
    int covered = -reach;
    for (const Run& run : near) {
      sum += static_cast<std::size_t>(std::max(0, run.to - std::max(run.from, covered)));
      covered = std::max(covered, run.to);
    }
  }
  return sum;
}

bool Shape::operator<(const Shape& other) const {
  const auto head = [](const Shape& s) { return std::tuple(s.height_, s.width_, s.runs_.size()); };
  if (head(*this) != head(other)) return head(*this) < head(other);
  if (first_ != other.first_) return first_ < other.first_;
  return std::lexicographical_compare(
      runs_.begin(), runs_.end(), other.runs_.begin(), other.runs_.end(),
      [](const Run& a, const Run& b) { return std::tuple(a.from, a.to) < std::tuple(b.from, b.to); });
}

PageBits::PageBits(int width, int height, int gutter)
    : width_(width),
      height_(height),
      gutter_(gutter),
      border_(gutter / 2),
      words_((static_cast<std::size_t>(width) + 63) / 64),
      bits_(words_ * static_cast<std::size_t>(height), 0),
      blocked_(words_),
      smear_(words_) {}

std::optional<int> PageBits::free_column(const Shape& shape, int y) {
  const int from = border_, to = width_ - border_ - shape.width() + 1;
  std::fill(blocked_.begin(), blocked_.end(), 0);
  const auto h = static_cast<unsigned>(shape.height());
  // Rows far apart first: on a crowded page two or three of them already block every column.
  for (unsigned step = std::bit_floor(h); step > 0; step /= 2) {
    for (unsigned r = step - 1; r < h; r += 2 * step) {
      const uint64_t* taken = row(y + static_cast<int>(r));
      for (const Shape::Run* run = shape.begin(static_cast<int>(r)); run != shape.end(static_cast<int>(r));
           ++run) {
        // Column x is blocked where any of x + from ... x + to - 1 is taken: smeared by doubling.
        std::copy(taken, taken + words_, smear_.begin());
        const auto length = static_cast<std::size_t>(run->to - run->from);
        std::size_t done = 1;
        while (done < length) {
          const std::size_t more = std::min(done, length - done);
          // In place is safe: words are read at or above the one written.
          or_shifted(smear_.data(), smear_.data(), words_, more);
          done += more;
        }
        or_shifted(smear_.data(), blocked_.data(), words_, static_cast<std::size_t>(run->from));
      }
      if (first_zero(blocked_.data(), from, to) < 0) return std::nullopt;
    }
  }
  return first_zero(blocked_.data(), from, to);
}

std::optional<std::pair<int, int>> PageBits::place(const Shape& shape) {
  if (shape.width() > width_ - 2 * border_ || shape.height() > height_ - 2 * border_) return std::nullopt;
  int& start = searched_.try_emplace(shape, border_).first->second;
  for (; start <= height_ - border_ - shape.height(); ++start) {
    const std::optional<int> x = free_column(shape, start);
    if (!x) continue;
    take(shape, *x, start);
    return std::pair(*x, start);
  }
  return std::nullopt;
}

void PageBits::take(const Shape& shape, int x, int y) {
  for (int r = 0; r < shape.height(); ++r)
    for (const Shape::Run* run = shape.begin(r); run != shape.end(r); ++run)
      for (int v = std::max(0, y + r - gutter_); v <= std::min(height_ - 1, y + r + gutter_); ++v)
        set_range(row(v), std::max(0, x + run->from - gutter_), std::min(width_, x + run->to + gutter_));
}

}  // namespace sconce
