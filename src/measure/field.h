// SPDX-License-Identifier: Apache-2.0
// Rays of a lamp to its light field: where its planes lie and how large they are.
#pragma once

#include <functional>
#include <string>

#include "photometry/light_field.h"

namespace sconce {

/// Calls what it is given with blocks of rays, every time all of them in the same order.
using RaySource = std::function<void(const std::function<void(std::span<const SourceRay>)>&)>;

struct FieldParams {
  NearBasis basis = NearBasis::spline;
  double spacing = 0.005;  ///< of filters, m
  double distance = 0;     ///< between the planes, m; 0 = 25 spacings
  double angle = 60;       ///< rays further from nadir are left out, degrees
  int pixels = 128;        ///< of an image's edge
  double lumens = 0;       ///< flux of all rays to scale to; 0 = as it is
};

struct MeasuredField {
  LightField field;
  double kept = 0, lost = 0;  ///< flux in the images; beyond the angle or upward, lm
  double plane = 0;           ///< z of the sampling plane in the rays' frame: the lowest start of a ray, m
  double scale = 1;           ///< what `lumens` multiplied by
};

/// @throws UsageError: more than 2 GB; Error naming `where`: no ray within the angle
MeasuredField measure_field(const RaySource& rays, const FieldParams& params, const std::string& where);

}  // namespace sconce
