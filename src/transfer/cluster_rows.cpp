// SPDX-License-Identifier: Apache-2.0
#include "transfer/cluster_rows.h"

#include <Eigen/Dense>

#include "core/ranks.h"
#include "core/sobol.h"

namespace sconce {

namespace {

constexpr std::size_t kRank = ClusterRows::kRank, kLanes = ClusterRows::kLanes;
constexpr float kMostWeight = 32767;

using Matrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

std::size_t filled_up(std::size_t rows) {
  return (rows + kLanes - 1) / kLanes * kLanes;
}

/// The answers of rows to all training lights: rows x lights.
Matrix answers(std::span<const std::vector<SparseEntry>> rows, const TrainingLight& light) {
  Matrix out = Matrix::Zero(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(light.count()));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    float* sums = out.data() + i * light.count();
    for (const SparseEntry& e : rows[i]) {
      const float* values = light.at_column(e.index).data();
      for (std::size_t t = 0; t < light.count(); ++t) sums[t] += e.value * values[t];
    }
  }
  return out;
}

/// Orthonormal columns that hold nearly as much of the answers as sixteen can: a randomised range finder
/// with subspace iterations (Halko, Martinsson and Tropp 2011), then its principal components.
Matrix principal(const Matrix& answers) {
  constexpr Eigen::Index kMore = 8;  // than are kept
  constexpr int kIterations = 3;
  const auto rank = static_cast<Eigen::Index>(kRank);
  const Eigen::Index n = std::min({answers.rows(), answers.cols(), rank + kMore});
  Eigen::MatrixXf range(answers.cols(), n);
  for (Eigen::Index j = 0; j < n; ++j)
    for (Eigen::Index t = 0; t < answers.cols(); ++t)
      range(t, j) =
          sobol_pair(static_cast<uint32_t>(t), 0, mix32(0x72616e67u, static_cast<uint32_t>(j))).x - 0.5f;
  Eigen::MatrixXf basis;
  for (int i = 0; i < kIterations; ++i) {
    const Eigen::MatrixXf image = answers * range;
    basis = Eigen::HouseholderQR<Eigen::MatrixXf>(image).householderQ() *
            Eigen::MatrixXf::Identity(answers.rows(), n);
    range = answers.transpose() * basis;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXf> solver(range.transpose() * range);
  Matrix out = Matrix::Zero(answers.rows(), rank);
  const float largest = solver.eigenvalues()(n - 1);
  for (Eigen::Index j = 0; j < std::min(n, rank); ++j) {
    if (!(solver.eigenvalues()(n - 1 - j) > 1e-6f * largest)) break;
    out.col(j) = basis * solver.eigenvectors().col(n - 1 - j);
  }
  return out;
}

/// The same, of which the first column holds all of the sums.
Matrix principal_with_sums(Matrix answers, Eigen::VectorXf sums) {
  if (!(sums.norm() > 0)) return principal(answers);
  sums.normalize();
  answers -= sums * (sums.transpose() * answers).eval();
  const Matrix rest = principal(answers);
  Matrix out(rest.rows(), rest.cols());
  out << sums, rest.leftCols(rest.cols() - 1);
  return out;
}

Eigen::VectorXf sums_of(std::span<const std::vector<SparseEntry>> rows) {
  Eigen::VectorXf sums = Eigen::VectorXf::Zero(static_cast<Eigen::Index>(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (const SparseEntry& e : rows[i]) sums(static_cast<Eigen::Index>(i)) += e.value;
  return sums;
}

/// What rows' answers are divided by before least squares look at them.
Eigen::VectorXf row_scales(const Matrix& answers, float evenness) {
  constexpr float kDarkest = 1e-3f;  // of the brightest row
  const Eigen::VectorXf norms = answers.rowwise().norm();
  const float least = kDarkest * norms.maxCoeff();
  if (!(least > 0)) return Eigen::VectorXf::Ones(answers.rows());
  return norms.cwiseMax(least).array().pow(evenness);
}

}  // namespace

ClusterRowsBuilder::ClusterRowsBuilder(uint32_t rows, const TrainingLight& light, const Params& params)
    : rows_(rows),
      light_(light),
      params_(params),
      basis_((rows + params.cluster - 1) / params.cluster * static_cast<uint32_t>(kRank), light.columns(),
             params.coefficients, light.squares()),
      weights_(kRank * filled_up(rows)),
      scales_(filled_up(rows)) {}

void ClusterRowsBuilder::set_cluster(std::size_t cluster, std::span<const std::vector<SparseEntry>> rows) {
  const Matrix seen = answers(rows, light_);
  const Eigen::VectorXf scales = row_scales(seen, params_.evenness), shares = scales.cwiseInverse();
  const Matrix even = shares.asDiagonal() * seen;
  const Matrix range =
      params_.keep_sums ? principal_with_sums(even, shares.cwiseProduct(sums_of(rows))) : principal(even);
  // Rows are weights x basis, and the basis is from_rows' transpose x rows.
  const Matrix weights = scales.asDiagonal() * range, from_rows = shares.asDiagonal() * range;
  const std::size_t first = cluster * params_.cluster;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto row = weights.row(static_cast<Eigen::Index>(i));
    const float scale = row.cwiseAbs().maxCoeff() / kMostWeight;
    scales_[first + i] = scale;
    const std::size_t at = (first + i) / kLanes * kRank * kLanes + (first + i) % kLanes;
    for (std::size_t j = 0; j < kRank && scale > 0; ++j)
      weights_[at + j * kLanes] =
          static_cast<int16_t>(std::lround(row(static_cast<Eigen::Index>(j)) / scale));
  }

  // The basis, as sixteen squares at once.
  std::vector<Sixteen> basis(light_.columns(), Sixteen{});
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const float* w = from_rows.data() + i * kRank;
    for (const SparseEntry& e : rows[i])
      for (std::size_t j = 0; j < kRank; ++j) basis[e.index][j] += e.value * w[j];
  }
  haar_forward(basis);
  CoefficientChooser chooser(light_.squares());
  const std::size_t coarse = std::min(light_.coarse(), params_.coefficients);
  for (uint32_t k = 1; k < basis.size(); ++k) {
    float square = 0;
    for (const float v : basis[k]) square += v * v;
    if (k < coarse)
      chooser.add(k, 1e30f);
    else if (square > 0)
      chooser.add(k, square);
  }
  const std::span<const uint32_t> chosen = chooser.choose(params_.coefficients - 1);

  // What the coefficients that are left out would have answered goes to the coarse ones, as far as these
  // tell.
  Matrix left = from_rows.transpose() * seen;
  const auto take = [&](uint32_t k) {
    const float* values = light_.at_coefficient(k).data();
    for (std::size_t j = 0; j < kRank; ++j) {
      float* sums = left.data() + j * light_.count();
      for (std::size_t t = 0; t < light_.count(); ++t) sums[t] -= basis[k][j] * values[t];
    }
  };
  take(0);
  for (const uint32_t k : chosen) take(k);
  if (coarse == light_.coarse()) {
    const Eigen::Map<const Matrix> fit(light_.fit().data(), static_cast<Eigen::Index>(coarse),
                                       static_cast<Eigen::Index>(light_.count()));
    const Matrix more = fit * left.transpose();
    for (std::size_t k = params_.keep_sums ? 1 : 0; k < coarse; ++k)
      for (std::size_t j = 0; j < kRank; ++j)
        basis[k][j] += more(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(j));
  }
  basis_.set_block(cluster, chosen, basis);
}

void ClusterRowsBuilder::pack(std::size_t cluster, std::string& bytes) const {
  basis_.pack(cluster, bytes);
  put_span(bytes, part(weights_, cluster, kRank));
  put_span(bytes, part(scales_, cluster, 1));
}

void ClusterRowsBuilder::unpack(std::size_t cluster, std::string_view& bytes) {
  basis_.unpack(cluster, bytes);
  take_span(bytes, part(weights_, cluster, kRank));
  take_span(bytes, part(scales_, cluster, 1));
}

ClusterRowsBuilder::Result ClusterRowsBuilder::finish() {
  struct Owned {
    std::vector<int16_t> weights;
    std::vector<float> scales;
    std::shared_ptr<const void> basis;
  };
  auto owned = std::make_shared<Owned>();
  auto basis = basis_.finish();
  owned->weights = std::move(weights_), owned->scales = std::move(scales_), owned->basis = basis.owner;
  Result result;
  result.rows = {rows_, params_.cluster, basis.rows, owned->weights, owned->scales};
  result.owner = std::move(owned);
  return result;
}

}  // namespace sconce
