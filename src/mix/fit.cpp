// SPDX-License-Identifier: Apache-2.0
#include "mix/fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.h"

namespace sconce {

struct Wishes::Equations {
  static constexpr Eigen::Index kBlock = 128;  ///< rows are squared together, which is several times as fast
  Eigen::MatrixXd squares;                     ///< A^T A, its lower half, without the columns of `rows`
  Eigen::MatrixXd rows;
  Eigen::Index pending = 0;  ///< of them
  Eigen::VectorXd right;     ///< A^T b
  double targets = 0;        ///< b^T b
};

Wishes::Wishes(std::size_t groups) : equations_(std::make_unique<Equations>()) {
  const auto n = static_cast<Eigen::Index>(groups);
  equations_->squares = Eigen::MatrixXd::Zero(n, n);
  equations_->rows.resize(n, Equations::kBlock);
  equations_->right = Eigen::VectorXd::Zero(n);
}
Wishes::Wishes(Wishes&&) noexcept = default;
Wishes::~Wishes() = default;

std::size_t Wishes::groups() const {
  return static_cast<std::size_t>(equations_->right.size());
}

void Wishes::add(std::span<const double> row, double target, double weight) {
  if (row.size() != groups()) throw Error({}, "a wish is of another number of groups");
  const Eigen::Map<const Eigen::VectorXd> a(row.data(), static_cast<Eigen::Index>(row.size()));
  Equations& e = *equations_;
  e.rows.col(e.pending++) = std::sqrt(weight) * a;
  if (e.pending == Equations::kBlock) {
    e.squares.selfadjointView<Eigen::Lower>().rankUpdate(e.rows);
    e.pending = 0;
  }
  e.right += weight * target * a;
  e.targets += weight * target * target;
}

namespace {

/// Of H x = c with x = 0 outside of `free`; no direction that H leaves open grows.
Eigen::VectorXd solve_free(const Eigen::MatrixXd& h, const Eigen::VectorXd& c,
                           const std::vector<Eigen::Index>& free) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(c.size());
  if (free.empty()) return x;
  const Eigen::VectorXd part = h(free, free).completeOrthogonalDecomposition().solve(c(free));
  for (std::size_t i = 0; i < free.size(); ++i) x(free[i]) = part(static_cast<Eigen::Index>(i));
  return x;
}

/// The active-set method on the normal equations: one gain after the other is let go, and those that would
/// become negative are held at 0 again.
Eigen::VectorXd nonnegative(const Eigen::MatrixXd& h, const Eigen::VectorXd& c) {
  const Eigen::Index n = c.size();
  const double tiny = 1e-12 * std::max(c.cwiseAbs().maxCoeff(), 1e-300);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n);
  std::vector<Eigen::Index> free;
  const auto held = [&](Eigen::Index i) { return std::find(free.begin(), free.end(), i) == free.end(); };
  for (Eigen::Index step = 0; step < 3 * n; ++step) {
    const Eigen::VectorXd gradient = c - h * x;
    Eigen::Index best = -1;
    for (Eigen::Index i = 0; i < n; ++i)
      if (held(i) && gradient(i) > tiny && (best < 0 || gradient(i) > gradient(best))) best = i;
    if (best < 0) break;
    free.push_back(best);
    Eigen::VectorXd next = solve_free(h, c, free);
    while (std::any_of(free.begin(), free.end(), [&](Eigen::Index i) { return next(i) <= 0; })) {
      double along = 1;
      for (const Eigen::Index i : free)
        if (next(i) <= 0) along = std::min(along, x(i) / std::max(x(i) - next(i), 1e-300));
      x += along * (next - x);
      std::erase_if(free, [&](Eigen::Index i) { return next(i) <= 0 && x(i) <= 1e-15; });
      for (Eigen::Index i = 0; i < n; ++i)
        if (held(i)) x(i) = 0;
      next = solve_free(h, c, free);
    }
    x = next;
  }
  return x;
}

}  // namespace

Fit fit(const Wishes& wishes, std::span<const double> power, double thrift) {
  const Wishes::Equations& e = *wishes.equations_;
  Eigen::MatrixXd lower = e.squares;
  lower.selfadjointView<Eigen::Lower>().rankUpdate(e.rows.leftCols(e.pending));
  const Eigen::MatrixXd h = lower.selfadjointView<Eigen::Lower>();
  Eigen::VectorXd price = Eigen::VectorXd::Ones(e.right.size());
  for (std::size_t g = 0; g < power.size(); ++g) price(static_cast<Eigen::Index>(g)) = power[g];
  if (price.sum() > 0) price /= price.sum();
  const Eigen::VectorXd x = nonnegative(h, e.right - 0.5 * thrift * e.targets * price);
  Fit result;
  result.gains.assign(x.begin(), x.end());
  const double left = x.dot(h * x) - 2 * x.dot(e.right) + e.targets;
  result.residual = e.targets > 0 ? std::sqrt(std::max(0.0, left) / e.targets) : 0;
  return result;
}

}  // namespace sconce
