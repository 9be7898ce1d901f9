// SPDX-License-Identifier: Apache-2.0
// Photographs made here of a light field that is known: what a camera aslant sees of the screen.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/test_folder.h"
#include "goniometer/acquisition.h"
#include "image/io.h"

namespace sconce {
namespace {

constexpr int kColumns = 3, kRows = 2, kWidth = 320, kHeight = 240;
constexpr double kLux = 40;  // per picture value

/// Lux of one position at a point of the screen (mm): two blobs whose places depend on m and n; the second is
/// what the filter's negative part lets through.
double pattern(int m, int n, double x, double y, bool negative) {
  const double cx = 12.0 * (m - 1) + (negative ? 15 : 0), cy = 9.0 * (2 * n - 1), w = negative ? 9 : 12;
  return (negative ? 60 : 200) * std::exp(-((x - cx) * (x - cx) + (y - cy) * (y - cy)) / (w * w));
}

/// Where the camera sees a point of the screen (mm), pixels; and back. A perspective that is not aligned with
/// anything.
constexpr double kTilt = 0.0025;
glm::dvec2 seen(double x, double y) {
  const double z = 1 + kTilt * x;
  return {160 + (2.1 * x + 0.2 * y) / z, 120 - (2.0 * y - 0.1 * x) / z};
}
glm::dvec2 on_screen(double px, double py) {
  const double u = px - 160, v = 120 - py;
  // u (1 + k x) = 2.1 x + 0.2 y; v (1 + k x) = -0.1 x + 2 y.
  const double a = 2.1 - kTilt * u, b = 0.2, c = -0.1 - kTilt * v, d = 2.0, det = a * d - b * c;
  return {(u * d - b * v) / det, (a * v - c * u) / det};
}

std::string settings(const std::string& more_camera = "",
                     const std::string& pictures = "name = \"p{m}_{n}.exr\"") {
  std::string corners;
  for (const auto& [x, y] :
       {std::pair(-40, -40), std::pair(40, -40), std::pair(40, 40), std::pair(-40, 40)}) {
    const glm::dvec2 p = seen(x, y);
    corners += fmt::format("[{}, {}], ", p.x, p.y);
  }
  return fmt::format(
      "[filter]\ncolumns = {}\nrows = {}\nspacing = 5\n[plane]\ndistance = 125\nwidth = 80\npixels = "
      "20\n[camera]\n"
      "corners = [{}]\nlux = {}\n{}\n[pictures]\n{}\n",
      kColumns, kRows, corners, kLux, more_camera, pictures);
}

/// @param scale  of values; clipped at `top`
Image photograph(int m, int n, bool negative, double scale, double top, const Rgb& tint = Rgb(1)) {
  Image out = Image::rgb(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const glm::dvec2 p = on_screen(x + 0.5, y + 0.5);
      out.set_rgb(x, y,
                  tint * static_cast<float>(std::min(top, scale * pattern(m, n, p.x, p.y, negative) / kLux)));
    }
  return out;
}

class Acquire : public testing::Test {
 protected:
  void take(bool with_negative, const Rgb& tint = Rgb(1)) {
    for (int n = 0; n < kRows; ++n)
      for (int m = 0; m < kColumns; ++m) {
        write_exr(folder_ / fmt::format("p{}_{}.exr", m, n), photograph(m, n, false, 1, 1e9, tint),
                  PixelType::full);
        if (with_negative)
          write_exr(folder_ / fmt::format("n{}_{}.exr", m, n), photograph(m, n, true, 1, 1e9, tint),
                    PixelType::full);
      }
  }
  Acquired acquire(const std::string& toml) {
    return Acquired(folder_.path(), read_acquisition(folder_.write("acquire.toml", toml)));
  }
  /// What is wrong, from the file's name on.
  std::string error(const std::string& toml) {
    try {
      Acquired acquired = acquire(toml);
      acquired.update();
    } catch (const Error& e) {
      const std::string what = e.what();
      return what.substr(folder_.path().string().size() + 1);
    }
    return "no error";
  }
  /// Largest error of a pixel over the largest pixel, and of a term's flux.
  static void expect_known(const LightField& field, bool signed_, double allowed) {
    constexpr int kPoints = 8;
    double most = 0, worst = 0, total = 0, known = 0;
    for (int n = 0; n < kRows; ++n)
      for (int m = 0; m < kColumns; ++m)
        for (int t = 0; t < field.height; ++t)
          for (int s = 0; s < field.width; ++s) {
            double mean = 0;
            for (int i = 0; i < kPoints * kPoints; ++i) {
              const double x = -40 + 4 * (s + (i % kPoints + 0.5) / kPoints),
                           y = -40 + 4 * (t + (i / kPoints + 0.5) / kPoints);
              mean += pattern(m, n, x, y, false) - (signed_ ? pattern(m, n, x, y, true) : 0);
            }
            mean /= kPoints * kPoints;
            const double ours = field.image(
                static_cast<std::size_t>(n * kColumns + m))[static_cast<std::size_t>(t * field.width + s)];
            most = std::max(most, std::abs(mean)), worst = std::max(worst, std::abs(ours - mean));
            total += ours, known += mean;
          }
    EXPECT_LT(worst / most, allowed);
    EXPECT_NEAR(total / known, 1, 0.01);
    EXPECT_NEAR(flux(field), total * field.pixel * field.pixel, 1e-6 * total);
  }
  TemporaryFolder folder_;
};

TEST_F(Acquire, HdrPhotographsOfAKnownField) {
  take(true);
  Acquired acquired = acquire(settings());
  EXPECT_EQ(acquired.update(), 6u);
  EXPECT_EQ(acquired.present(), acquired.positions());
  expect_known(acquired.field(), false, 0.01);
  EXPECT_EQ(acquired.field().spacing, 0.005);
  EXPECT_NEAR(acquired.field().first.x, -0.005, 1e-12);
  EXPECT_NEAR(acquired.field().corner.y, -0.04, 1e-12);
  Acquired both = acquire(settings("", "name = \"p{m}_{n}.exr\"\nnegative = \"n{m}_{n}.exr\""));
  both.update();
  expect_known(both.field(), true, 0.01);
}

// A lamp's colour is its light field's, the negative part taken off channel by channel; told what white looks
// like, pictures of it are white; without colours the luminance is left. The first pictures may be grey.
TEST_F(Acquire, ColoursOfPhotographs) {
  const std::string both = "name = \"p{m}_{n}.exr\"\nnegative = \"n{m}_{n}.exr\"";
  take(true);
  Acquired plain = acquire(settings("", both));
  plain.update();
  const LightField grey = plain.field();
  EXPECT_TRUE(grey.is_grey());
  const Rgb tint(1.5f, 1, 0.25f);
  const float white = luminance(tint);
  take(true, tint);
  for (const char* sign : {"p", "n"})
    write_exr(folder_ / fmt::format("{}0_0.exr", sign), photograph(0, 0, sign[0] == 'n', 1, 1e9),
              PixelType::full);
  const auto expect = [&](const std::string& camera, const Rgb& first, const Rgb& others, bool colored) {
    Acquired acquired = acquire(settings(camera, both));
    acquired.update();
    const LightField& field = acquired.field();
    ASSERT_EQ(field.is_grey(), !colored);
    for (std::size_t i = 0; i < field.irradiance.size(); ++i) {
      const Rgb want = (i < field.pixels() ? first : others) * grey.irradiance[i];
      const double allowed = 1e-5 * (1 + std::abs(static_cast<double>(grey.irradiance[i])));
      ASSERT_NEAR(field.irradiance[i], luminance(want), allowed);
      if (!colored) continue;
      ASSERT_NEAR(field.color[i], want.r, allowed);
      ASSERT_NEAR(field.color[field.irradiance.size() + i], want.g, allowed);
      ASSERT_NEAR(field.color[2 * field.irradiance.size() + i], want.b, allowed);
    }
  };
  expect("", Rgb(1), tint, true);
  expect("color = false", Rgb(1), Rgb(white), false);
  const Rgb turned(white / tint.r, white / tint.g, white / tint.b);
  expect("white = [1.5, 1, 0.25]", turned, Rgb(white), true);
  EXPECT_NE(error(settings("white = [1, 0, 1]", both)).find("[camera] white: is not positive"),
            std::string::npos);
}

// Three exposures of 8 bit by gamma 2.2; the longest is saturated in the blobs, the shortest knows nothing of
// their skirts.
TEST_F(Acquire, ExposureSeries) {
  for (int n = 0; n < kRows; ++n)
    for (int m = 0; m < kColumns; ++m)
      for (int e = 0; e < 3; ++e) {
        const Image linear = photograph(m, n, false, std::pow(0.25, e) * 0.6, 1);
        Image8 codes{kWidth, kHeight, 3, {}};
        for (const float v : linear.data)
          codes.data.push_back(static_cast<unsigned char>(std::lround(255 * std::pow(v, 1 / 2.2f))));
        write_png(folder_ / fmt::format("p{}_{}_{}.png", m, n, e), codes);
      }
  Acquired acquired =
      acquire(settings("gamma = 2.2", "name = \"p{m}_{n}_{e}.png\"\nexposures = [0.6, 0.15, 0.0375]"));
  EXPECT_EQ(acquired.update(), 6u);
  expect_known(acquired.field(), false, 0.01);
}

TEST_F(Acquire, PicturesThatComeLater) {
  take(false);
  std::filesystem::rename(folder_ / "p2_1.exr", folder_ / "later");
  Acquired acquired = acquire(settings());
  EXPECT_EQ(acquired.update(), 5u);
  EXPECT_EQ(acquired.missing(), "p2_1.exr");
  EXPECT_FALSE(acquired.has(5));
  std::filesystem::rename(folder_ / "later", folder_ / "p2_1.exr");
  EXPECT_EQ(acquired.update(), 1u);
  EXPECT_EQ(acquired.missing(), "");
}

TEST_F(Acquire, BadInputIsOneLine) {
  take(false);
  const std::string good = settings();
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    return error(text);
  };
  EXPECT_EQ(error(good), "no error");
  const auto starts = [](const std::string& text, const std::string& with_this) {
    EXPECT_EQ(text.substr(0, with_this.size()), with_this);
  };
  starts(with("distance = 125", "distance = -125"),
         "acquire.toml:6: [plane] distance: the screen does not lie behind the filter (allowed: millimetres "
         "> 0");
  starts(with("columns = 3", "columns = 2.5"),
         "acquire.toml:2: [filter] columns: is 2.5 (allowed: a whole number from 1");
  starts(with("name = \"p{m}_{n}.exr\"", "name = \"p{m}.exr\""),
         "acquire.toml:14: [pictures] name: 'p{m}.exr' lacks {n} (allowed: {m} and {n}");
  starts(with("lux = 40", "lumens = 40"), "acquire.toml:11: unknown key 'lumens'");
  std::string turned = good;
  const std::size_t a = turned.find("corners = [[") + 11, b = turned.find("], ", a) + 3,
                    c = turned.find("], ", b) + 3, d = turned.find("], ", c) + 3,
                    e = turned.find("], ", d) + 3;
  turned = turned.substr(0, a) + turned.substr(a, b - a) + turned.substr(d, e - d) + turned.substr(c, d - c) +
           turned.substr(b, c - b) + turned.substr(e);
  starts(error(turned), "acquire.toml:10: [camera] corners: run round as in a mirror: in what order");
  Image spoilt = photograph(1, 0, false, 1, 1e9);
  for (int i = 0; i < 20; ++i) spoilt.set_rgb(160 + i, 120, Rgb(std::numeric_limits<float>::infinity()));
  write_exr(folder_ / "p1_0.exr", spoilt, PixelType::full);
  starts(error(good), "p1_0.exr: is saturated in ");
  spoilt = photograph(1, 0, false, 1, 1e9);
  for (int y = 100; y < 140; ++y) spoilt.set_rgb(160, y, Rgb(-2));
  write_exr(folder_ / "p1_0.exr", spoilt, PixelType::full);
  starts(error(good), "p1_0.exr: has negative pixels: ");
  write_exr(folder_ / "p1_0.exr", Image::rgb(10, 10), PixelType::full);
  EXPECT_EQ(error(good), "p1_0.exr: has 10 x 10 pixels, unlike the pictures before it");
  folder_.write("p1_0.exr", "no picture");
  starts(error(good), "p1_0.exr:");
}

}  // namespace
}  // namespace sconce
