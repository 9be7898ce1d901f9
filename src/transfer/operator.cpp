// SPDX-License-Identifier: Apache-2.0
#include "transfer/operator.h"

#include "core/parallel.h"

namespace sconce {

namespace {

int16_t to_short(float v) {
  return static_cast<int16_t>(std::lround(32767 * std::clamp(v, -1.0f, 1.0f)));
}
float fold(float a, float b) {
  return (1 - std::abs(b)) * (a < 0 ? -1.0f : 1.0f);
}

}  // namespace

// Octahedral: the sphere onto an octahedron, its lower half folded out.
std::array<int16_t, 2> pack_normal(const Vec3& n) {
  const float sum = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
  const Vec2 p(n.x / sum, n.y / sum);
  return n.z >= 0 ? std::array{to_short(p.x), to_short(p.y)}
                  : std::array{to_short(fold(p.x, p.y)), to_short(fold(p.y, p.x))};
}

Vec3 unpack_normal(const std::array<int16_t, 2>& packed) {
  const float x = static_cast<float>(packed[0]) / 32767, y = static_cast<float>(packed[1]) / 32767;
  const float z = 1 - std::abs(x) - std::abs(y);
  return glm::normalize(z >= 0 ? Vec3(x, y, z) : Vec3(fold(x, y), fold(y, x), z));
}

std::array<uint16_t, 4> pack_albedo(const Rgb& albedo) {
  const auto pack = [](float v) {
    return static_cast<uint16_t>(std::lround(65535 * std::clamp(v, 0.0f, 1.0f)));
  };
  return {pack(albedo.r), pack(albedo.g), pack(albedo.b), 0};
}

Rgb unpack_albedo(const std::array<uint16_t, 4>& packed) {
  return Rgb(static_cast<float>(packed[0]), static_cast<float>(packed[1]), static_cast<float>(packed[2])) /
         65535.0f;
}

namespace {

/// light = rho K light, on the coarse square. @param illuminance  scratch
void sweep(const WaveletRows& bounce, std::span<const Rgbx> albedo, std::vector<Rgbx>& light,
           std::vector<Rgb>& illuminance) {
  haar_forward(light);
  multiply(bounce, light, illuminance);
  for (std::size_t i = 0; i < light.size(); ++i) {
    const Rgb& e = illuminance[i];
    light[i] = {albedo[i][0] * e.r, albedo[i][1] * e.g, albedo[i][2] * e.b, 0};
  }
}

}  // namespace

uint32_t enough_sweeps(const WaveletRows& bounce, std::span<const Rgbx> albedo, double tolerance) {
  constexpr uint32_t kMost = 1000;
  std::vector<Rgbx> light(bounce.columns, Rgbx{1, 1, 1, 0});
  std::vector<Rgb> scratch(bounce.columns);
  std::array<double, 3> before{};
  for (uint32_t sweeps = 0; sweeps < kMost; ++sweeps) {
    double still = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      double left = 0;
      for (const Rgbx& l : light) left += std::abs(static_cast<double>(l[c]));
      left /= static_cast<double>(light.size());
      // All that is still to come, were it to fall off from now on as in the last sweep.
      const double ratio = before[c] > 0 ? left / before[c] : 1;
      still = std::max(still, ratio < 1 ? left / (1 - ratio) : left > 0 ? 1.0 : 0.0);
      before[c] = left;
    }
    if (still <= tolerance) return sweeps;
    sweep(bounce, albedo, light, scratch);
  }
  return kMost;
}

void bounce_light(const Operator& op, std::span<Rgbx> exitance) {
  haar_forward(exitance);
  if (op.sweeps == 0) return;
  // The first coefficients are the transform of the coarser square of block means, times its blocks' side.
  const std::size_t n = op.bounce.columns;
  const float side = std::sqrt(static_cast<float>(exitance.size() / n));
  std::vector<Rgbx> light(exitance.begin(), exitance.begin() + static_cast<std::ptrdiff_t>(n));
  for (Rgbx& l : light)
    for (float& v : l) v /= side;
  haar_inverse(light);
  std::vector<Rgbx> sum(n, Rgbx{});
  std::vector<Rgb> scratch(n);
  for (uint32_t i = 0; i < op.sweeps; ++i) {
    sweep(op.bounce, op.albedo, light, scratch);
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t c = 0; c < 3; ++c) sum[k][c] += light[k][c];
  }
  haar_forward(sum);
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t c = 0; c < 3; ++c) exitance[k][c] += side * sum[k][c];
}

std::vector<Rgb> indirect_light(const Operator& op, std::vector<Rgbx>& exitance) {
  bounce_light(op, exitance);
  std::vector<Rgb> out(op.gather.rows);
  multiply(op.gather, exitance, out);
  return out;
}

}  // namespace sconce
