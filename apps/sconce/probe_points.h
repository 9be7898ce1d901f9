// SPDX-License-Identifier: Apache-2.0
// Where `probe` measures: points of the command line, of a file, or of a plane.
#pragma once

#include <optional>

#include "session/measure.h"

namespace sconce::app {

struct ProbePoints {
  std::vector<SurfacePoint> points;
  std::optional<MeasuringPlane> plane;  ///< whose points they are
};

/// `X,Y,Z` or `X,Y,Z,NX,NY,NZ`; faces up where no normal is given. @throws UsageError naming `where`
SurfacePoint parse_probe(const std::string& text, const std::string& where);

/// Lines `x y z` or `x y z nx ny nz`, as rtrace takes them; empty lines and lines from `#` on are left out.
/// @param file  `-` = standard input @throws Error with file:line
std::vector<SurfacePoint> read_probes(const std::string& file);

/// `floor+0.75`: horizontal, facing up, over the scene less half a metre at each side; or
/// `X,Y,Z/AX,AY,AZ/BX,BY,BZ`: a corner and two edges at right angles, facing A x B.
/// @param spacing  metres between points, at most @param names  of other planes, for the error
/// @throws UsageError
MeasuringPlane parse_plane(const std::string& text, const Bounds& bounds, double spacing,
                           const std::vector<std::string>& names);

}  // namespace sconce::app
