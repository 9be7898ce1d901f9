// SPDX-License-Identifier: Apache-2.0
// Bases of the sampling plane of near-field lamps. x in filter spacings; in 2D the product of both axes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace sconce {

/// bell: the paper's quadratic basis (Granier, Goesele, Heidrich, Seidel 2003, eq. 6), measured through an
/// optical or numerical filter, its C1 dual. spline: the uniform quadratic B-spline, for simulated lamps: of
/// order 3 where the bell is of order 1, but its dual has no end.
enum class NearBasis : uint8_t { bell, spline };

/// "bell", "spline": as files and options name them.
const char* name_of(NearBasis basis);
std::optional<NearBasis> basis_named(std::string_view name);

/// 1 - 2x2, then 2(|x| - 1)2, zero from |x| = 1 on.
double bell(double x);
/// Duals of the bell of four spacings' width, integral(dual x bell(. - k)) = delta_k (methods.md 2.6): the
/// smooth one, and the one of least norm, which jumps at |x| = 2.
double bell_dual(double x);
double bell_dual_least(double x);
/// 3/4 - x2, then (3/2 - |x|)2 / 2, zero from |x| = 3/2 on.
double spline(double x);

double basis_at(NearBasis basis, double x);
/// Where the basis ends, spacings from its centre.
double basis_reach(NearBasis basis);
/// Where a share u of the basis lies below: positions in proportion to it from uniform numbers.
double basis_quantile(NearBasis basis, double u);

/// Turns moments with splines into coefficients of splines, in place: the inverse of the Gram matrix (66, 26,
/// 1)/120, with the ends joined, so that sums are kept exactly. @param stride  distance between neighbours
void spline_dual(double* values, std::size_t count, std::size_t stride);

/// (max - min) / centre of cos4 over a stretch of width s (in units of the distance) about tan(theta0) along
/// the direction of the tilt: the paper's Er; 2 s sin(2 theta0) + O(s3).
double geometric_spread(double tan_theta, double s);

}  // namespace sconce
