// SPDX-License-Identifier: Apache-2.0
#include "image/primaries.h"

#include <cmath>
#include <set>

#include "core/error.h"
#include "core/parallel.h"

namespace sconce {

namespace {

double determinant(const ColorMatrix& m) {
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

ColorMatrix multiply(const ColorMatrix& a, const ColorMatrix& b) {
  ColorMatrix out{};
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t k = 0; k < 3; ++k) out[r][c] += a[r][k] * b[k][c];
  return out;
}

/// Of three channels.
void apply(const ColorMatrix& m, Image& image, const std::array<int, 3>& channels) {
  const auto [r, g, b] = channels;
  parallel_for(static_cast<std::size_t>(image.height), 16, [&](std::size_t y) {
    for (int x = 0; x < image.width; ++x) {
      float* p = image.at(x, static_cast<int>(y));
      const std::array<double, 3> c = transform(m, {p[r], p[g], p[b]});
      p[r] = static_cast<float>(c[0]), p[g] = static_cast<float>(c[1]), p[b] = static_cast<float>(c[2]);
    }
  });
}

}  // namespace

ColorMatrix inverse(const ColorMatrix& m) {
  ColorMatrix out;
  const double d = determinant(m);
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t r1 = (c + 1) % 3, r2 = (c + 2) % 3, c1 = (r + 1) % 3, c2 = (r + 2) % 3;
      out[r][c] = (m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1]) / d;
    }
  return out;
}

std::array<double, 3> transform(const ColorMatrix& m, const std::array<double, 3>& c) {
  std::array<double, 3> out;
  for (std::size_t r = 0; r < 3; ++r) out[r] = m[r][0] * c[0] + m[r][1] * c[1] + m[r][2] * c[2];
  return out;
}

ColorMatrix rgb_to_xyz(const std::array<float, 8>& p) {
  ColorMatrix m;
  for (std::size_t i = 0; i < 3; ++i) {
    const double x = p[2 * i], y = p[2 * i + 1];
    m[0][i] = x, m[1][i] = y, m[2][i] = 1 - x - y;
  }
  const double white[3] = {p[6] / double{p[7]}, 1.0, (1 - double{p[6]} - double{p[7]}) / double{p[7]}};
  const ColorMatrix back = inverse(m);
  for (std::size_t i = 0; i < 3; ++i) {
    const double scale = back[i][0] * white[0] + back[i][1] * white[1] + back[i][2] * white[2];
    for (auto& row : m) row[i] *= scale;
  }
  return m;
}

ColorMatrix rec709_to_acescg() {
  // Bradford's cone responses, and what makes one white the other there.
  constexpr ColorMatrix kCones{
      {{0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}}};
  const ColorMatrix from = rgb_to_xyz(kRec709Primaries), to = rgb_to_xyz(kAcescgPrimaries);
  const auto white = [&](const ColorMatrix& m) { return transform(kCones, transform(m, {1, 1, 1})); };
  const std::array<double, 3> have = white(from), want = white(to);
  ColorMatrix scaled = kCones;
  for (std::size_t r = 0; r < 3; ++r)
    for (double& v : scaled[r]) v *= want[r] / have[r];
  return multiply(multiply(inverse(to), inverse(kCones)), multiply(scaled, from));
}

void to_acescg(Image& image) {
  const ColorMatrix m = rec709_to_acescg();
  for (const std::string& name : image.channels) {
    if (!(name == "R" || name.ends_with(".R"))) continue;
    const std::string layer = name.substr(0, name.size() - 1);
    const int g = image.channel(layer + "G"), b = image.channel(layer + "B");
    if (g >= 0 && b >= 0) apply(m, image, {image.channel(name), g, b});
  }
  image.primaries = kAcescgPrimaries;
}

void to_rec709(Image& image) {
  const int r = image.channel("R"), g = image.channel("G"), b = image.channel("B");
  const std::array<float, 8> from = image.primaries;
  if (r < 0 || g < 0 || b < 0 || from == kRec709Primaries) return;
  const ColorMatrix m = from == kAcescgPrimaries
                            ? inverse(rec709_to_acescg())
                            : multiply(inverse(rgb_to_xyz(kRec709Primaries)), rgb_to_xyz(from));
  if (!std::isfinite(m[0][0] + m[1][1] + m[2][2])) return;  // degenerate primaries say nothing
  apply(m, image, {r, g, b});
  image.primaries = kRec709Primaries;
}

Image rgb_part(const Image& image, const std::string& where) {
  std::array<int, 3> from{image.channel("R"), image.channel("G"), image.channel("B")};
  if (from[0] < 0 || from[1] < 0 || from[2] < 0) {
    std::set<std::string> layers;
    for (const std::string& c : image.channels)
      if (c.size() > 2 && c.compare(c.size() - 2, 2, ".R") == 0) layers.insert(c.substr(0, c.size() - 1));
    if (layers.size() > 1)
      throw Error(where, "holds " + std::to_string(layers.size()) + " layers side by side, one is expected");
    if (layers.size() == 1) {
      const std::string& layer = *layers.begin();
      from = {image.channel(layer + "R"), image.channel(layer + "G"), image.channel(layer + "B")};
    }
    if (layers.empty() || from[1] < 0 || from[2] < 0) {
      const int only = image.channel("Y") >= 0 ? image.channel("Y") : 0;
      from = {only, only, only};
    }
  }
  Image out = Image::rgb(image.width, image.height);
  out.text = image.text;
  out.number = image.number;
  out.primaries = image.primaries;
  for (std::size_t i = 0; i < image.pixels(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      out.data[3 * i + c] = image.data[i * image.stride() + static_cast<std::size_t>(from[c])];
  return out;
}

}  // namespace sconce
