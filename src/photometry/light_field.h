// SPDX-License-Identifier: Apache-2.0
// A lamp measured from near: its light field between a sampling plane and a measurement plane (Granier,
// Goesele, Heidrich, Seidel 2003; the corrected equations are in methods.md 2.6). Data and evaluation, no
// rays.
//
// Luminaire's frame: the sampling plane S is z = 0, light leaves towards -z, the measurement plane M is z =
// -distance.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/vec.h"
#include "photometry/near_basis.h"
#include "photometry/rays.h"

namespace sconce {

/// One image of M per filter position (m, n) on S: E_mn(s, t) = integral over S of (cos2 theta / R2) dual_mn
/// L, lux. Values may be negative, as the dual has negative lobes.
struct LightField {
  NearBasis basis = NearBasis::bell;
  int columns = 0, rows = 0;      ///< filter positions along x and y
  double spacing = 0;             ///< h, m
  glm::dvec2 first{0};            ///< centre of filter (0, 0) on S, m
  double distance = 0;            ///< d, m
  int width = 0, height = 0;      ///< of the images, pixels
  glm::dvec2 corner{0};           ///< of pixel (0, 0) on M, m: the least x and y
  double pixel = 0;               ///< edge of a pixel, m
  double grain = 0;               ///< flux of one of the rays that it was made of, lm; 0 = not of rays
  std::vector<float> irradiance;  ///< [n][m][t][s], lux
  std::vector<float> color;  ///< the same thrice, [red, green, blue], whose luminance that is; empty: grey

  std::size_t terms() const { return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows); }
  std::size_t pixels() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
  glm::dvec2 center(int m, int n) const { return first + spacing * glm::dvec2(m, n); }
  bool is_grey() const { return color.empty(); }
  std::span<const float> image(std::size_t term) const {
    return std::span(irradiance).subspan(term * pixels(), pixels());
  }
};

/// Grids for a lamp whose openings lie within a rectangle: margins are left for what filters reach beyond it.
/// @param half_extent  of M from its centre, m
LightField make_light_field(NearBasis basis, const Vec2& low, const Vec2& high, double spacing,
                            double distance, double half_extent, int pixels);

/// Gathers rays into a light field: L_mnkl = sum of flux x dual_mn(u, v) / pixel area, no geometric factor.
/// Each ray meets M in one pixel and its filters sum to 1, so that the flux of the images is that of the
/// rays, of each channel.
class LightFieldBuilder {
 public:
  /// @param colored  rays have colours, and so has the light field
  explicit LightFieldBuilder(LightField empty, bool colored = false);

  void add(std::span<const SourceRay> rays);
  /// Flux that went into the images, and what missed them: upward, outside of M, or outside of the filters'
  /// grid. lm
  double kept() const { return kept_; }
  double lost() const { return lost_; }
  LightField finish() &&;

 private:
  LightField field_;
  std::size_t channels_;
  std::vector<double> sums_;  ///< [channel] of LightField::irradiance
  double kept_ = 0, lost_ = 0, squares_ = 0;
};

/// Size of the part of S that the filters fully cover: light from there keeps its flux, m.
glm::dvec2 opening(const LightField& field);

/// What filters of twice the spacing would have measured of the light that eq. 5 makes of these: flux is
/// kept, detail on S is not. Grey.
LightField widened(const LightField& field);

/// Flux through the images: sum over terms and pixels of E x pixel area, lm.
double flux(const LightField& field);
/// That of a field that is to shine. @throws Error naming `where`: it has none, or less
double light_of(const LightField& field, const std::string& where);

/// Red, green or blue of a coloured light field as a grey one, lux of that channel.
LightField channel_of(const LightField& field, int channel);
/// The irradiance that belongs to the colours. @pre color has three times the values of all images
void set_luminance(LightField& field);

/// The lamp as lit from: box means of the images in constant time.
class NearLamp {
 public:
  /// @param filter  what a filter covers of M seen from far away, m; 0 = the spacing. Terms that coarser()
  /// joined by direction still cover no more than the finest.
  explicit NearLamp(LightField field, double filter = 0);
  const LightField& field() const { return field_; }

  /// L(u, v -> s, t) of eq. 5, cd/m2: exact where the lamp lies in the span of the basis.
  double radiance(const glm::dvec2& uv, const glm::dvec2& st) const;

  /// Integrand of eq. 12: what the point uv of S sends to a surface at x that faces it, lux per m2 of S.
  double from(const glm::dvec2& uv, const Vec3& x) const;

  /// Illuminance of a surface at x with normal n (luminaire's frame), lux, by eq. 5 integrated over S.
  /// @param points  of the quadrature, per spacing and axis
  double exact(const Vec3& x, const Vec3& n, int points = 8) const;
  /// The same by eq. 14: every term a textured spot at its filter's centre.
  double approximate(const Vec3& x, const Vec3& n) const;
  /// All terms of eq. 14 as a surface at x gets them that faces each filter's centre, [n][m], lux; some may
  /// be negative.
  void terms(const Vec3& x, std::span<double> out) const;
  /// One of them on a surface of normal n.
  double term(int m, int n, const Vec3& x, const Vec3& normal) const;
  /// E' of one term at an offset on M from below its filter's centre, m: the term by direction.
  double towards(int m, int n, const glm::dvec2& offset) const {
    return mean(
        static_cast<std::size_t>(n) * static_cast<std::size_t>(field_.columns) + static_cast<std::size_t>(m),
        field_.center(m, n) + offset, 0);
  }
  /// Relative error of approximate() by freezing the geometry over a filter: the terms' spreads, weighted by
  /// their size (ADR 39). None where x lies on M and faces S straight on.
  double bound(const Vec3& x, const Vec3& n) const;
  /// The same by terms() that are at hand, for surfaces that face each of them. @param spacing  of the light
  /// field that is approximated, where this is a coarser one of it
  double bound(const Vec3& x, std::span<const double> terms, double spacing) const;
  /// Standard deviation of approximate() by the rays that the field was made of, of the mean over a square of
  /// this width about x, lux; at most that. 0 where it was not made of rays.
  double noise(const Vec3& x, const Vec3& n, double width = 0) const;
  /// approximate(), or exact() where the bound is above the tolerance.
  double illuminance(const Vec3& x, const Vec3& n, double tolerance) const;

 private:
  /// Mean of E' = E / g_mn over a square of M, lux m2 (that is, cd/m2 x m2).
  double mean(std::size_t term, const glm::dvec2& st, double width) const;
  /// bound() of light(m, n); relative change of the receiver's cosine per reach of a filter,
  /// cosine(tangents).
  template <class Value, class Cosine>
  double spread(const Vec3& x, double spacing, const Value& value, const Cosine& cosine) const;
  /// Edge of the square of M that a filter covers seen from a point so far below S, m.
  double window(double depth) const;
  /// terms() of one filter.
  double facing(int m, int n, const glm::dvec3& x) const;

  LightField field_;
  double filter_;
  std::vector<double> areas_;  ///< summed-area tables of E', one per term
};

/// The far field of a light field, and with it where the field is no longer needed, brought to the flux of
/// its images. Type C, `step` degrees.
Photometry far_field(const NearLamp& lamp, double step);

/// Four neighbouring terms in one by direction, moved to their middle: what is left to see of them from far
/// away. Grey.
LightField coarser(const NearLamp& lamp);

}  // namespace sconce
