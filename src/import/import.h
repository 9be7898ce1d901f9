// SPDX-License-Identifier: Apache-2.0
// Files to Scene. One file per format; each ends in the same plain Scene.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/progress.h"
#include "scene/measuring_plane.h"
#include "scene/scene.h"

namespace sconce {

/// A scene file by its format (tried in order; "not mine" is not "broken"), then its side file NAME.toml
/// beside it, then validate(). Groups are not yet assigned (scene/groups.h). Missing meshes and textures are
/// warnings that name them.
/// @throws Error: one line, file and place
Scene import_scene(const std::filesystem::path& path, const Progress& progress = {});

/// Endings of the files that import_scene() is for, lower case: ".glb", ".gltf", ...
std::span<const std::string_view> scene_endings();

/// glTF 2.0, .gltf and .glb. @throws NotMyFormat, Error
Scene import_gltf(const std::filesystem::path& path, const Progress& progress = {});
/// OBJ + MTL. @throws NotMyFormat, Error
Scene import_obj(const std::filesystem::path& path, const Progress& progress = {});

/// 3DS, FBX, COLLADA, PLY and STL through assimp, by file name ending. @throws NotMyFormat, Error
Scene import_assimp(const std::filesystem::path& path, const Progress& progress = {});

/// Blender's files, exported by the Blender that $BLENDER or PATH names. What the exporter leaves out is a
/// warning. @throws NotMyFormat; Error where Blender is missing or fails
Scene import_blend(const std::filesystem::path& path, const Progress& progress = {});

/// `kitchen.toml` of `kitchen.glb`: adds or overrides lights, groups, emission, cameras, sky. Unknown keys
/// are errors with file:line. The [options] table is the command line's business and ignored here.
void apply_side_file(const std::filesystem::path& path, Scene& scene, const Progress& progress = {});

/// L3D, .l3d or the structure.xml of an unpacked one: faces that shine emit 1000 lm together, evenly, as the
/// format says no flux. It hangs: nadir -y, C0 +x. @throws NotMyFormat, Error
Scene import_l3d(const std::filesystem::path& path, const Progress& progress = {});
/// What lies beside a structure.xml. @throws NotMyFormat
std::vector<std::filesystem::path> l3d_files(const std::filesystem::path& path);

/// What has no light at all gets an overcast sky of 10,000 lx, and a warning that names the ways to add
/// lamps.
void add_default_sky(Scene& scene, const Progress& progress = {});

/// `kitchen.toml` of `kitchen.glb`, where it stands.
std::optional<std::filesystem::path> side_file_of(const std::filesystem::path& scene);

/// [[plane]] of the side file: names and measuring planes. @param bounds  of the scene's world, metres
/// @throws Error with file:line
std::vector<std::pair<std::string, MeasuringPlane>> import_planes(const std::filesystem::path& scene,
                                                                  const Bounds& bounds);

/// Files besides `path` that the scene was read from (buffers, textures, side file), for content hashes.
std::vector<std::filesystem::path> scene_files(const std::filesystem::path& path);

}  // namespace sconce
