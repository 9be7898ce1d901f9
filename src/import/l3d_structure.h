// SPDX-License-Identifier: Apache-2.0
// The structure.xml of an L3D luminaire: parts, their places, and which of their faces shine.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/vec.h"

namespace sconce {

/// A rectangle or disk that stands for what shines, as photometric files know it.
struct L3dEmitter {
  std::string name;
  Mat4 transform{1.0f};  ///< of its frame to the luminaire's; it shines along its -z, C0 is its +x
  Vec2 size{0};          ///< m, along x and y
  bool round = false;
};

/// Faces of a part that shine.
struct L3dSurface {
  std::string name;
  std::string emitter;  ///< its light-emitting object
  double intensity = 1;
  std::vector<std::pair<int, std::pair<int, int>>> faces;  ///< group, first and last face, from 0 on
};

struct L3dPart {
  std::string name, geometry;  ///< the latter: id of a file
  Mat4 transform{1.0f};        ///< to the luminaire's frame, metres; its z is up
  std::vector<L3dSurface> surfaces;
};

struct L3dGeometry {
  std::string file;
  double unit = 1;  ///< m
};

struct L3dStructure {
  std::map<std::string, L3dGeometry> geometries;
  std::vector<L3dPart> parts;
  std::vector<L3dEmitter> emitters;
};

/// Joints stand as their DefaultRotation turns them. @throws Error naming where:line
L3dStructure parse_l3d(std::string_view xml, const std::string& where);

}  // namespace sconce
