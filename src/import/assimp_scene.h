// SPDX-License-Identifier: Apache-2.0
// What assimp has read, as a Scene.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "core/progress.h"
#include "scene/scene.h"

struct aiScene;
namespace Assimp {
class Importer;
}

namespace sconce {

/// The file as triangles, texture rows from the top. It is the importer's.
/// @param format  its name @param more  of aiPostProcessSteps
/// @throws Error in one line with assimp's reason
const aiScene& run_assimp(Assimp::Importer& importer, const std::filesystem::path& path,
                          std::string_view format, unsigned more = 0);

/// World transforms of nodes by name; where several have one name, the first's.
using AssimpNodes = std::map<std::string, Mat4>;

/// Materials, meshes, nodes, lamps and cameras. @param root  transform of the whole scene
/// @throws Error naming the file and the mesh
Scene read_assimp(const aiScene& read, const std::filesystem::path& file, const Mat4& root,
                  const Progress& progress);

/// Lamps of formats that know no photometric units: an intensity of 1 is taken as 1 W at 683 lm/W, which is
/// 54.35 cd of point and spot lamps and 683 lx of suns (as Blender's glTF export does). Area lamps become
/// points, ambient light is left out, and whatever the file says all fade by the square of the distance. All
/// that is said in warnings.
void read_assimp_lights(const aiScene& read, const std::filesystem::path& file, const AssimpNodes& nodes,
                        Scene& scene, const Progress& progress);
void read_assimp_cameras(const aiScene& read, const AssimpNodes& nodes, Scene& scene);

}  // namespace sconce
