// SPDX-License-Identifier: Apache-2.0
#include "transfer/training.h"

#include <Eigen/Dense>
#include <cmath>

#include "core/parallel.h"

namespace sconce {

namespace {

constexpr float kRidge = 0.003f;  // of the largest variance

}  // namespace

TrainingLight::TrainingLight(std::vector<std::vector<float>> lights) : count_(lights.size()) {
  const std::size_t n = lights.at(0).size();
  columns_.resize(n * count_), coefficients_.resize(n * count_), squares_.resize(n);
  coarse_ = std::min(kCoarse, n);
  parallel_for(count_, 1, [&](std::size_t t) {
    std::vector<float>& light = lights[t];
    // Coefficient 0 is the sum, but for a constant.
    const float scale = light[0] != 0 ? 1 / std::abs(light[0]) : 0.0f;
    for (std::size_t k = 0; k < n; ++k) coefficients_[k * count_ + t] = light[k] *= scale;
    haar_inverse(light);
    for (std::size_t k = 0; k < n; ++k) columns_[k * count_ + t] = light[k];
  });
  for (std::size_t first = 1, end = 4; end <= n; first = end, end *= 4) {
    double level = 0;
    for (std::size_t k = first; k < end; ++k) {
      for (const float v : at_coefficient(static_cast<uint32_t>(k))) squares_[k] += v * v;
      level += static_cast<double>(squares_[k]) / static_cast<double>(end - first);
    }
    for (std::size_t k = first; k < end; ++k) squares_[k] = 0.5f * (squares_[k] + static_cast<float>(level));
  }
  using Matrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const auto rows = static_cast<Eigen::Index>(coarse_), lamps = static_cast<Eigen::Index>(count_);
  const Eigen::Map<const Matrix> coarse(coefficients_.data(), rows, lamps);
  Matrix gram = coarse * coarse.transpose();
  gram.diagonal().array() += kRidge * gram.diagonal().maxCoeff();
  fit_.resize(coarse_ * count_);
  Eigen::Map<Matrix>(fit_.data(), rows, lamps) = gram.llt().solve(Matrix(coarse));
}

}  // namespace sconce
