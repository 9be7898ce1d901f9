// SPDX-License-Identifier: Apache-2.0
#include "photometry/near_basis.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace sconce {

const char* name_of(NearBasis basis) {
  return basis == NearBasis::bell ? "bell" : "spline";
}

std::optional<NearBasis> basis_named(std::string_view name) {
  for (const NearBasis basis : {NearBasis::bell, NearBasis::spline})
    if (name == name_of(basis)) return basis;
  return std::nullopt;
}

double bell(double x) {
  x = std::abs(x);
  return x <= 0.5 ? 1 - 2 * x * x : x < 1 ? 2 * (x - 1) * (x - 1) : 0;
}

double bell_dual(double x) {
  x = std::abs(x);
  if (x <= 0.5) return 23.0 / 16 - 787.0 / 208 * x * x;
  if (x <= 1) return 1483.0 / 416 - 885.0 / 104 * x + 983.0 / 208 * x * x;
  if (x <= 1.5) return -889.0 / 416 + 301.0 / 104 * x - 203.0 / 208 * x * x;
  return x < 2 ? 7.0 / 52 - 7.0 / 52 * x + 7.0 / 208 * x * x : 0;
}

double bell_dual_least(double x) {
  x = std::abs(x);
  if (x <= 0.5) return 1009.0 / 736 - 585.0 / 184 * x * x;
  if (x <= 1) return 2179.0 / 736 - 585.0 / 92 * x + 585.0 / 184 * x * x;
  if (x <= 1.5) return 259.0 / 736 - 105.0 / 92 * x + 105.0 / 184 * x * x;
  return x < 2 ? -1631.0 / 736 + 105.0 / 46 * x - 105.0 / 184 * x * x : 0;
}

double spline(double x) {
  x = std::abs(x);
  return x <= 0.5 ? 0.75 - x * x : x < 1.5 ? 0.5 * (1.5 - x) * (1.5 - x) : 0;
}

double basis_at(NearBasis basis, double x) {
  return basis == NearBasis::bell ? bell(x) : spline(x);
}

double basis_reach(NearBasis basis) {
  return basis == NearBasis::bell ? 1 : 1.5;
}

double basis_quantile(NearBasis basis, double u) {
  // Both are even with integral 1: the part above x >= 0 is a polynomial, found by halving.
  const double above = std::min(u, 1 - u);
  const auto rest = [&](double x) {
    const double out = basis_reach(basis) - x;
    if (x > 0.5) return (basis == NearBasis::bell ? 2.0 / 3 : 1.0 / 6) * out * out * out;
    return basis == NearBasis::bell ? 0.5 - x + 2.0 / 3 * x * x * x : 0.5 - 0.75 * x + x * x * x / 3;
  };
  double low = 0, high = basis_reach(basis);
  for (int i = 0; i < 30; ++i) {
    const double mid = 0.5 * (low + high);
    (rest(mid) > above ? low : high) = mid;
  }
  return std::copysign(0.5 * (low + high), u - 0.5);
}

void spline_dual(double* values, std::size_t count, std::size_t stride) {
  // Each pole p of 120 / (z-2 + 26 z-1 + 66 + 26 z + z2) is a filter forwards and one backwards, both from
  // their steady state on the joined ends; 1 - p each way keeps the sum.
  const auto at = [&](std::size_t i) -> double& { return values[i % count * stride]; };
  for (const double p : {-0.43057534709997435, -0.04309628820326465}) {
    std::vector<double> in(count), out(count);
    for (const bool backwards : {false, true}) {
      for (std::size_t i = 0; i < count; ++i) in[i] = at(backwards ? count - 1 - i : i);
      double state = 0, power = 1;
      for (std::size_t i = 0; i < count; ++i, power *= p) state += in[count - 1 - i] * power;
      state *= (1 - p) / (1 - power);  // the filter's value at the last element, all turns before included
      for (std::size_t i = 0; i < count; ++i) out[i] = state = (1 - p) * in[i] + p * state;
      for (std::size_t i = 0; i < count; ++i) at(backwards ? count - 1 - i : i) = out[i];
    }
  }
}

double geometric_spread(double tan_theta, double s) {
  const auto cos4 = [](double t) { return 1 / ((1 + t * t) * (1 + t * t)); };
  const double low = std::abs(tan_theta) - 0.5 * s, high = std::abs(tan_theta) + 0.5 * s;
  return (cos4(std::max(0.0, low)) - cos4(high)) / cos4(tan_theta);
}

}  // namespace sconce
