// SPDX-License-Identifier: Apache-2.0
#include "move_options.h"

#include "core/error.h"
#include "core/text.h"

namespace sconce::app {

namespace {

/// One lamp of a change, which may be of many.
PresetLamp preset_lamp(const Lamp& lamp, const std::string& name, const ChangedLamps& change) {
  PresetLamp out{name, Vec3(change.move.motion * glm::vec4(*place_of(lamp), 1)), change.target, change.kind};
  const auto axis = axis_of(lamp);
  if (change.target && change.kind.empty() && change.move.lamps.size() > 1)
    out.target = axis ? std::optional(*out.at + Mat3(change.move.motion) * *axis) : std::nullopt;
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
    : home_(home) {
  const WantedLamps wanted = options.lamps.parse(preset, progress, false);
  if (const std::vector<ObjectPlace> places = options.places(); !places.empty()) {
    moved_ = std::make_unique<View>(package, home.shown());
    moved_->place(ObjectPlaces(home.scene(), home.world()), moves_to(home, places));
  }
  const Lamps own(view().scene(), view().world());
  bool shaders = !wanted.shaders.empty();
  const std::vector<std::string> names = lamp_names(own);
  for (const ChangedLamps& change : changed_lamps(wanted, view().scene(), own))
    for (const std::size_t i : change.move.lamps) {
      preset_lamps_.push_back(preset_lamp(own.all()[i], names[i], change));
      StandingLamp lamp{i, change.move.motion, change.kind.empty(), {}};
      if (!lamp.itself) {
        OtherKind other = change.other(own.all()[i], progress);
        if (auto* lights = std::get_if<MoreLights>(&other))
          lamp.other = std::move(*lights);
        else
          shaders = true;
      }
      lamps_.push_back(std::move(lamp));
    }
  if (shaders) throw UsageError({}, "rays know no light shaders", "sconce relight");
  added_ = wanted.more;
}

PointMeter Rearrangement::meter(std::vector<SurfacePoint> points) const {
  if (!any()) return {home_, std::move(points), ReceiverKind::plane};
  Scene all = scene();
  if (!added_.lights.empty()) add_group(all, kAddedGroup, added_);
  return {std::make_shared<StandingScene>(std::move(all)), std::move(points), ReceiverKind::plane};
}

}  // namespace sconce::app
