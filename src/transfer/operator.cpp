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

void reflect(std::span<const Rgb> illuminance, std::span<const Rgbx> albedo, std::span<Rgbx> light) {
  for (std::size_t i = 0; i < light.size(); ++i) {
    const Rgb& e = illuminance[i];
    light[i] = {albedo[i][0] * e.r, albedo[i][1] * e.g, albedo[i][2] * e.b, 0};
  }
}

}  // namespace

void weigh(const Operator& op, std::span<Rgbx> exitance) {
  if (op.albedo.size() != exitance.size()) return;
  for (std::size_t i = 0; i < exitance.size(); ++i) {
    const float weight = op.albedo[i][3];
    if (!(weight > 0)) continue;
    for (std::size_t c = 0; c < 3; ++c) exitance[i][c] *= weight;
  }
}

uint32_t enough_sweeps(const ClusterRows& bounce, std::span<const Rgbx> albedo, double tolerance) {
  constexpr uint32_t kMost = 1000;
  std::vector<Rgbx> light;
  double even = 0;
  for (const Rgbx& a : albedo) {
    const float weight = a[3] > 0 ? a[3] : 1.0f;
    light.push_back({weight, weight, weight, 0});
    even += static_cast<double>(weight);
  }
  std::vector<Rgb> scratch(bounce.rows);
  std::array<double, 3> before{};
  for (uint32_t sweeps = 0; sweeps < kMost; ++sweeps) {
    double still = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      double left = 0;
      for (const Rgbx& l : light) left += std::abs(static_cast<double>(l[c]));
      left /= even;
      // All that is still to come, were it to fall off from now on as in the last sweep.
      const double ratio = before[c] > 0 ? left / before[c] : 1;
      still = std::max(still, ratio < 1 ? left / (1 - ratio) : left > 0 ? 1.0 : 0.0);
      before[c] = left;
    }
    if (still <= tolerance) return sweeps;
    haar_forward(light);
    multiply(bounce, light, scratch);
    reflect(scratch, albedo, light);
  }
  return kMost;
}

std::vector<Rgbx> slot_exitance(const Operator& op, const std::function<Rgb(std::size_t)>& direct) {
  std::vector<Rgbx> exitance(op.slots());
  const std::size_t points = op.points_per_slot;
  parallel_for(exitance.size(), 256, [&](std::size_t slot) {
    Rgb sum;
    for (std::size_t i = points * slot; i < points * (slot + 1); ++i)
      sum += unpack_albedo(op.lit[i].albedo) * direct(i);
    sum *= 1 / static_cast<float>(points);
    exitance[slot] = {sum.r, sum.g, sum.b, 0};
  });
  return exitance;
}

std::vector<Rgbx> reflected_once(const Operator& op, std::span<const Rgbx> coefficients) {
  std::vector<Rgb> illuminance(op.first.rows);
  multiply(op.first, coefficients, illuminance);
  std::vector<Rgbx> out(op.first.rows);
  reflect(illuminance, op.albedo, out);
  return out;
}

std::vector<Rgbx> first_bounce(const Operator& op, std::span<const Rgbx> exitance) {
  std::vector<Rgbx> light(exitance.begin(), exitance.end());
  weigh(op, light);
  haar_forward(light);
  return reflected_once(op, light);
}

void add_reflected(std::span<Rgbx> coefficients, std::vector<Rgbx>& nodes) {
  // The transform of a square whose blocks are all even is that of the blocks, times their side.
  haar_forward(nodes);
  const float side = std::sqrt(static_cast<float>(coefficients.size() / nodes.size()));
  for (std::size_t k = 0; k < nodes.size(); ++k)
    for (std::size_t c = 0; c < 3; ++c) coefficients[k][c] += side * nodes[k][c];
}

void bounce_light(const Operator& op, std::span<Rgbx> exitance) {
  weigh(op, exitance);
  haar_forward(exitance);
  if (op.sweeps == 0) return;
  const std::size_t n = op.bounce.rows;
  std::vector<Rgbx> light = reflected_once(op, exitance), sum = light;
  std::vector<Rgb> scratch(n);
  for (uint32_t i = 1; i < op.sweeps; ++i) {
    haar_forward(light);
    multiply(op.bounce, light, scratch);
    reflect(scratch, op.albedo, light);
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t c = 0; c < 3; ++c) sum[k][c] += light[k][c];
  }
  add_reflected(exitance, sum);
}

std::vector<Rgb> indirect_light(const Operator& op, std::vector<Rgbx>& exitance) {
  bounce_light(op, exitance);
  std::vector<Rgb> out(op.gather.rows);
  multiply(op.gather, exitance, out);
  return out;
}

}  // namespace sconce
