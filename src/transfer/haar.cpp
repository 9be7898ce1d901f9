// SPDX-License-Identifier: Apache-2.0
#include "transfer/haar.h"

#include <algorithm>

namespace sconce {

namespace {

template <class T>
struct Values;
template <>
struct Values<float> {
  static constexpr std::size_t kCount = 1;
  static float* of(float* p) { return p; }
};
template <std::size_t N>
struct Values<std::array<float, N>> {
  static constexpr std::size_t kCount = N;
  static float* of(std::array<float, N>* p) { return p->data(); }
};

template <class T>
void forward(std::span<T> square) {
  constexpr std::size_t kCount = Values<T>::kCount;
  std::vector<T> averages(square.begin(), square.end());
  for (std::size_t n = square.size() / 4; n > 0; n /= 4) {
    float* a = Values<T>::of(averages.data());
    float* out = Values<T>::of(square.data());
    for (std::size_t m = 0; m < n; ++m) {
      const float* block = a + 4 * kCount * m;
      for (std::size_t c = 0; c < kCount; ++c) {
        const float p = block[c], q = block[kCount + c], r = block[2 * kCount + c], s = block[3 * kCount + c];
        out[(n + m) * kCount + c] = 0.5f * (p - q + r - s);
        out[(2 * n + m) * kCount + c] = 0.5f * (p + q - r - s);
        out[(3 * n + m) * kCount + c] = 0.5f * (p - q - r + s);
        a[m * kCount + c] = 0.5f * (p + q + r + s);
      }
    }
  }
  square[0] = averages[0];
}

template <class T>
void inverse(std::span<T> square) {
  constexpr std::size_t kCount = Values<T>::kCount;
  std::vector<T> finer(square.size());
  for (std::size_t n = 1; n < square.size(); n *= 4) {
    float* in = Values<T>::of(square.data());
    float* out = Values<T>::of(finer.data());
    for (std::size_t m = 0; m < n; ++m) {
      for (std::size_t c = 0; c < kCount; ++c) {
        const float a = in[m * kCount + c], x = in[(n + m) * kCount + c], y = in[(2 * n + m) * kCount + c],
                    xy = in[(3 * n + m) * kCount + c];
        float* block = out + 4 * kCount * m + c;
        block[0] = 0.5f * (a + x + y + xy);
        block[kCount] = 0.5f * (a - x + y - xy);
        block[2 * kCount] = 0.5f * (a + x - y - xy);
        block[3 * kCount] = 0.5f * (a - x - y + xy);
      }
    }
    std::copy_n(finer.begin(), 4 * n, square.begin());
  }
}

}  // namespace

void haar_forward(std::span<float> square) {
  forward(square);
}
void haar_inverse(std::span<float> square) {
  inverse(square);
}
void haar_forward(std::span<Rgbx> square) {
  forward(square);
}
void haar_forward(std::span<Sixteen> square) {
  forward(square);
}
void haar_inverse(std::span<Rgbx> square) {
  inverse(square);
}

void haar_forward(std::vector<SparseEntry>& entries, uint32_t n, std::vector<SparseEntry>& out) {
  out.clear();
  for (uint32_t level = n / 4; level > 0; level /= 4) {
    std::size_t kept = 0;
    for (std::size_t k = 0; k < entries.size();) {
      const uint32_t m = entries[k].index / 4;
      float v[4] = {0, 0, 0, 0};
      for (; k < entries.size() && entries[k].index / 4 == m; ++k) v[entries[k].index % 4] = entries[k].value;
      const float details[3] = {0.5f * (v[0] - v[1] + v[2] - v[3]), 0.5f * (v[0] + v[1] - v[2] - v[3]),
                                0.5f * (v[0] - v[1] - v[2] + v[3])};
      for (uint32_t d = 0; d < 3; ++d)
        if (details[d] != 0) out.push_back({(d + 1) * level + m, details[d]});
      entries[kept++] = {m, 0.5f * (v[0] + v[1] + v[2] + v[3])};
    }
    entries.resize(kept);
  }
  if (!entries.empty() && entries[0].value != 0) out.push_back({0, entries[0].value});
}

}  // namespace sconce
