// SPDX-License-Identifier: Apache-2.0
#include "detect/capture.h"

#include <fmt/format.h>

#include "core/error.h"
#include "core/stopwatch.h"

namespace sconce {

namespace {

constexpr float kWhite = 0.999f;    // what counts as a white background that is still seen
constexpr float kRounding = 1e-4f;  // that far below zero is rounding, not a fault

std::string of_renderer(const std::string& what) {
  return fmt::format("the renderer's drawing of {}", what);
}

Drawing call(const HostRenderer& host, const DrawRequest& request, const std::string& what) {
  try {
    return host.draw(request);
  } catch (const Cancelled&) {
    throw;
  } catch (const std::exception& e) {
    throw Error(of_renderer(what), e.what());
  }
}

}  // namespace

float decode_code(TargetFormat format, uint8_t code) {
  const float v = static_cast<float>(code) / 255;
  return format == TargetFormat::srgb8 ? srgb_to_linear(v) : std::pow(v, 1 / 0.45f);
}

float half_step(TargetFormat format) {
  return format == TargetFormat::linear ? 0 : (1 - decode_code(format, 254)) / 2;
}

namespace {

/// Whether the faces' pixels all are what the target was cleared to, black or white.
bool shows_background(const TextureSpace& space, const Captured& captured, float background) {
  bool any = false;
  for (std::size_t i = 0; i < space.pixels(); ++i) {
    if (space.covered[i] == 0) continue;
    any = true;
    const Rgb& light = captured.light[i];
    if (background > 0 ? std::min({light.r, light.g, light.b}) < kWhite : light.max() > 0) return false;
  }
  return any;
}

}  // namespace

Captured capture_once(const HostRenderer& host, const TextureSpace& space, DrawRequest request,
                      const std::string& what) {
  if (!host.draw) throw Error(of_renderer(what), "there is no renderer");
  request.width = space.width, request.height = space.height;
  request.triangles = space.triangles, request.corners = space.corners;
  const Stopwatch drawing_time;
  const Drawing drawing = call(host, request, what);
  Captured out;
  out.cost = {1, drawing_time.milliseconds(), drawing.read_milliseconds};

  if (drawing.width != space.width || drawing.height != space.height)
    throw Error(of_renderer(what), fmt::format("has {} x {} pixels", drawing.width, drawing.height),
                fmt::format("{} x {}", space.width, space.height));
  const bool floats = host.format == TargetFormat::linear;
  const std::size_t size = floats ? drawing.values.size() : drawing.codes.size();
  if (size != 3 * space.pixels())
    throw Error(of_renderer(what), fmt::format("has {} {}", size, floats ? "floats" : "8-bit codes"),
                fmt::format("{}, RGB", 3 * space.pixels()));

  out.light.resize(space.pixels());
  if (floats) {
    for (std::size_t i = 0; i < space.pixels(); ++i) {
      const float* v = &drawing.values[3 * i];
      for (int c = 0; c < 3; ++c)
        if (!std::isfinite(v[c]) || v[c] < -kRounding)
          throw Error(of_renderer(what),
                      fmt::format("has the value {} at pixel ({}, {})", v[c],
                                  i % static_cast<std::size_t>(space.width),
                                  i / static_cast<std::size_t>(space.width)),
                      "light, 0 or more");
      out.light[i] = Rgb(std::max(0.0f, v[0]), std::max(0.0f, v[1]), std::max(0.0f, v[2]));
    }
  } else {
    std::array<float, 256> decoded{};
    for (std::size_t code = 0; code < 256; ++code)
      decoded[code] = decode_code(host.format, static_cast<uint8_t>(code));
    out.clipped.resize(space.pixels());
    for (std::size_t i = 0; i < space.pixels(); ++i) {
      const uint8_t* v = &drawing.codes[3 * i];
      out.light[i] = Rgb(decoded[v[0]], decoded[v[1]], decoded[v[2]]);
      out.clipped[i] = std::max({v[0], v[1], v[2]}) == 255 ? 1 : 0;
    }
  }
  return out;
}

void Captured::append(const Captured& other) {
  light.insert(light.end(), other.light.begin(), other.light.end());
  clipped.insert(clipped.end(), other.clipped.begin(), other.clipped.end());
  cost += other.cost;
}

Captured capture(const HostRenderer& host, const TextureSpace& space, const DrawRequest& request,
                 const std::string& what) {
  Captured captured = capture_once(host, space, request, what);
  if (request.lights != DrawRequest::Lights::all || !shows_background(space, captured, 0)) return captured;
  // It is dark there, or nothing was drawn.
  DrawRequest again = request;
  again.background = 1;
  const Captured on_white = capture_once(host, space, again, what);
  if (shows_background(space, on_white, 1))
    throw Error(of_renderer(what), "shows none of the faces: white stays white");
  captured.cost += on_white.cost;
  return captured;
}

Rgb face_mean(const TextureSpace& space, std::size_t face, const Captured& captured, bool& clipped) {
  std::array<double, 3> sum{};
  double count = 0;
  each_pixel(space, face, [&](std::size_t pixel) {
    const Rgb& light = captured.light[pixel];
    sum[0] += static_cast<double>(light.r), sum[1] += static_cast<double>(light.g);
    sum[2] += static_cast<double>(light.b);
    clipped = clipped || captured.is_clipped(pixel);
    ++count;
  });
  const double scale = 1 / std::max(count, 1.0);
  return Rgb(static_cast<float>(sum[0] * scale), static_cast<float>(sum[1] * scale),
             static_cast<float>(sum[2] * scale));
}

}  // namespace sconce
