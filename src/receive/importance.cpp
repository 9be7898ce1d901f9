// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "receive/atlas.h"
#include "receive/parameterize.h"

namespace sconce {

namespace {

constexpr double kSteps = 16;  // to a factor of two

}  // namespace

uint8_t importance_code(double importance) {
  const double least = std::exp2(-255 / kSteps);
  return static_cast<uint8_t>(
      std::lround(-kSteps * std::log2(std::clamp(importance / kMostImportance, least, 1.0))));
}

float importance_of(uint8_t code) {
  return kMostImportance * static_cast<float>(std::exp2(-code / kSteps));
}

float TexelReceivers::importance(std::size_t i) const {
  float sum = 0;
  for (uint32_t k = first_[i]; k < first_[i + 1]; ++k)
    sum += importance_of(side_of(*atlas_, sides_[k]).importance);
  return sum / static_cast<float>(first_[i + 1] - first_[i]);
}

float TexelReceivers::spacing(std::size_t i) const {
  const float texels = std::abs(signed_area(side_of(*atlas_, sides_[first_[i]]).uv)),
              area = world_->area(triangle(i));
  const float relative = std::min(1.0f, texels / (area * atlas_->density * atlas_->density));
  return 1 / (atlas_->density * std::sqrt(relative));
}

}  // namespace sconce
