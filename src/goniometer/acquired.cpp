// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/parallel.h"
#include "core/text.h"
#include "goniometer/acquisition.h"
#include "image/io.h"

namespace sconce {

namespace {

constexpr double kMostNegative =
    0.002;  // share of a picture's light that noise around a dark picture may take off

/// The homography that takes the unit square's corners (counter-clockwise from (0, 0)) to four points.
Eigen::Matrix3d homography(const std::array<glm::dvec2, 4>& to) {
  constexpr double kSquare[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  Eigen::Matrix<double, 8, 8> a;
  Eigen::Matrix<double, 8, 1> b;
  for (int i = 0; i < 4; ++i) {
    const double u = kSquare[i][0], v = kSquare[i][1], x = to[static_cast<std::size_t>(i)].x,
                 y = to[static_cast<std::size_t>(i)].y;
    a.row(2 * i) << u, v, 1, 0, 0, 0, -u * x, -v * x;
    a.row(2 * i + 1) << 0, 0, 0, u, v, 1, -u * y, -v * y;
    b(2 * i) = x, b(2 * i + 1) = y;
  }
  const Eigen::Matrix<double, 8, 1> h = a.fullPivLu().solve(b);
  Eigen::Matrix3d out;
  out << h(0), h(1), h(2), h(3), h(4), h(5), h(6), h(7), 1;
  return out;
}

std::string named(std::string pattern, int m, int n, std::size_t exposure) {
  for (const auto& [mark, value] :
       {std::pair("{m}", std::size_t(m)), std::pair("{n}", std::size_t(n)), std::pair("{e}", exposure)})
    if (const std::size_t at = pattern.find(mark); at != std::string::npos)
      pattern.replace(at, 3, std::to_string(value));
  return pattern;
}

bool coded(const std::string& file) {
  const std::string type = lower(std::filesystem::path(file).extension().string());
  return type != ".exr" && type != ".hdr" && type != ".pic";
}

/// Between pixel centres; held at the border.
glm::dvec3 bilinear(const Image& image, double x, double y) {
  const double fx = std::clamp(x - 0.5, 0.0, image.width - 1.0),
               fy = std::clamp(y - 0.5, 0.0, image.height - 1.0);
  const int x0 = std::min(static_cast<int>(fx), std::max(0, image.width - 2)),
            y0 = std::min(static_cast<int>(fy), std::max(0, image.height - 2));
  const int x1 = std::min(x0 + 1, image.width - 1), y1 = std::min(y0 + 1, image.height - 1);
  const double u = fx - x0, v = fy - y0;
  const auto at = [&](int px, int py) {
    const Rgb texel = image.rgb_at(px, py);
    return glm::dvec3(texel.r, texel.g, texel.b);
  };
  return (1 - v) * ((1 - u) * at(x0, y0) + u * at(x1, y0)) + v * ((1 - u) * at(x0, y1) + u * at(x1, y1));
}

}  // namespace

Acquired::Acquired(std::filesystem::path folder, Acquisition acquisition)
    : folder_(std::move(folder)),
      acquisition_(std::move(acquisition)),
      field_(acquisition_.grid),
      done_(field_.terms()) {
  field_.irradiance.assign(field_.terms() * field_.pixels(), 0.0f);
  if (!acquisition_.dark.empty()) dark_ = read_image(folder_ / acquisition_.dark);
}

std::vector<std::string> Acquired::files_of(int m, int n) const {
  std::vector<std::string> out;
  const std::size_t exposures = std::max<std::size_t>(1, acquisition_.exposures.size());
  for (const std::string* pattern : {&acquisition_.name, &acquisition_.negative})
    for (std::size_t e = 0; e < exposures && !pattern->empty(); ++e) out.push_back(named(*pattern, m, n, e));
  return out;
}

std::string Acquired::missing() const {
  for (int n = 0; n < field_.rows; ++n)
    for (int m = 0; m < field_.columns; ++m) {
      if (done_[static_cast<std::size_t>(n * field_.columns + m)] != 0) continue;
      for (const std::string& file : files_of(m, n))
        if (!std::filesystem::exists(folder_ / file)) return file;
    }
  return {};
}

std::size_t Acquired::present() const {
  return static_cast<std::size_t>(std::count(done_.begin(), done_.end(), 1));
}

std::size_t Acquired::update() {
  std::size_t read = 0;
  for (int n = 0; n < field_.rows; ++n)
    for (int m = 0; m < field_.columns; ++m) {
      const auto term = static_cast<std::size_t>(n * field_.columns + m);
      const std::vector<std::string> files = files_of(m, n);
      if (done_[term] != 0 || !std::all_of(files.begin(), files.end(), [&](const std::string& file) {
            return std::filesystem::exists(folder_ / file);
          }))
        continue;
      std::vector<Rgb> lux = rectified(acquisition_.name, m, n);
      if (!acquisition_.negative.empty()) {
        const std::vector<Rgb> less = rectified(acquisition_.negative, m, n);
        for (std::size_t i = 0; i < lux.size(); ++i) lux[i] -= less[i];
      }
      set_term(term, lux);
      done_[term] = 1;
      ++read;
    }
  return read;
}

void Acquired::set_term(std::size_t term, std::span<const Rgb> lux) {
  std::vector<float>&all = field_.irradiance, &color = field_.color;
  const bool grey =
      std::all_of(lux.begin(), lux.end(), [](const Rgb& v) { return v.r == v.g && v.g == v.b; });
  if (color.empty() && !grey && acquisition_.color)  // those before it were grey
    for (int c = 0; c < 3; ++c) color.insert(color.end(), all.begin(), all.end());
  for (std::size_t i = 0; i < lux.size(); ++i) {
    const std::size_t at = term * field_.pixels() + i;
    all[at] = luminance(lux[i]);
    if (color.empty()) continue;
    color[at] = lux[i].r, color[all.size() + at] = lux[i].g, color[2 * all.size() + at] = lux[i].b;
  }
}

Image Acquired::merged(const std::string& pattern, int m, int n) const {
  const std::size_t exposures = std::max<std::size_t>(1, acquisition_.exposures.size());
  Image out;
  std::vector<float> weights;
  for (std::size_t e = 0; e < exposures; ++e) {
    const std::string file = named(pattern, m, n, e);
    const std::string where = (folder_ / file).string();
    const Image picture = read_image(folder_ / file);
    if (picture.stride() < 3) throw Error(where, "has no R, G and B");
    if (e == 0) {
      out = Image::rgb(picture.width, picture.height);
      weights.assign(out.pixels(), 0.0f);
    }
    const bool same = picture.width == out.width && picture.height == out.height &&
                      (width_ == 0 || (picture.width == width_ && picture.height == height_));
    if (!same || (dark_.width > 0 && (dark_.width != out.width || dark_.height != out.height)))
      throw Error(where, fmt::format("has {} x {} pixels, unlike the pictures before it", picture.width,
                                     picture.height));
    const bool codes = coded(file);
    const float seconds =
        acquisition_.exposures.empty() ? 1.0f : static_cast<float>(acquisition_.exposures[e]);
    const float top = acquisition_.saturation > 0 ? static_cast<float>(acquisition_.saturation)
                      : codes                     ? 0.995f
                                                  : std::numeric_limits<float>::max();
    for (std::size_t i = 0; i < out.pixels(); ++i) {
      const int x = static_cast<int>(i) % out.width, y = static_cast<int>(i) / out.width;
      Rgb value = picture.rgb_at(x, y);
      float most = std::max({value.r, value.g, value.b});
      if (codes) {
        // read_image() took them for sRGB; the code itself is what a camera's response is about.
        const auto decode = [&](float v) {
          return acquisition_.gamma > 0 ? std::pow(linear_to_srgb(v), static_cast<float>(acquisition_.gamma))
                                        : v;
        };
        most = linear_to_srgb(most);
        value = Rgb(decode(value.r), decode(value.g), decode(value.b));
      }
      if (!(most < top) || !std::isfinite(value.r + value.g + value.b)) continue;  // saturated
      // Longer exposures know dark pixels better; codes near either end know little.
      const float weight = codes ? seconds * (most * (1 - most) + 1e-4f) : seconds;
      if (dark_.width > 0) value -= dark_.rgb_at(x, y);
      const Rgb& white = acquisition_.white;
      value = Rgb(value.r / white.r, value.g / white.g, value.b / white.b);
      out.set_rgb(x, y, out.rgb_at(x, y) + value * (weight / seconds));
      weights[i] += weight;
    }
  }
  for (std::size_t i = 0; i < out.data.size(); ++i)
    out.data[i] = weights[i / 3] > 0 ? out.data[i] / weights[i / 3] : std::numeric_limits<float>::quiet_NaN();
  return out;
}

std::vector<Rgb> Acquired::rectified(const std::string& pattern, int m, int n) {
  const Image picture = merged(pattern, m, n);
  const std::string where = (folder_ / named(pattern, m, n, 0)).string();
  if (width_ == 0) {
    width_ = picture.width, height_ = picture.height;
    for (const glm::dvec2& c : acquisition_.corners)
      if (!(c.x >= 0 && c.y >= 0 && c.x <= width_ && c.y <= height_))
        throw Error(where, fmt::format("has {} x {} pixels; the corner ({:g}, {:g}) lies outside", width_,
                                       height_, c.x, c.y));
  }
  const Eigen::Matrix3d h = homography(acquisition_.corners);
  const auto at = [&](double u, double v) {
    const Eigen::Vector3d p = h * Eigen::Vector3d(u, v, 1);
    return glm::dvec2(p.x() / p.z(), p.y() / p.z());
  };
  // So many points per pixel and axis that none of the picture's pixels is stepped over.
  double longest = 0;
  for (std::size_t i = 0; i < 4; ++i)
    longest = std::max(longest, glm::length(acquisition_.corners[i] - acquisition_.corners[(i + 1) % 4]));
  const int points =
      std::clamp(static_cast<int>(std::ceil(2 * longest / std::min(field_.width, field_.height))), 2, 32);
  std::vector<Rgb> out(field_.pixels());
  parallel_for(static_cast<std::size_t>(field_.height), 1, [&](std::size_t t) {
    for (int s = 0; s < field_.width; ++s) {
      glm::dvec3 sum(0);
      for (int j = 0; j < points; ++j)
        for (int i = 0; i < points; ++i) {
          const glm::dvec2 p = at((s + (i + 0.5) / points) / field_.width,
                                  (static_cast<double>(t) + (j + 0.5) / points) / field_.height);
          sum += bilinear(picture, p.x, p.y);
        }
      sum *= acquisition_.lux / (points * points);
      out[t * static_cast<std::size_t>(field_.width) + static_cast<std::size_t>(s)] =
          Rgb(static_cast<float>(sum.x), static_cast<float>(sum.y), static_cast<float>(sum.z));
    }
  });
  const auto saturated =
      std::count_if(out.begin(), out.end(), [](const Rgb& v) { return !std::isfinite(v.r + v.g + v.b); });
  if (saturated > 0)
    throw Error(where, fmt::format("is saturated in {} of {} pixels of the screen", saturated, out.size()),
                "an exposure short enough for the brightest spot");
  // Of the picture itself, before means hide them; its luminance, as a pure colour may lie outside of RGB.
  double light = 0, negative = 0;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x)
      if (const auto v = static_cast<double>(luminance(picture.rgb_at(x, y))); std::isfinite(v))
        (v < 0 ? negative : light) += std::abs(v);
  if (negative > kMostNegative * light)
    throw Error(
        where,
        fmt::format("has negative pixels: {:.1f} % of its light", 100 * negative / std::max(light, 1e-30)),
        "light; the filter's negative part is a picture of its own");
  return out;
}

}  // namespace sconce
