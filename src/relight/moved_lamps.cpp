// SPDX-License-Identifier: Apache-2.0
#include "relight/moved_lamps.h"

#include <algorithm>

#include "core/parallel.h"
#include "core/sobol.h"
#include "picture/glint.h"
#include "picture/seen.h"
#include "trace/box.h"

namespace sconce {

namespace {

constexpr uint32_t kCloudStream = 0x636c6f64u, kMetStream = 0x6d6574u, kBuriedStream = 0x62757269u;

/// Lamps are the scene's lights, in order, and then the emissive meshes.
Scene with(const Scene& scene, const World& world, const MoreLights& more, std::span<const LampMove> moves) {
  Scene out = scene;
  if (!moves.empty()) {
    const Lamps lamps(scene, world);
    for (const LampMove& move : moves)
      for (const std::size_t i : move.lamps) {
        const auto* mesh = std::get_if<MeshLamp>(&lamps.all()[i].shape);
        Mat4& frame = mesh != nullptr ? out.instances[world.instances[mesh->first_triangle].value].transform
                                      : out.lights[i].frame;
        frame = move.motion * frame;
      }
  }
  append(out, more);
  return out;
}

bool moves_meshes(const Scene& scene, std::span<const LampMove> moves) {
  return std::any_of(moves.begin(), moves.end(), [&](const LampMove& move) {
    return std::any_of(move.lamps.begin(), move.lamps.end(),
                       [&](std::size_t i) { return i >= scene.lights.size(); });
  });
}

}  // namespace

SurfacePoint point_of(const OperatorPoint& point) {
  return {Vec3(point.position[0], point.position[1], point.position[2]), unpack_normal(point.shading),
          unpack_normal(point.geometric)};
}

MovedLamps::MovedLamps(const Scene& scene, const World& world, const Tracer& tracer, const MoreLights& added,
                       std::span<const MovedGroup> groups, std::span<const LampMove> moves)
    : world_(world),
      tracer_(tracer),
      scene_(with(scene, world, added, moves)),
      moved_world_(moves_meshes(scene, moves) ? make_world(scene_) : World()),
      lamps_(scene_, moved_world_.size() > 0 ? moved_world_ : world_),
      near_(near_lamps(lamps_)) {
  const std::size_t more = added.lights.size();
  // Lamps of the scene alone, by their number there.
  const auto before = [&](std::size_t i) { return i < scene.lights.size() ? i : i - more; };
  const auto one_of = [](const std::vector<std::size_t>& some, std::size_t i) {
    return some.empty() || std::find(some.begin(), some.end(), i) != some.end();
  };
  const auto moved = [&](std::size_t i) {
    return std::any_of(moves.begin(), moves.end(),
                       [&](const LampMove& move) { return one_of(move.lamps, before(i)); });
  };
  for (std::size_t i = 0; i < lamps_.size(); ++i) {
    const bool joined = i >= scene.lights.size() && i < scene_.lights.size();
    const LampShape& shape = lamps_.all()[i].shape;
    const bool met =
        std::holds_alternative<SkyLamp>(shape) || (std::holds_alternative<MeshLamp>(shape) && !moved(i));
    if (joined) {
      chosen_.push_back({i, Rgb(1), met});
      continue;
    }
    for (const MovedGroup& group : groups)
      if (lamps_.all()[i].group == group.group && !group.weight.is_black() && one_of(group.lamps, before(i)))
        chosen_.push_back({i, group.weight, met});
  }
  for (const Chosen& chosen : chosen_) {
    if (!chosen.met) continue;
    met_.resize(lamps_.size());
    met_[chosen.lamp] = chosen.weight;
  }
}

std::vector<std::pair<std::size_t, Rgb>> MovedLamps::chosen() const {
  std::vector<std::pair<std::size_t, Rgb>> out;
  for (const Chosen& c : chosen_) out.emplace_back(c.lamp, c.weight);
  return out;
}

template <class Wanted, class Add>
void MovedLamps::light(const SurfacePoint& at, uint32_t stream, uint32_t index, const Wanted& wanted,
                       const Add& add) const {
  const Vec3 start = offset_origin(at.position, at.geometric_normal, at.geometric_normal);
  const float offset = glm::distance(start, at.position);
  for (const Chosen& chosen : chosen_) {
    LightSample light;
    const Vec2 u = sobol_pair(index, 0, mix32(stream, static_cast<uint32_t>(chosen.lamp)));
    if (!lamps_.sample(chosen.lamp, at.position, u, light) || light.radiance.is_black()) continue;
    const float cosine = glm::dot(light.direction, at.shading_normal);
    if (!(cosine > 0) || !(glm::dot(light.direction, at.geometric_normal) > 0)) continue;
    if (!wanted(Ray{start, light.direction, light.distance})) continue;
    const float end = shadow_end(light, offset);
    const Rgb passed = end > 0 ? tracer_.transmittance({start, light.direction, end}) : Rgb(1.0f);
    if (passed.is_black()) continue;
    const float density = light.delta ? 1 : light.pdf + (chosen.met ? cosine * kInvPi : 0);
    add(chosen.lamp, chosen.weight * passed * light.radiance * (cosine / density));
  }
  if (!met_.empty()) met(at, start, stream, index, wanted, add);
}

Rgb MovedLamps::illuminance(const SurfacePoint& at, uint32_t stream, uint32_t index) const {
  Rgb sum;
  light(
      at, stream, index, [](const Ray&) { return true; }, [&](std::size_t, const Rgb& e) { sum += e; });
  return sum;
}

void MovedLamps::add_light_through(std::span<const Bounds> boxes, const SurfacePoint& at, uint32_t stream,
                                   uint32_t index, std::span<Rgb> groups) const {
  light(
      at, stream, index, [&](const Ray& ray) { return meets(boxes, ray); },
      [&](std::size_t lamp, const Rgb& e) {
        if (const Id<LightGroup> group = lamps_.all()[lamp].group; group) groups[group.value] += e;
      });
}

Rgb MovedLamps::glints(const MixSpec& mix, const Shade& surface, const Vec3& to_eye, const SurfacePoint& at,
                       uint32_t stream, uint32_t index) const {
  Rgb sum;
  for (const std::size_t lamp : near_) {
    const auto chosen =
        std::find_if(chosen_.begin(), chosen_.end(), [&](const Chosen& c) { return c.lamp == lamp; });
    const Rgb weight = chosen != chosen_.end() ? chosen->weight : weight_of(mix, lamps_.all()[lamp].group);
    if (weight.is_black()) continue;
    const Vec2 u = sobol_pair(index, 0, mix32(stream, static_cast<uint32_t>(lamp)));
    sum += weight * glint(lamps_, lamp, tracer_, surface, to_eye, at, u);
  }
  return sum;
}

template <class Wanted, class Add>
void MovedLamps::met(const SurfacePoint& at, const Vec3& start, uint32_t stream, uint32_t index,
                     const Wanted& wanted, const Add& add) const {
  const Vec3 direction =
      Frame(at.shading_normal).to_world(square_to_cosine(sobol_pair(index, 0, mix32(stream, kMetStream))));
  const float cosine = glm::dot(direction, at.shading_normal);
  if (!(cosine > 0) || !(glm::dot(direction, at.geometric_normal) > 0)) return;
  if (!wanted(Ray{start, direction})) return;
  const auto share = [&](float density) { return cosine / (density + cosine * kInvPi); };
  const auto [hit, passed] =
      tracer_.follow({start, direction}, [&] { return sobol_pair(index, 1, mix32(stream, kMetStream)).x; });
  if (!hit) {
    for (const uint32_t sky : lamps_.skies())
      if (!met_[sky].is_black())
        add(sky,
            met_[sky] * passed * lamps_.sky_radiance(sky, direction) * share(lamps_.sky_pdf(sky, direction)));
    return;
  }
  const int lamp = lamps_.lamp_of(hit.triangle);
  if (lamp < 0 || met_[static_cast<std::size_t>(lamp)].is_black()) return;
  const Rgb emission = lamps_.emission(hit.triangle, hit.barycentric, hit.back);
  if (emission.is_black()) return;
  add(static_cast<std::size_t>(lamp),
      met_[static_cast<std::size_t>(lamp)] * passed * emission *
          share(lamps_.pdf(hit.triangle, hit.barycentric, hit.distance, direction)));
}

std::vector<std::string> MovedLamps::buried() const {
  constexpr uint32_t kRays = 128;
  std::vector<std::string> names;
  for (const Chosen& chosen : chosen_) {
    const Lamp& lamp = lamps_.all()[chosen.lamp];
    if (chosen.met) continue;  // stands in its own body
    const auto place = place_of(lamp);
    if (!place) continue;
    uint32_t backs = 0;
    for (uint32_t r = 0; r < kRays; ++r) {
      const Hit hit = tracer_.closest({*place, square_to_sphere(sobol_pair(r, 0, kBuriedStream))});
      const bool own = hit && lamps_.lamp_of(hit.triangle) == static_cast<int>(chosen.lamp);
      const bool open =
          hit && (scene_[world_.materials[hit.triangle]].double_sided || tracer_.passing(hit).share() > 0);
      backs += hit && hit.back && !own && !open ? 1 : 0;
    }
    if (2 * backs > kRays) names.push_back(lamp.name);
  }
  return names;
}

std::vector<Rgbx> light_cloud(const Operator& op, const MovedLamps& lamps) {
  return slot_exitance(op, [&](std::size_t i) {
    const auto slot = static_cast<uint32_t>(i / op.points_per_slot);
    return lamps.illuminance(point_of(op.lit[i]), mix32(kCloudStream, slot),
                             static_cast<uint32_t>(i % op.points_per_slot));
  });
}

}  // namespace sconce
