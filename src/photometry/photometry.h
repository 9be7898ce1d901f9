// SPDX-License-Identifier: Apache-2.0
// A lamp measured from far away: luminous intensity over directions. Data and evaluation, no rays.
//
// The luminaire's frame: nadir (what the lamp is aimed with) is -z, plane C0 lies towards +x, C90 towards +y,
// so C runs counter-clockwise seen from +z. docs/luminaires.md has the picture.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/vec.h"

namespace sconce {

/// What shines, for the lamp seen from near: centred in the luminaire's frame, metres. All zero: a point.
struct Opening {
  enum class Shape : uint8_t { box, cylinder, ellipsoid } shape = Shape::box;
  int axis = 2;     ///< cylinder: 0, 1, 2 = x, y, z; a disk is a cylinder of no height
  Vec3 size{0.0f};  ///< extent along C0, along C90, vertical

  float radius() const { return 0.5f * glm::length(size); }
  bool is_point() const { return size == Vec3(0); }
};

/// Lamps that the luminaire may be fitted with, as its file says.
struct LampSet {
  double count = 1;  ///< EULUMDAT and LM-63 mark absolute photometry otherwise; here see Photometry::absolute
  double lumens = 0;                   ///< of all lamps of the set together; 0 = not said
  double watts = 0;                    ///< with ballast
  std::string name, color, rendering;  ///< free text
};

/// LM-63's TILT: what the lamp gives when the luminaire is tilted.
struct LampTilt {
  int geometry = 1;
  std::vector<double> angles, factors;  ///< degrees from the measured position; empty = always 1
};

/// A table of luminous intensity, bilinear between its angles, zero outside of them.
///
/// Azimuth and polar angle are about the goniometer's pole. Type C (all of EULUMDAT): pole = nadir, azimuth =
/// C, polar = gamma. Type A (LM-63 code 3): pole = -y, azimuth = horizontal angle, polar = 90 + vertical
/// angle. Type B (code 2): pole = -x, azimuth = vertical angle, polar = 90 + horizontal angle. A and B: (0,
/// 0) is -z, right is +x, up is +y.
struct Photometry {
  enum class Type : uint8_t { c, b, a } type = Type::c;
  std::vector<double> azimuths;  ///< degrees, ascending; type C: from 0 to 360, both
  std::vector<double> polars;    ///< degrees, ascending, within 0 to 180
  std::vector<double> candela;   ///< [azimuth][polar], absolute cd at the lamp set in use; never negative

  Opening opening;
  std::vector<LampSet> lamps;
  bool absolute = false;         ///< measured with its lamps, not relative to their rated flux
  std::optional<double> stated;  ///< luminous flux of the luminaire by its file, lm
  LampTilt tilt;
  std::vector<std::pair<std::string, std::string>> keywords;  ///< LM-63's [KEYWORD] lines, without brackets
  std::string format;                                         ///< "LM-63-2002", "EULUMDAT"
  std::vector<std::string> notes;  ///< what the reader mended or finds odd, one line each, with line numbers

  double at(std::size_t azimuth, std::size_t polar) const { return candela[azimuth * polars.size() + polar]; }
  /// A keyword's text, "" where absent.
  std::string keyword(std::string_view name) const;
};

/// Azimuth and polar angle of a direction (unit, luminaire's frame), degrees; type C: azimuth in [0, 360].
std::pair<double, double> angles_of(Photometry::Type type, const Vec3& direction);
/// Unit direction of azimuth and polar angle in degrees.
Vec3 direction_of(Photometry::Type type, double azimuth, double polar);

/// cd towards a unit direction of the luminaire's frame.
double intensity(const Photometry& photometry, const Vec3& direction);
/// cd at table angles, degrees.
double intensity_at(const Photometry& photometry, double azimuth, double polar);

/// Luminous flux, lm: exact for the bilinear table (methods.md 2.7).
double flux(const Photometry& photometry);
/// Flux below the horizon (gamma < 90) of a type C table over all flux; exact. 1 where there is no flux.
double downward_fraction(const Photometry& photometry);
/// Integral of (I at angle 0 .. I at angle 1, linear) x sine over a polar zone, degrees in; cd x rad.
double zone_integral(double from, double to, double at_from, double at_to);

/// Symmetries of a type C table, found in its values.
enum class Symmetry : uint8_t { none, axial, quadrants, about_c0, about_c90 };
Symmetry symmetry_of(const Photometry& photometry);
const char* name_of(Symmetry symmetry);

/// The same lamp as a type C table with the given steps; a type C table comes back as it is.
Photometry as_type_c(const Photometry& photometry, double azimuth_step = 2.5, double polar_step = 2.5);

/// Factor of LM-63's TILT at an angle, linear between its angles, held beyond them.
double tilt_factor(const LampTilt& tilt, double degrees);

}  // namespace sconce
