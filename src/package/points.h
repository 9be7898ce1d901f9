// SPDX-License-Identifier: Apache-2.0
// Light at points that are no texels, per group, as a package keeps it: measuring planes, and probes for what
// moves. Files: docs/package-format.md.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "package/package.h"
#include "scene/measuring_plane.h"

namespace sconce {

/// Illuminance at the points of a measuring plane, at unit weight.
struct PlaneLight {
  std::string name;
  MeasuringPlane plane;
  int samples = 0;          ///< paths per point, at most
  std::vector<Rgb> values;  ///< [point * groups + g], lux
};

/// A probe's light of one group, lux per channel: e = 1/4 the integral of L over the sphere, then x, y, z of
/// g = 1/2 the integral of L w. What faces n receives about e + g . n (docs/adr/0038-probes.md).
using ProbeValue = std::array<Rgb, 4>;

/// Probes at the corners of a regular grid along the axes.
struct ProbeGrid {
  Vec3 origin{0};                    ///< of probe 0, metres
  float spacing = 1;                 ///< metres
  std::array<int, 3> size{0, 0, 0};  ///< probe (x, y, z) is number (z * size[1] + y) * size[0] + x
  std::size_t groups = 0;
  std::vector<uint8_t> valid;      ///< per probe; 0 = inside of something solid
  std::vector<ProbeValue> values;  ///< [probe * groups + g] at unit weight

  std::size_t probes() const { return valid.size(); }
  Vec3 position(std::size_t probe) const;
  /// Group g's light at `point`: trilinear between the valid ones of the eight probes around it; points
  /// outside count as at the border. Black where none is valid.
  ProbeValue at(const Vec3& point, std::size_t g) const;
  /// Of all groups. @param weights  MixSpec::weights
  ProbeValue mixed(const Vec3& point, std::span<const Rgb> weights) const;
  /// What a small surface at `point` receives that faces the unit `normal`: facing(), 0 at least.
  Rgb illuminance(const Vec3& point, const Vec3& normal, std::span<const Rgb> weights) const;
};

/// e + g . n: what a small surface receives that faces the unit `normal`, lux per channel. Below 0 where the
/// form has no better answer; light is cut there once it is mixed.
Rgb facing(const ProbeValue& light, const Vec3& normal);

/// Their files, by name. @param probes  may be null
std::map<std::string, Image> print_points(std::span<const PlaneLight> planes, const ProbeGrid* probes,
                                          std::span<const GroupInfo> groups);
/// write_package() with these files beside the layers. @throws as that
void write_package(const std::filesystem::path& path, PackageContents contents,
                   const std::map<std::string, Image>& points);

/// The planes of a package, by name. @throws Error naming the damaged file
std::vector<PlaneLight> read_planes(const Package& package);
/// Its probes, if it has any. @throws Error naming the damaged file
std::optional<ProbeGrid> read_probes(const Package& package);

}  // namespace sconce
