// SPDX-License-Identifier: Apache-2.0
#include "image/flip.h"

#include <array>
#include <cmath>
#include <numeric>

#include "core/error.h"
#include "core/parallel.h"
#include "image/primaries.h"

namespace sconce {

namespace {

constexpr double kPi = 3.14159265358979323846;

using Triple = std::array<double, 3>;
using Taps = std::vector<double>;  ///< of a filter along one axis, 2 r + 1

struct Plane {
  int width = 0, height = 0;
  std::vector<float> data;
  Plane(int w, int h)
      : width(w), height(h), data(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), 0.0f) {}
  float* row(int y) { return &data[static_cast<std::size_t>(y) * static_cast<std::size_t>(width)]; }
  const float* row(int y) const { return const_cast<Plane*>(this)->row(y); }
};

/// Filtered along x, then along y; the border's values go on outside.
Plane filter(const Plane& in, const Taps& along_x, const Taps& along_y) {
  const int rx = static_cast<int>(along_x.size() / 2), ry = static_cast<int>(along_y.size() / 2);
  Plane half(in.width, in.height), out(in.width, in.height);
  parallel_for(static_cast<std::size_t>(in.height), 8, [&](std::size_t row) {
    const float* from = in.row(static_cast<int>(row));
    float* to = half.row(static_cast<int>(row));
    for (int x = 0; x < in.width; ++x) {
      double sum = 0;
      for (int i = -rx; i <= rx; ++i)
        sum += along_x[static_cast<std::size_t>(i + rx)] * from[std::clamp(x + i, 0, in.width - 1)];
      to[x] = static_cast<float>(sum);
    }
  });
  parallel_for(static_cast<std::size_t>(in.height), 8, [&](std::size_t row) {
    std::vector<double> sum(static_cast<std::size_t>(in.width), 0.0);
    for (int i = -ry; i <= ry; ++i) {
      const float* from = half.row(std::clamp(static_cast<int>(row) + i, 0, in.height - 1));
      const double tap = along_y[static_cast<std::size_t>(i + ry)];
      for (std::size_t x = 0; x < sum.size(); ++x) sum[x] += tap * from[x];
    }
    std::copy(sum.begin(), sum.end(), out.row(static_cast<int>(row)));
  });
  return out;
}

double sum_of(const Taps& taps) {
  return std::accumulate(taps.begin(), taps.end(), 0.0);
}

/// f(x) at whole x from -radius to radius.
template <class F>
Taps sampled(int radius, const F& f) {
  Taps taps;
  for (int x = -radius; x <= radius; ++x) taps.push_back(f(double(x)));
  return taps;
}

// ---- Colours.

double lab_curve(double t) {
  constexpr double kDelta = 6.0 / 29;
  return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0 / 29;
}

/// To and from XYZ over the white's; from linear Rec. 709.
class Colors {
 public:
  Colors() : to_(rgb_to_xyz(kRec709Primaries)), back_(inverse(to_)) {
    for (std::size_t i = 0; i < 3; ++i) white_[i] = to_[i][0] + to_[i][1] + to_[i][2];
  }

  Triple relative_xyz(const Triple& rgb) const {
    const Triple xyz = transform(to_, rgb);
    return {xyz[0] / white_[0], xyz[1] / white_[1], xyz[2] / white_[2]};
  }
  Triple rgb(const Triple& relative) const {
    return transform(back_, {relative[0] * white_[0], relative[1] * white_[1], relative[2] * white_[2]});
  }

  /// CIELAB whose chroma fades with lightness, as Hunt found (Section 4.1.3).
  Triple hunt_lab(const Triple& rgb) const {
    const Triple xyz = relative_xyz(rgb);
    const double x = lab_curve(xyz[0]), y = lab_curve(xyz[1]), z = lab_curve(xyz[2]);
    const double lightness = 116 * y - 16;
    return {lightness, 0.01 * lightness * 500 * (x - y), 0.01 * lightness * 200 * (y - z)};
  }

 private:
  ColorMatrix to_, back_;
  Triple white_{};
};

/// Abasi, Tehran and Fairchild's distance for large differences (Section 4.1.3).
double hyab(const Triple& a, const Triple& b) {
  return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

/// Opponent space YCxCz, linear in light; one plane each (Section 4.1.1).
std::array<Plane, 3> opponent_planes(const Image& image, const Colors& colors) {
  std::array<Plane, 3> out{Plane(image.width, image.height), Plane(image.width, image.height),
                           Plane(image.width, image.height)};
  for (std::size_t i = 0; i < image.pixels(); ++i) {
    const float* p = &image.data[3 * i];
    const Triple xyz = colors.relative_xyz({p[0], p[1], p[2]});
    out[0].data[i] = static_cast<float>(116 * xyz[1] - 16);
    out[1].data[i] = static_cast<float>(500 * (xyz[0] - xyz[1]));
    out[2].data[i] = static_cast<float>(200 * (xyz[1] - xyz[2]));
  }
  return out;
}

Triple rgb_of_opponent(const Triple& c, const Colors& colors) {
  const double y = (c[0] + 16) / 116;
  return colors.rgb({c[1] / 500 + y, y, y - c[2] / 200});
}

/// What the eye's contrast sensitivity leaves: sums of Gaussians a sqrt(pi / b) exp(-(pi d)^2 / b), d in
/// degrees (Section 4.1.1, Table 1).
void see(std::array<Plane, 3>& planes, double pixels_per_degree) {
  struct Gaussian {
    double a, b;
  };
  static constexpr std::array<std::array<Gaussian, 2>, 3> kSensitivity{
      {{{{1, 0.0047}, {0, 1e-5}}}, {{{1, 0.0053}, {0, 1e-5}}}, {{{34.1, 0.04}, {13.5, 0.025}}}}};
  const int radius = static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * kPi * kPi)) * pixels_per_degree));
  for (std::size_t c = 0; c < 3; ++c) {
    Plane sum(planes[c].width, planes[c].height);
    double whole = 0;
    for (const Gaussian& g : kSensitivity[c]) {
      if (g.a == 0) continue;
      const Taps taps = sampled(
          radius, [&](double x) { return std::exp(-std::pow(kPi * x / pixels_per_degree, 2) / g.b); });
      const double scale = g.a * std::sqrt(kPi / g.b);
      whole += scale * std::pow(sum_of(taps), 2);
      const Plane part = filter(planes[c], taps, taps);
      for (std::size_t i = 0; i < sum.data.size(); ++i)
        sum.data[i] += static_cast<float>(scale * part.data[i]);
    }
    for (float& v : sum.data) v = static_cast<float>(v / whole);
    planes[c] = std::move(sum);
  }
}

/// Colour error in [0, 1] of a HyAB distance: the largest there is, green to blue, maps to 1 (Section 4.1.4).
class ColorError {
 public:
  explicit ColorError(const Colors& colors)
      : largest_(std::pow(hyab(colors.hunt_lab({0, 1, 0}), colors.hunt_lab({0, 0, 1})), kExponent)) {}

  double of(double distance) const {
    const double e = std::pow(distance, kExponent), knee = kKnee * largest_;
    return e < knee ? kAtKnee / knee * e : kAtKnee + (e - knee) / (largest_ - knee) * (1 - kAtKnee);
  }

 private:
  static constexpr double kExponent = 0.7, kKnee = 0.4, kAtKnee = 0.95;
  double largest_;
};

// ---- Features.

/// Lengths of the gradient's and of the second derivative's filtered answers (Section 4.2).
struct Features {
  Plane edges, points;
};

/// @param grey  lightness in [0, 1]
Features features_of(const Plane& grey, double pixels_per_degree) {
  constexpr double kWidth = 0.082;  // degrees: what an edge detector of the eye spans
  const double sigma = 0.5 * kWidth * pixels_per_degree;
  const int radius = static_cast<int>(std::ceil(3 * sigma));
  const auto gauss = [&](double x) { return std::exp(-x * x / (2 * sigma * sigma)); };
  Taps smooth = sampled(radius, gauss);
  for (double whole = sum_of(smooth); double& v : smooth) v /= whole;
  const auto length = [&](Taps taps) {
    double positive = 0, negative = 0;
    for (const double v : taps) (v > 0 ? positive : negative) += std::abs(v);
    for (double& v : taps) v /= v > 0 ? positive : negative;
    Plane across = filter(grey, taps, smooth);
    const Plane down = filter(grey, smooth, taps);
    for (std::size_t i = 0; i < across.data.size(); ++i)
      across.data[i] = std::hypot(across.data[i], down.data[i]);
    return across;
  };
  return {length(sampled(radius, [&](double x) { return -x * gauss(x); })),
          length(sampled(radius, [&](double x) { return (x * x / (sigma * sigma) - 1) * gauss(x); }))};
}

Plane lightness(const Plane& y) {
  Plane out = y;
  for (float& v : out.data) v = (v + 16) / 116;
  return out;
}

}  // namespace

bool is_display_light(const Image& image) {
  return image.stride() == 3 &&
         std::all_of(image.data.begin(), image.data.end(), [](float v) { return v >= 0 && v <= 1; });
}

Flip flip(const Image& a, const Image& b, double pixels_per_degree) {
  if (a.width != b.width || a.height != b.height || a.data.empty())
    throw Error({}, "images differ in size or are empty");
  if (!is_display_light(a) || !is_display_light(b))
    throw Error({}, "FLIP is of pictures for a display", "R, G, B from 0 to 1: a PNG, or a tone mapped EXR");
  const Colors colors;
  const ColorError error(colors);
  std::array<Plane, 3> seen_a = opponent_planes(a, colors), seen_b = opponent_planes(b, colors);
  const Features features_a = features_of(lightness(seen_a[0]), pixels_per_degree);
  const Features features_b = features_of(lightness(seen_b[0]), pixels_per_degree);
  see(seen_a, pixels_per_degree);
  see(seen_b, pixels_per_degree);

  const auto lab = [&](const std::array<Plane, 3>& seen, std::size_t i) {
    Triple rgb = rgb_of_opponent({seen[0].data[i], seen[1].data[i], seen[2].data[i]}, colors);
    for (double& v : rgb) v = std::clamp(v, 0.0, 1.0);
    return colors.hunt_lab(rgb);
  };
  Flip out{0, Image(a.width, a.height, {"flip"})};
  const std::size_t width = static_cast<std::size_t>(a.width);
  parallel_for(static_cast<std::size_t>(a.height), 8, [&](std::size_t y) {
    for (std::size_t i = y * width; i < (y + 1) * width; ++i) {
      const double color = error.of(hyab(lab(seen_a, i), lab(seen_b, i)));
      const double edge = std::abs(features_a.edges.data[i] - features_b.edges.data[i]);
      const double point = std::abs(features_a.points.data[i] - features_b.points.data[i]);
      const double feature = std::sqrt(std::max(edge, point) / std::sqrt(2.0));
      out.map.data[i] = static_cast<float>(std::pow(color, 1 - feature));
    }
  });
  out.mean = std::accumulate(out.map.data.begin(), out.map.data.end(), 0.0) / static_cast<double>(a.pixels());
  return out;
}

}  // namespace sconce
