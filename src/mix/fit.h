// SPDX-License-Identifier: Apache-2.0
// Goal seeking: which gains of the groups come nearest to what is wished for. The mix is linear in them, so
// this is non-negative least squares (Schoeneman et al. 1993, "Painting with light"; Lawson and Hanson 1974,
// algorithm 23.10).
#pragma once

#include <memory>
#include <span>
#include <vector>

namespace sconce {

/// A sum of wishes, each `sum_g row[g] * gain_g = target`; kept as normal equations, so that a picture's
/// pixels cost no memory.
class Wishes {
 public:
  explicit Wishes(std::size_t groups);
  Wishes(Wishes&&) noexcept;
  ~Wishes();

  /// @param weight  of the squared difference
  void add(std::span<const double> row, double target, double weight = 1);
  std::size_t groups() const;

 private:
  friend struct Fit fit(const Wishes&, std::span<const double>, double);
  struct Equations;
  std::unique_ptr<Equations> equations_;
};

struct Fit {
  std::vector<double> gains;  ///< per group, >= 0
  double residual = 0;        ///< sqrt(sum weight (row . gain - target)^2 / sum weight target^2); 0 = all met
};

/// Minimises sum weight (row . gain - target)^2 + thrift * sum weight target^2 * (power . gain) / sum power:
/// with a small `thrift`, of all gains that meet the wishes equally well those of the least power.
/// @param power  of each group at gain 1, e.g. lumens; empty = all alike
Fit fit(const Wishes& wishes, std::span<const double> power = {}, double thrift = 0);

}  // namespace sconce
