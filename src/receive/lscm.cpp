// SPDX-License-Identifier: Apache-2.0
// Least squares conformal maps: B. Levy, S. Petitjean, N. Ray, J. Maillot, "Least Squares Conformal Maps for
// Automatic Texture Atlas Generation", SIGGRAPH 2002. Normal equations, two pinned vertices, sparse Cholesky.
#include <Eigen/SparseCholesky>
#include <cmath>
#include <complex>

#include "receive/parameterize.h"

namespace sconce {

namespace {

using Complex = std::complex<double>;
using Vec3d = glm::dvec3;

std::size_t farthest(const std::vector<Vec3>& points, std::size_t from) {
  std::size_t best = from;
  float most = -1;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 d = points[i] - points[from];
    if (glm::dot(d, d) > most) best = i, most = glm::dot(d, d);
  }
  return best;
}

}  // namespace

std::vector<Vec2> conformal_map(const PatchMesh& mesh) {
  const std::size_t n = mesh.positions.size();
  if (n < 3) return {};
  const std::size_t pin0 = farthest(mesh.positions, 0), pin1 = farthest(mesh.positions, pin0);
  if (pin0 == pin1) return {};
  const double apart = static_cast<double>(glm::distance(mesh.positions[pin0], mesh.positions[pin1]));

  // Free vertices first, in order; the pinned ones carry known values to the right-hand side.
  std::vector<int> column(n, -1);
  int unknowns = 0;
  for (std::size_t v = 0; v < n; ++v)
    if (v != pin0 && v != pin1) column[v] = unknowns++;
  const auto pinned = [&](std::size_t v) { return v == pin1 ? Complex(apart, 0) : Complex(0, 0); };

  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(mesh.corners.size() * 24);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(2 * unknowns);
  for (const auto& corners : mesh.corners) {
    const Vec3d p0(mesh.positions[corners[0]]), p1(mesh.positions[corners[1]]),
        p2(mesh.positions[corners[2]]);
    const Vec3d e1 = p1 - p0, e2 = p2 - p0;
    const double length = glm::length(e1), twice_area = glm::length(glm::cross(e1, e2));
    if (!(length > 0) || !(twice_area > 0)) return {};
    const Complex z1(length, 0), z2(glm::dot(e1, e2) / length, twice_area / length);
    const std::array<Complex, 3> w{z2 - z1, -z2, z1};
    for (std::size_t j = 0; j < 3; ++j) {
      const int row = column[corners[j]];
      if (row < 0) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        const Complex h = std::conj(w[j]) * w[k] / twice_area;
        const int col = column[corners[k]];
        if (col < 0) {
          const Complex r = h * pinned(corners[k]);
          right[2 * row] -= r.real();
          right[2 * row + 1] -= r.imag();
          continue;
        }
        if (col > row) continue;  // the solver reads the lower triangle
        entries.emplace_back(2 * row, 2 * col, h.real());
        entries.emplace_back(2 * row + 1, 2 * col, h.imag());
        entries.emplace_back(2 * row + 1, 2 * col + 1, h.real());
        if (col < row) entries.emplace_back(2 * row, 2 * col + 1, -h.imag());
      }
    }
  }
  Eigen::SparseMatrix<double> matrix(2 * unknowns, 2 * unknowns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(matrix);
  if (solver.info() != Eigen::Success) return {};
  const Eigen::VectorXd solution = solver.solve(right);
  if (solver.info() != Eigen::Success || !solution.allFinite()) return {};

  std::vector<Vec2> result(n);
  for (std::size_t v = 0; v < n; ++v) {
    const Complex z =
        column[v] < 0 ? pinned(v) : Complex(solution[2 * column[v]], solution[2 * column[v] + 1]);
    result[v] = Vec2(static_cast<float>(z.real()), static_cast<float>(z.imag()));
  }
  return result;
}

}  // namespace sconce
