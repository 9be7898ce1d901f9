// SPDX-License-Identifier: Apache-2.0
// The tables of a side file, each applied to a scene. docs/side-file.md is their manual.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/progress.h"
#include "import/side_table.h"
#include "scene/scene.h"

namespace sconce {

/// What every table is applied with.
struct SideContext {
  std::filesystem::path path;
  Scene& scene;
  const Progress& progress;
};

/// `[[light]]`: every table of an array. One plain table `[light]` serves as well.
std::vector<const SideNode*> side_tables(const SideNode& root, std::string_view key);

/// Before all other tables: they speak of the scene as it then stands.
void apply_scene(const SideContext& context, const SideNode& node);
void apply_light(const SideContext& context, const SideNode& node);
/// The shapes `area` and `projector` of [[light]]. @throws Error with file:line
void set_panel(const SideContext& context, const SideTable& table, Light& light);
void set_projector(const SideContext& context, const SideTable& table, Light& light);
void apply_luminaire(const SideContext& context, const SideNode& node);
/// @return the direction towards the sun, also where it is below the horizon
std::optional<Vec3> apply_sun(const SideContext& context, const SideNode& node);
/// @param sun  towards it, for the kinds of sky that need it
void apply_sky(const SideContext& context, const SideNode& node, const std::optional<Vec3>& sun);
void apply_camera(const SideContext& context, const SideNode& node);
void apply_material(const SideContext& context, const SideNode& node);
void apply_emission(const SideContext& context, const SideNode& node);
void apply_group(const SideContext& context, const std::string& name, const SideNode& node);

/// Indices of the names that a glob matches; none: a warning with the nearest name.
std::vector<std::size_t> matching(const SideContext& context, const SideTable& table, std::string_view key,
                                  const std::string& glob, std::span<const std::string> names);

std::vector<std::string> node_names(const Scene& scene);
std::vector<std::string> light_names(const Scene& scene);
std::vector<std::string> material_names(const Scene& scene);

/// A frame at `position` that looks along `direction` (its -z), y up as far as possible.
Mat4 looking(const Vec3& position, const Vec3& direction, const Vec3& up = Vec3(0, 1, 0));

}  // namespace sconce
