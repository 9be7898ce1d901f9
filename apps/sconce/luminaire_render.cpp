// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <filesystem>
#include <optional>

#include "app.h"
#include "core/error.h"
#include "core/hash.h"
#include "core/parallel.h"
#include "core/sobol.h"
#include "core/text.h"
#include "image/io.h"
#include "light/luminaire.h"
#include "luminaire.h"
#include "luminaire_between.h"
#include "photometry/formats.h"
#include "photometry/light_field_file.h"
#include "photometry/near_error.h"

namespace sconce::app {

namespace {

constexpr uint32_t kPoints = 64;  // of the opening, per pixel

/// A wall across nadir at a distance below the lamp, as seen from the lamp: x (C0) to the right, y (C90) up.
struct Wall {
  double distance, width;  ///< m
  int size;                ///< pixels along an edge

  Vec3 at(int x, int y) const {
    const double step = width / size;
    return {static_cast<float>((x + 0.5) * step - 0.5 * width),
            static_cast<float>(0.5 * width - (y + 0.5) * step), static_cast<float>(-distance)};
  }
};

template <class Lux>
Image paint(const Wall& wall, const Progress& progress, const Lux& lux) {
  Image out = Image::rgb(wall.size, wall.size);
  std::atomic<uint64_t> rows = 0;
  parallel_for(static_cast<std::size_t>(wall.size), 1, [&](std::size_t row) {
    progress.check();
    const int y = static_cast<int>(row);
    for (int x = 0; x < wall.size; ++x) out.set_rgb(x, y, lux(wall.at(x, y)));
    progress.at("rows", ++rows, static_cast<uint64_t>(wall.size));
  });
  return out;
}

/// What a light field predicts of its errors (ADR 39), as shares of the light on a wall.
struct Predicted {
  double filters = 0, noise = 0;
};

Predicted predict(const Wall& wall, const NearLamp& lamp) {
  constexpr int kSide = 32;  // points along an edge
  const Wall coarse{wall.distance, wall.width, kSide};
  const double pixel = wall.width / wall.size;
  const NearError error(lamp);
  double light = 0;
  Predicted out;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const Vec3 at = coarse.at(x, y), up(0, 0, 1);
      light += std::abs(lamp.approximate(at, up));
      out.filters += error.at(at, up), out.noise += lamp.noise(at, up, pixel);
    }
  for (double* v : {&out.filters, &out.noise}) *v = light > 0 ? *v / light : 0;
  return out;
}

/// Rays where they land: the lamp itself, with its noise. @param luminous  are they in lumens?
Image land(const Wall& wall, const std::string& file, const Between* between, const Progress& progress,
           bool& luminous) {
  Image out = Image::rgb(wall.size, wall.size);
  std::vector<glm::dvec3> sums(out.pixels());
  const double step = wall.width / wall.size;
  const auto pixel = [&](int x, int y) -> glm::dvec3& {
    return sums[static_cast<std::size_t>(y) * static_cast<std::size_t>(wall.size) +
                static_cast<std::size_t>(x)];
  };
  const auto land = [&](const SourceRay& ray) {
    const double way =
        (static_cast<double>(ray.position.z) + wall.distance) / static_cast<double>(-ray.direction.z);
    if (!(way > 0)) return;
    const glm::dvec2 at = glm::dvec2(ray.position) + way * glm::dvec2(ray.direction);
    const double x = (at.x + 0.5 * wall.width) / step, y = (0.5 * wall.width - at.y) / step;
    if (!(x >= 0 && y >= 0 && x < wall.size && y < wall.size)) return;
    Rgb light = ray.color;
    if (between != nullptr) light *= between->passed(ray.position, ray.direction, way);
    pixel(static_cast<int>(x), static_cast<int>(y)) +=
        static_cast<double>(ray.flux) * glm::dvec3(light.r, light.g, light.b);
  };
  luminous = read_rays(
                 file, [&](std::span<const SourceRay> rays) { std::ranges::for_each(rays, land); }, progress)
                 .luminous;
  for (int y = 0; y < wall.size; ++y)
    for (int x = 0; x < wall.size; ++x) {
      const Vec3 lux = pixel(x, y) / (step * step);
      out.set_rgb(x, y, Rgb(lux.x, lux.y, lux.z));
    }
  return out;
}

Image paint_table(const Wall& wall, const Photometry& p, const Progress& progress) {
  Light light;
  light.intensity = Rgb(1);
  const Lamp lamp = make_luminaire(light, p);
  const auto& shape = std::get<LuminaireLamp>(lamp.shape);
  const uint32_t points = p.opening.is_point() ? 1 : kPoints;
  return paint(wall, progress, [&](const Vec3& x) {
    double sum = 0;
    for (uint32_t i = 0; i < points; ++i) {
      LightSample sample;
      if (sconce::sample(shape, x, sobol_pair(i, 0, 1), sample))
        sum += static_cast<double>(sample.radiance.g * std::max(0.0f, sample.direction.z));
    }
    return Rgb(static_cast<float>(sum / points));
  });
}

/// The brightest value white.
void write_picture(const std::string& file, const Image& image) {
  const float most = *std::max_element(image.data.begin(), image.data.end());
  Image8 out{image.width, image.height, 3, {}};
  for (const float v : image.data)
    out.data.push_back(static_cast<unsigned char>(
        255 * linear_to_srgb(std::clamp(most > 0 ? v / most : 0.0f, 0.0f, 1.0f)) + 0.5f));
  write_png(file, out);
}

}  // namespace

int run_luminaire_render(int argc, const char* const* argv) {
  std::string file, output;
  double distance = 1, width = 0, exact_below = 0.1;
  int size = 256, shadow_rays = 256;
  std::string scene;
  Options options("luminaire render",
                  "What a lamp alone throws onto a wall across its nadir: lux as .exr, or a .png.",
                  {"sconce luminaire render lamp.ldt -o wall.png",
                   "sconce luminaire render torch.exr -o wall.exr", "sconce luminaire check {FILE}"});
  options.positional("file", &file,
                     "IES LM-63, EULUMDAT, light field (.exr) or rays (then the rays themselves)");
  options.option("-o,--output", &output, "file to write: .exr (lux) or .png (brightest pixel white)");
  options.option("--distance", &distance, "metres from the lamp to the wall");
  options.option("--width", &width, "metres of wall; 0 = twice the distance");
  options.option("--size", &size, "pixels of the picture's edge");
  options.option(
      "--exact-below", &exact_below,
      "light fields: error that the shift-invariant approximation may have by the geometry that it "
      "freezes; where it is above, the exact reconstruction is used (0 = everywhere)");
  options.option(
      "--scene", &scene,
      "scene that stands between them and throws shadows: the lamp hangs at its origin, nadir -y, C0 +x");
  options.option("--shadow-rays", &shadow_rays, "with --scene, per pixel");
  if (const auto code = options.parse(argc, argv)) return *code;
  const std::string type = lower(std::filesystem::path(output).extension().string());
  if (type != ".exr" && type != ".png")
    throw UsageError("-o", "'" + output + "' names no format", ".exr, .png");
  if (!(distance > 0)) throw UsageError("--distance", "is not positive", "metres > 0");
  if (!(width >= 0)) throw UsageError("--width", "is negative", "metres >= 0");
  if (!(exact_below >= 0)) throw UsageError("--exact-below", "is negative", "an error >= 0, e.g. 10%");
  if (size < 1 || size > 8192) throw UsageError("--size", "is out of range", "1 to 8192");
  if (shadow_rays < 1 || shadow_rays > 65536)
    throw UsageError("--shadow-rays", "is out of range", "1 to 65536");
  const ThreadLimit threads(options.threads);
  const Progress progress = make_progress(options);
  std::optional<Between> between;
  if (!scene.empty()) between.emplace(scene, progress);
  const auto shaded = [&](const Wall& seen, Luminaire lamp) {
    between->hang(std::move(lamp), exact_below);
    return paint(seen, progress, [&](const Vec3& x) {
      return between->lux(x, shadow_rays, mix32(std::bit_cast<uint32_t>(x.x), std::bit_cast<uint32_t>(x.y)));
    });
  };
  const Wall wall{distance, width > 0 ? width : 2 * distance, size};

  Image image;
  std::optional<Predicted> predicted;
  bool luminous = true;
  if (lower(std::filesystem::path(file).extension().string()) == ".exr") {
    const LightField field = read_light_field(file);
    const NearLamp lamp(field);
    std::vector<NearLamp> colors;
    for (int c = 0; c < 3 && !field.is_grey(); ++c) colors.emplace_back(channel_of(field, c));
    const Vec3 up(0, 0, 1);
    if (between)
      image = shaded(wall, {file, far_field(lamp, 5), std::make_shared<LightField>(field)});
    else
      image = paint(wall, progress, [&](const Vec3& x) {
        if (colors.empty()) return Rgb(static_cast<float>(lamp.illuminance(x, up, exact_below)));
        const auto lux = [&](std::size_t c) {
          return static_cast<float>(colors[c].illuminance(x, up, exact_below));
        };
        return Rgb(lux(0), lux(1), lux(2));
      });
    predicted = predict(wall, lamp);
  } else {
    try {
      image = land(wall, file, between ? &*between : nullptr, progress, luminous);
    } catch (const NotMyFormat&) {
      Photometry table = read_luminaire(file, 5, progress).photometry;
      image = between ? shaded(wall, {file, std::move(table)}) : paint_table(wall, table, progress);
    }
  }
  double sum = 0, most = 0;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const auto lux = static_cast<double>(luminance(image.rgb_at(x, y)));
      sum += lux, most = std::max(most, lux);
    }
  const double mean = sum / (static_cast<double>(size) * size), lumens = mean * wall.width * wall.width;
  image.text["sconce:unit"] = luminous ? "lux" : "W/m2";
  if (type == ".exr")
    write_exr(output, image, PixelType::full);
  else
    write_picture(output, image);
  if (options.json) {
    nlohmann::json out{{"file", output}, {"lux_most", most}, {"lux_mean", mean}, {"lumens", lumens}};
    if (predicted) out["predicted_error"] = {{"filters", predicted->filters}, {"noise", predicted->noise}};
    fmt::print("{}\n", out.dump(2));
  } else if (!options.quiet) {
    fmt::print("{}: {:.4g} {} at most, {:.4g} in the mean, {:.5g} {} on {:g} x {:g} m\n", output, most,
               luminous ? "lux" : "W/m2", mean, lumens, luminous ? "lm" : "W", wall.width, wall.width);
    if (predicted)
      fmt::print("predicted error: {:.2g} % by the filters, noise {:.2g} %\n", 100 * predicted->filters,
                 100 * predicted->noise);
  }
  options.next({file});
  return kDone;
}

}  // namespace sconce::app
