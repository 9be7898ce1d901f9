// SPDX-License-Identifier: Apache-2.0
#include "image/metrics.h"

#include <cmath>
#include <limits>
#include <string>

#include "core/error.h"
#include "image/metrics_mask.h"

namespace sconce {

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::string size_text(const Image& i) {
  return std::to_string(i.width) + "x" + std::to_string(i.height);
}

void check_alike(const Image& a, const Image& b) {
  if (a.width != b.width || a.height != b.height)
    throw Error({}, "images differ in size: " + size_text(a) + " and " + size_text(b));
  if (a.channels != b.channels) throw Error({}, "images differ in their channels");
  if (a.data.empty()) throw Error({}, "images are empty");
}

/// Luminance of three channels, else their mean.
double brightness(const float* p, std::size_t channels) {
  if (channels == 3) return luminance({p[0], p[1], p[2]});
  double sum = 0;
  for (std::size_t c = 0; c < channels; ++c) sum += p[c];
  return sum / static_cast<double>(channels);
}

}  // namespace

std::vector<char> kept_pixels(const Image* mask, int width, int height) {
  std::vector<char> kept(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 1);
  if (mask == nullptr) return kept;
  if (mask->width != width || mask->height != height)
    throw Error({}, "the mask is " + size_text(*mask) + ", the images are " + std::to_string(width) + "x" +
                        std::to_string(height));
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float* p = mask->at(x, y);
      bool covered = false;
      for (std::size_t c = 0; c < mask->stride(); ++c) covered |= !(p[c] <= 0);
      for (int v = std::max(0, y - 1); covered && v <= std::min(height - 1, y + 1); ++v)
        for (int u = std::max(0, x - 1); u <= std::min(width - 1, x + 1); ++u)
          kept[static_cast<std::size_t>(v) * static_cast<std::size_t>(width) + static_cast<std::size_t>(u)] =
              0;
    }
  return kept;
}

Comparison compare(const Image& a, const Image& b) {
  check_alike(a, b);
  const std::size_t channels = a.stride();
  const double n = static_cast<double>(a.data.size());
  Comparison out;
  double mean = 0, bright_a = 0, bright_b = 0;
  for (std::size_t i = 0; i < a.pixels(); ++i) {
    bool finite = true;
    for (std::size_t k = i * channels; k < (i + 1) * channels; ++k) {
      finite &= std::isfinite(a.data[k]) && std::isfinite(b.data[k]);
      mean += b.data[k] / n;
    }
    if (!finite) ++out.not_finite;
    bright_a += brightness(&a.data[i * channels], channels);
    bright_b += brightness(&b.data[i * channels], channels);
  }
  if (out.not_finite > 0) return {kNan, kNan, kNan, kNan, out.not_finite};
  // Two black images are equal; relmse must not say 0/0.
  const double offset = std::max(0.01 * mean * mean, std::numeric_limits<double>::min());
  for (std::size_t k = 0; k < a.data.size(); ++k) {
    const double d = double{a.data[k]} - b.data[k];
    out.mse += d * d / n;
    out.relmse += d * d / (double{b.data[k]} * b.data[k] + offset) / n;
    out.max = std::max(out.max, std::abs(d));
  }
  out.mean_ratio = bright_a / bright_b;
  return out;
}

RelativeRmse relative_rmse(const Image& picture, const Image& s0, const Image* s1, const Image* mask) {
  check_alike(picture, s0);
  if (s1 != nullptr) check_alike(picture, *s1);
  const int width = picture.width, height = picture.height;
  const std::size_t channels = picture.stride();
  const std::vector<char> kept = kept_pixels(mask, width, height);

  RelativeRmse out;
  out.boxes = Image((width + kBox - 1) / kBox, (height + kBox - 1) / kBox, {"error"});
  double squared = 0, noise = 0, mean = 0, bright_picture = 0, bright_reference = 0;
  for (int by = 0; by < out.boxes.height; ++by)
    for (int bx = 0; bx < out.boxes.width; ++bx) {
      std::vector<double> error(channels, 0.0), difference(channels, 0.0);
      int pixels = 0, of = 0;
      for (int y = by * kBox; y < std::min(height, (by + 1) * kBox); ++y)
        for (int x = bx * kBox; x < std::min(width, (bx + 1) * kBox); ++x) {
          ++of;
          if (!kept[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                    static_cast<std::size_t>(x)])
            continue;
          ++pixels;
          const float* p = picture.at(x, y);
          const float* r0 = s0.at(x, y);
          const float* r1 = s1 != nullptr ? s1->at(x, y) : r0;
          for (std::size_t c = 0; c < channels; ++c) {
            const double reference = 0.5 * (double{r0[c]} + r1[c]);
            error[c] += p[c] - reference;
            difference[c] += double{r0[c]} - r1[c];
            mean += reference;
          }
          bright_picture += brightness(p, channels);
          bright_reference += 0.5 * (brightness(r0, channels) + brightness(r1, channels));
        }
      out.kept_pixels += static_cast<std::size_t>(pixels);
      float& box = *out.boxes.at(bx, by);
      box = -1;
      if (pixels == 0 || 2 * pixels < of) continue;
      ++out.kept;
      double box_squared = 0;
      for (std::size_t c = 0; c < channels; ++c) {
        box_squared += std::pow(error[c] / pixels, 2);
        noise += std::pow(difference[c] / pixels, 2) / 4;
      }
      squared += box_squared;
      box = static_cast<float>(std::sqrt(box_squared / static_cast<double>(channels)));
    }
  const double samples = static_cast<double>(out.kept * channels);
  mean /= static_cast<double>(out.kept_pixels * channels);
  const double excess = (squared - noise) / samples;
  out.rmse = std::isfinite(excess) ? std::sqrt(std::max(0.0, excess)) / mean : kNan;
  out.noise = std::sqrt(noise / samples) / mean;
  out.mean_ratio = bright_picture / bright_reference;
  for (float& box : out.boxes.data)
    if (box != -1) box = static_cast<float>(box / mean);
  return out;
}

}  // namespace sconce
