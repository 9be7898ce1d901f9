// SPDX-License-Identifier: Apache-2.0
#include "move_options.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/text.h"
#include "gpu/lamp_light.h"
#include "relight/package_operator.h"
#include "stage.h"

namespace sconce::app {

namespace {

/// One lamp of a change, which may be of many.
MovedLamp moved_lamp(const Lamp& lamp, const ChangedLamps& change) {
  MovedLamp out{Vec3(change.move.motion * glm::vec4(*place_of(lamp), 1)), change.target, change.kind};
  const auto axis = axis_of(lamp);
  if (change.target && change.kind.empty() && change.move.lamps.size() > 1)
    out.target = axis ? std::optional(out.at + Mat3(change.move.motion) * *axis) : std::nullopt;
  return out;
}

}  // namespace

void MoveOptions::declare(Options& options, bool relight) {
  lamps.declare(options, relight);
  options.option("--object", &objects,
                 "NAME=X,Y,Z[,DEGREES]: the middle of an object (a node of the scene) goes there, turned "
                 "as seen from above, its shadows and bounces follow; needs no operator in the package; may "
                 "be given several times");
}

std::vector<ObjectPlace> MoveOptions::places() const {
  std::vector<ObjectPlace> places;
  for (const std::string& text : objects) places.push_back(parse_object(text));
  return places;
}

bool MoveOptions::any() const {
  return !(lamps.lights.empty() && lamps.moves.empty() && lamps.kinds.empty() && lamps.file.empty() &&
           objects.empty());
}

std::string MoveOptions::text() const {
  std::vector<std::string> all;
  const auto add = [&](const char* name, const std::vector<std::string>& values) {
    for (const std::string& value : values) all.push_back(std::string(name) + " " + value);
  };
  add("--light", lamps.lights), add("--move", lamps.moves), add("--kind", lamps.kinds);
  if (!lamps.file.empty()) add("--lights", {lamps.file});
  add("--object", objects);
  return all.empty() ? "as the preset says" : join(all, " ");
}

Rearrangement::Rearrangement(const MoveOptions& options, const Preset& preset, const Package& package,
                             const View& home, const Progress& progress)
    : package_(package), home_(home) {
  WantedLamps wanted = options.lamps.parse(preset, progress, false);
  if (const std::vector<ObjectPlace> places = options.places(); !places.empty()) {
    objects_ = moves_to(home, places);
    moved_ = std::make_unique<View>(package, home.shown());
    moved_->place(ObjectPlaces(home.scene(), home.world()), objects_);
  }
  const Lamps own(view().scene(), view().world());
  names_ = lamp_names(own);
  for (const ChangedLamps& change : changed_lamps(wanted, view().scene(), own))
    for (const std::size_t i : change.move.lamps) {
      const Lamp& lamp = own.all()[i];
      places_[i] = moved_lamp(lamp, change);
      StandingLamp standing{i, change.move.motion, change.kind.empty(), {}};
      if (!standing.itself) {
        OtherKind other = change.other(lamp, progress);
        if (auto* lights = std::get_if<MoreLights>(&other))
          standing.other = std::move(*lights);
        else
          shaders_.push_back({lamp.group.value, std::move(std::get<gpu::LampShader>(other))}),
              shaders_.back().lamp.name = names_[i];
      }
      lamps_.push_back(std::move(standing));
    }
  added_ = std::move(wanted.more);
  for (gpu::LampShader& shader : wanted.shaders)
    shaders_.push_back({package.manifest().groups.size(), std::move(shader)});
}

std::vector<PresetLamp> Rearrangement::preset_lamps() const {
  std::vector<PresetLamp> out;
  for (const auto& [lamp, state] : places_) out.push_back({names_[lamp], state.at, state.target, state.kind});
  return out;
}

bool Rearrangement::adds() const {
  return !added_.lights.empty() || std::any_of(shaders_.begin(), shaders_.end(), [&](const Shader& shader) {
    return shader.group == package_.manifest().groups.size();
  });
}

PointMeter Rearrangement::meter(std::vector<SurfacePoint> points, const Progress& progress) const {
  if (!any()) return {home_, std::move(points), ReceiverKind::plane};
  std::vector<KnownLamp> lamps = known(points, progress);
  Scene all = scene();
  if (adds()) add_group(all, kAddedGroup, added_);
  PointMeter meter(std::make_shared<StandingScene>(std::move(all)), std::move(points), ReceiverKind::plane);
  meter.add(view(), std::move(lamps));
  return meter;
}

std::vector<KnownLamp> Rearrangement::known(std::span<const SurfacePoint> points,
                                            const Progress& progress) const {
  std::vector<KnownLamp> out;
  if (shaders_.empty() || points.empty()) return out;
  ObjectBounces bounces;
  if (moved_) {
    bounces = ObjectFollower(package_, home_, progress).follow(objects_, progress);
  } else {
    bounces.op = std::make_shared<const Operator>(find_operator(package_, ""));
    bounces.folded = std::make_shared<const FoldedBounces>(*bounces.op);
  }
  const Atlas atlas = package_atlas(package_, view());
  const auto context = open_context("gl");
  const gpu::Geometry geometry(*context, view().shown(), false);
  for (const Shader& shader : shaders_) {
    gpu::LampLight light(*context, geometry, view().world().bounds, shader.lamp);
    KnownLamp& lamp = out.emplace_back(KnownLamp{shader.group, light.at(points), {}});
    if (const gpu::Mishap mishap = light.mishap(); mishap.count > 0)
      progress.warn(fmt::format("{}: NaN or infinity at {} of {} points (first: {}), dark there",
                                shader.lamp.file, mishap.count, points.size(), mishap.first));
    lamp.pages = to_pages(atlas, *bounces.op, light.on_receivers(*bounces.op, *bounces.folded));
  }
  return out;
}

}  // namespace sconce::app
