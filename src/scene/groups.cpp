// SPDX-License-Identifier: Apache-2.0
#include "scene/groups.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>

#include "core/error.h"

namespace sconce {

namespace {

constexpr std::string_view kAll = "all", kRest = "rest", kSky = "sky", kSun = "sun";
constexpr std::string_view kGroupPrefix = "group:";

/// What can be given a group: an emissive instance or a lamp.
struct Member {
  Id<LightGroup>* group;
  std::string asked;      ///< by the file or the side file
  std::string name;       ///< node, or material where the node has none
  std::string lamp_name;  ///< extras.light
  bool sky = false, sun = false;
};

std::vector<Member> members(Scene& scene) {
  std::vector<Member> out;
  for (Instance& instance : scene.instances) {
    instance.group = {};
    if (!scene.emits(instance)) continue;
    const std::string& material = scene[scene[instance.mesh].material].name;
    out.push_back({&instance.group, instance.group_name, instance.name.empty() ? material : instance.name,
                   instance.light_name});
  }
  for (Light& light : scene.lights) {
    out.push_back({&light.group, light.group_name, light.name, light.light_name,
                   std::holds_alternative<SkyLight>(light.shape),
                   std::holds_alternative<SunLight>(light.shape)});
  }
  for (Member& m : out) {
    if (m.name.starts_with(kGroupPrefix)) m.name.erase(0, kGroupPrefix.size());
    if (m.name.empty()) m.name = m.sky ? kSky : m.sun ? kSun : "lamp";
  }
  return out;
}

bool is_digit(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

/// "Lamp.001" -> "Lamp", "spot_2" -> "spot", "bulb12" -> "bulb"; a name of digits alone stays.
std::string without_counter(const std::string& name) {
  std::string out = name;
  while (!out.empty() && is_digit(out.back())) {
    std::size_t end = out.size();
    while (end > 0 && is_digit(out[end - 1])) --end;
    while (end > 0 &&
           (out[end - 1] == '.' || out[end - 1] == '_' || out[end - 1] == '-' || out[end - 1] == ' '))
      --end;
    if (end == 0) break;
    out.resize(end);
  }
  return out.empty() ? name : out;
}

bool is_reserved(std::string_view name) {
  return name == kAll || name == kRest || name == kSky || name == kSun;
}

/// May this member's group carry the name? Reserved names only with their own meaning.
bool may_be_called(const Member& m, std::string_view name) {
  if (!is_reserved(name)) return true;
  return name == kRest || (name == kSky && m.sky) || (name == kSun && m.sun);
}

/// A name of our own making never collides with a reserved one.
std::string derived(const Member& m, const std::string& name) {
  return is_reserved(name) && (name == kRest || !may_be_called(m, name)) ? name + "-lamp" : name;
}

std::string automatic_name(const Member& m) {
  if (m.sky) return std::string(kSky);
  if (m.sun) return std::string(kSun);
  return derived(m, without_counter(m.name));
}

void check_asked(const Scene& scene, const Member& m) {
  if (may_be_called(m, m.asked)) return;
  throw Error(scene.name, "light group '" + m.asked + "' of '" + m.name + "' has a reserved name",
              m.asked == kSky   ? "any name; `sky` is for the sky alone"
              : m.asked == kSun ? "any name; `sun` is for suns alone"
                                : "any name but all, rest, sky, sun");
}

/// Names in use, so that every lamp of `per_light` gets its own.
class UniqueNames {
 public:
  std::string take(const std::string& wanted) {
    std::string name = wanted;
    for (int n = 2; !used_.insert(name).second; ++n) name = wanted + "#" + std::to_string(n);
    return name;
  }

 private:
  std::set<std::string> used_;
};

}  // namespace

Grouping parse_grouping(std::string_view text) {
  if (text == "auto") return Grouping::automatic;
  if (text == "named") return Grouping::named;
  if (text == "per-light") return Grouping::per_light;
  if (text == "one") return Grouping::one;
  throw UsageError("--groups", "'" + std::string(text) + "' is unknown", "auto, named, per-light, one");
}

void assign_groups(Scene& scene, Grouping grouping) {
  scene.groups.clear();
  std::map<std::string, Id<LightGroup>> known;
  UniqueNames unique;
  for (const Member& m : members(scene)) {
    check_asked(scene, m);
    std::string name;
    switch (grouping) {
      case Grouping::automatic:
        name = m.asked.empty() ? automatic_name(m) : m.asked;
        break;
      case Grouping::named:
        name = m.asked.empty() ? std::string(kRest) : m.asked;
        break;
      case Grouping::per_light:
        name = unique.take(derived(m, m.lamp_name.empty() ? m.name : m.lamp_name));
        break;
      case Grouping::one:
        name = "all-lights";
        break;
    }
    const auto [at, added] = known.try_emplace(name, Id<LightGroup>(scene.groups.size()));
    if (added) scene.groups.push_back({name});
    *m.group = at->second;
  }
}

}  // namespace sconce
