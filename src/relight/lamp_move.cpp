// SPDX-License-Identifier: Apache-2.0
#include "relight/lamp_move.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "core/error.h"
#include "core/text.h"

namespace sconce {

namespace {

template <class T>
bool has(const std::vector<T>& all, const T& one) {
  return std::find(all.begin(), all.end(), one) != all.end();
}

/// Turns one direction into another, the shortest way.
Mat4 turning(const Vec3& from, const Vec3& to) {
  const Vec3 across = glm::cross(from, to);
  const float sine = glm::length(across), cosine = glm::dot(from, to);
  const Vec3 axis = sine > 1e-6f ? across / sine : Frame(from).x;
  return glm::rotate(Mat4(1.0f), std::atan2(sine, cosine), axis);
}

}  // namespace

std::optional<Vec3> place_of(const Lamp& lamp) {
  if (const auto* punctual = std::get_if<PunctualLamp>(&lamp.shape)) return punctual->position;
  if (const auto* luminaire = std::get_if<LuminaireLamp>(&lamp.shape)) return luminaire->position;
  if (const auto* field = std::get_if<NearFieldLamp>(&lamp.shape)) return field->position;
  if (const auto* projector = std::get_if<ProjectorLamp>(&lamp.shape)) return projector->position;
  if (const auto* mesh = std::get_if<MeshLamp>(&lamp.shape)) return mesh->center;
  return std::nullopt;
}

std::optional<Vec3> axis_of(const Lamp& lamp) {
  if (const auto* punctual = std::get_if<PunctualLamp>(&lamp.shape))
    return punctual->cos_outer > -1 ? std::optional(punctual->axis) : std::nullopt;
  if (const auto* luminaire = std::get_if<LuminaireLamp>(&lamp.shape)) return -luminaire->to_world[2];
  if (const auto* field = std::get_if<NearFieldLamp>(&lamp.shape)) return -field->to_world[2];
  if (const auto* projector = std::get_if<ProjectorLamp>(&lamp.shape)) return -projector->to_world[2];
  if (const auto* mesh = std::get_if<MeshLamp>(&lamp.shape))
    return mesh->axis != Vec3(0) ? std::optional(mesh->axis) : std::nullopt;
  return std::nullopt;
}

std::vector<std::string> lamp_names(const Lamps& lamps) {
  const auto same = [&](std::size_t a, std::size_t b) {
    return place_of(lamps.all()[b]) && lamps.all()[a].name == lamps.all()[b].name;
  };
  std::vector<std::string> names(lamps.size());
  for (std::size_t i = 0; i < lamps.size(); ++i) {
    if (!place_of(lamps.all()[i])) continue;
    std::size_t before = 0, all = 0;
    for (std::size_t k = 0; k < lamps.size(); ++k)
      if (same(i, k)) ++all, before += k < i ? 1 : 0;
    names[i] = lamps.all()[i].name;
    if (all > 1 || names[i].empty()) names[i] += "#" + std::to_string(before + 1);
  }
  return names;
}

LampMove find_lamps(const Scene& scene, const Lamps& lamps, const std::string& name,
                    const std::string& option) {
  LampMove move;
  std::vector<std::string> known;
  const std::vector<std::string> names = lamp_names(lamps);
  for (std::size_t i = 0; i < lamps.size(); ++i) {
    const Lamp& lamp = lamps.all()[i];
    const std::string group = lamp.group.valid() ? scene[lamp.group].name : std::string();
    for (const std::string& word : {lamp.name, group})
      if (!word.empty() && !has(known, word)) known.push_back(word);
    if (name != lamp.name && name != group && name != names[i]) continue;
    if (!place_of(lamp))
      throw UsageError(option, "'" + name + "' shines from everywhere", "a lamp that has a place");
    move.lamps.push_back(i);
    if (lamp.group.valid() && !has(move.groups, lamp.group)) move.groups.push_back(lamp.group);
  }
  if (move.lamps.empty())
    throw UsageError(option, "no lamp or group '" + name + "'" + did_you_mean(name, known),
                     join(known, ", "));
  return move;
}

Vec3 middle_of(const Lamps& lamps, std::span<const std::size_t> some) {
  Vec3 sum(0);
  for (const std::size_t i : some) sum += place_of(lamps.all()[i]).value_or(Vec3(0));
  return sum / static_cast<float>(some.size());
}

Mat4 motion_to(const Lamps& lamps, std::span<const std::size_t> some, const LampPlace& to,
               const std::string& name, const std::string& option) {
  std::optional<Vec3> axis;
  for (const std::size_t i : some)
    if (!axis) axis = axis_of(lamps.all()[i]);
  Mat4 turn(1.0f);
  if (to.target) {
    if (!axis) throw UsageError(option, "'" + name + "' shines all around", "a target for lamps that point");
    const Vec3 direction = *to.target - to.position;
    if (!(glm::length(direction) > 0))
      throw UsageError(option, "'" + name + "' would stand on its target", "two places");
    turn = turning(glm::normalize(*axis), glm::normalize(direction));
  }
  return glm::translate(Mat4(1.0f), to.position) * turn * glm::translate(Mat4(1.0f), -middle_of(lamps, some));
}

LampMove find_move(const Scene& scene, const Lamps& lamps, const std::string& name, const LampPlace& to,
                   const std::string& option) {
  LampMove move = find_lamps(scene, lamps, name, option);
  move.motion = motion_to(lamps, move.lamps, to, name, option);
  return move;
}

std::vector<MovedGroup> take_lamps(const Lamps& lamps, std::span<const Id<LightGroup>> groups,
                                   std::span<const LampMove> moves, bool whole, MixSpec& lightmap) {
  std::vector<MovedGroup> taken;
  const auto take = [&](Id<LightGroup> group, std::vector<std::size_t> some) {
    if (std::any_of(taken.begin(), taken.end(), [&](const MovedGroup& t) { return t.group == group; }))
      return;
    taken.push_back({group, lightmap.weights[group.value], std::move(some)});
    if (taken.back().lamps.empty()) lightmap.weights[group.value] = Rgb(0);
  };
  for (const Id<LightGroup> group : groups) take(group, {});
  std::vector<uint8_t> moved(lamps.size(), 0);
  for (const LampMove& move : moves)
    for (const std::size_t i : move.lamps) moved[i] = 1;
  for (const LampMove& move : moves)
    for (const Id<LightGroup> group : move.groups) {
      std::vector<std::size_t> go;
      bool all = true;
      for (std::size_t i = 0; i < lamps.size(); ++i) {
        if (lamps.all()[i].group != group) continue;
        if (moved[i] != 0)
          go.push_back(i);
        else
          all = false;
      }
      take(group, all || whole ? std::vector<std::size_t>{} : go);
    }
  return taken;
}

std::vector<MovedGroup> in_part(std::span<const MovedGroup> taken) {
  std::vector<MovedGroup> parts;
  std::copy_if(taken.begin(), taken.end(), std::back_inserter(parts),
               [](const MovedGroup& group) { return !group.lamps.empty(); });
  return parts;
}

}  // namespace sconce
