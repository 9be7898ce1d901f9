// SPDX-License-Identifier: Apache-2.0
#include "relight_lamps.h"

#include <algorithm>

#include "core/error.h"
#include "core/text.h"
#include "import/lights.h"
#include "picture/seen.h"
#include "picture_options.h"

namespace sconce::app {

namespace {

constexpr std::string_view kMove = "option '--move'", kKind = "option '--kind'";

/// `LAMP=X,Y,Z`, and `,target=X,Y,Z` after it. @throws UsageError
LampChange parse_move(const std::string& text) {
  constexpr std::string_view kTarget = ",target=";
  const std::size_t target = text.rfind(kTarget);
  const std::string place = text.substr(0, target);
  const std::size_t equals = place.rfind('=');
  if (equals == std::string::npos || equals == 0)
    throw UsageError(std::string(kMove), "'" + text + "' is not understood", "LAMP=X,Y,Z[,target=X,Y,Z]");
  LampChange change{place.substr(0, equals), parse_point(place.substr(equals + 1), "--move")};
  if (target != std::string::npos)
    change.target = parse_point(text.substr(target + kTarget.size()), "--move");
  return change;
}

/// `LAMP=WORDS`: as the words begin with a kind, the name ends before the last `=KIND`.
LampChange parse_kind_option(const std::string& text) {
  const std::size_t equals = text.substr(0, text.find(',')).rfind('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
    throw UsageError(std::string(kKind), "'" + text + "' is not understood", "LAMP=KIND[,KEY=VALUE...]");
  return {text.substr(0, equals), {}, {}, text.substr(equals + 1)};
}

void add(OtherKind made, const Rgb& weight, MoreLights& more, std::vector<gpu::LampShader>& shaders) {
  if (auto* shader = std::get_if<gpu::LampShader>(&made)) {
    shader->intensity = shader->intensity * weight;
    shaders.push_back(std::move(*shader));
    return;
  }
  auto& lights = std::get<MoreLights>(made);
  for (Light& light : lights.lights) light.intensity = light.intensity * weight;
  append(more, std::move(lights));
}

/// The group of that name. @throws UsageError
Id<LightGroup> find_group(const Scene& scene, const std::string& name) {
  std::vector<std::string> known;
  for (const LightGroup& group : scene.groups) known.push_back(group.name);
  const auto it = std::find(known.begin(), known.end(), name);
  if (it == known.end())
    throw UsageError("--light group", "unknown group '" + name + "'" + did_you_mean(name, known),
                     join(known, ", "));
  return Id<LightGroup>(static_cast<std::size_t>(it - known.begin()));
}

/// Without the lamps that shine as something else.
std::vector<MovedGroup> without(std::vector<MovedGroup> groups, const Lamps& lamps,
                                std::span<const std::size_t> others) {
  for (MovedGroup& group : groups) {
    if (group.lamps.empty())
      for (std::size_t i = 0; i < lamps.size(); ++i)
        if (lamps.all()[i].group == group.group) group.lamps.push_back(i);
    std::erase_if(group.lamps, [&](std::size_t lamp) {
      return std::find(others.begin(), others.end(), lamp) != others.end();
    });
  }
  std::erase_if(groups, [](const MovedGroup& group) { return group.lamps.empty(); });
  return groups;
}

}  // namespace

void LampWords::declare(Options& options, bool relight) {
  const std::string by_transfer =
      relight ? "or group,name=G: the group by transfer instead of by its layer; " : "";
  options.option(
      "--light", &lights,
      "a lamp: point, spot, sun, area or projector, then keys as in a side file, for example "
      "spot,position=1,2,0,target=0,0,0,lumens=800; or luminaire,file=lamp.ldt,position=X,Y,Z: a measured "
      "one; " +
          by_transfer +
          "or shader,file=F.glsl,position=X,Y,Z,UNIFORM=VALUE,...: a light of your own, by OpenGL; may be "
          "given several times");
  options.option("--lights", &file, "TOML file with [[light]] and [[luminaire]] tables");
  options.option(
      "--move", &moves,
      "LAMP=X,Y,Z[,target=X,Y,Z]: a lamp or a whole group of the package leaves its layer and shines "
      "from there, turned to the target; may be given several times");
  options.option("--kind", &kinds,
                 "LAMP=KIND[,KEY=VALUE...]: a lamp or each of a group becomes another one, in the words of "
                 "--light, where it stands or is moved to; its flux (but a luminaire's, a sun's), colour and "
                 "direction stay where they say none, and it goes on following its fader; may be given "
                 "several times");
}

WantedLamps LampWords::parse(const Preset& preset, const Progress& progress, bool some) const {
  constexpr std::string_view kGroup = "group,name=";
  WantedLamps wanted;
  for (const std::string& text : lights) {
    if (text.starts_with(kGroup))
      wanted.groups.push_back(text.substr(kGroup.size()));
    else
      add(parse_kind(text, "--light " + text, progress), Rgb(1), wanted.more, wanted.shaders);
  }
  if (!file.empty()) append(wanted.more, read_lights(file, progress));
  for (const PresetLamp& lamp : preset.lamps)
    wanted.changes.push_back({lamp.name, lamp.at, lamp.target, lamp.kind});
  const auto change_of = [&](const std::string& name) -> LampChange& {
    for (LampChange& change : wanted.changes)
      if (change.name == name) return change;
    return wanted.changes.emplace_back(LampChange{name});
  };
  for (const std::string& text : moves) {
    const LampChange to = parse_move(text);
    LampChange& change = change_of(to.name);
    change.at = to.at, change.target = to.target;
  }
  for (const std::string& text : kinds) {
    const LampChange to = parse_kind_option(text);
    change_of(to.name).kind = to.kind;
  }
  if (some && wanted.more.lights.empty() && wanted.groups.empty() && wanted.changes.empty() &&
      wanted.shaders.empty())
    throw UsageError({}, "nothing to move: --light, --lights, --move, --kind or --object",
                     "--light spot,position=X,Y,Z,lumens=N; --move LAMP=X,Y,Z");
  return wanted;
}

OtherKind ChangedLamps::other(const Lamp& lamp, const Progress& progress) const {
  const Vec3 at(move.motion * glm::vec4(place_of(lamp).value_or(Vec3(0)), 1));
  return become(lamp, {at, target}, kind, "--kind " + name + "=" + kind, progress);
}

std::vector<ChangedLamps> changed_lamps(const WantedLamps& wanted, const Scene& scene, const Lamps& lamps) {
  std::vector<ChangedLamps> out;
  for (const LampChange& change : wanted.changes) {
    const std::string option(change.kind.empty() ? kMove : kKind);
    LampMove move = find_lamps(scene, lamps, change.name, option);
    if (change.at || change.target) {
      LampPlace to{change.at.value_or(middle_of(lamps, move.lamps)), change.target};
      if (!change.kind.empty()) to.target.reset();  // what it becomes may point where it does not
      move.motion = motion_to(lamps, move.lamps, to, change.name, option);
    }
    out.push_back({change.name, std::move(move), change.target, change.kind});
  }
  return out;
}

RelitLamps place_lamps(const WantedLamps& wanted, const Scene& scene, const Lamps& lamps, bool whole,
                       MixSpec& lightmap, const Progress& progress) {
  RelitLamps out{wanted.more, wanted.shaders, {}, {}, {}};
  std::vector<Id<LightGroup>> groups;
  for (const std::string& name : wanted.groups) groups.push_back(find_group(scene, name));
  std::vector<LampMove> leaving;
  std::vector<std::size_t> others;
  for (const ChangedLamps& change : changed_lamps(wanted, scene, lamps)) {
    if (change.kind.empty())
      out.moves.push_back(change.move);
    else
      for (const std::size_t i : change.move.lamps) {
        const Lamp& lamp = lamps.all()[i];
        others.push_back(i);
        const Rgb weight = weight_of(lightmap, lamp.group);
        if (!weight.is_black()) add(change.other(lamp, progress), weight, out.more, out.shaders);
      }
    leaving.push_back(change.move);
  }
  out.left = take_lamps(lamps, groups, leaving, whole, lightmap);
  out.shining = without(out.left, lamps, others);
  return out;
}

}  // namespace sconce::app
