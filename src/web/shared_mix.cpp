// SPDX-License-Identifier: Apache-2.0
#include "web/shared_mix.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/text.h"
#include "mix/settings.h"
#include "tone/tone.h"

namespace sconce::web {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kLongest = 200;  // of a text

const std::string& text_of(const std::string& key, const Json& value) {
  const auto* text = value.get_ptr<const std::string*>();
  if (text == nullptr || text->size() > kLongest)
    throw UsageError("'" + key + "'", "is no text", "up to 200 characters");
  return *text;
}

void check_number(const std::string& key, const std::string& text) {
  if (!parse_number(text)) throw UsageError("'" + key + "'", "'" + text + "' is no number");
}

}  // namespace

SharedMix::SharedMix(std::vector<GroupInfo> groups, const Preset& start)
    : groups_(std::move(groups)), settings_(groups_.size(), start.others.empty() ? "on" : start.others) {
  make_mix(groups_, start.assignments, start.others, {});
  for (std::size_t g = 0; g < groups_.size(); ++g)
    for (const std::string& assignment : start.assignments) {
      const std::size_t equals = assignment.rfind('=');
      if (glob_match(assignment.substr(0, equals), groups_[g].name))
        settings_[g] = assignment.substr(equals + 1);
    }
  if (!start.exposure.empty()) exposure_ = start.exposure;
  if (!start.ev100.empty()) ev100_ = start.ev100, exposure_.clear();
  if (!start.tone.empty()) tone_ = start.tone;
  check();
}

std::vector<std::string> SharedMix::assignments() const {
  std::vector<std::string> out;
  for (std::size_t g = 0; g < groups_.size(); ++g)
    out.push_back("\"" + groups_[g].name + "\"=" + settings_[g]);
  return out;
}

void SharedMix::check() const {
  make_mix(groups_, assignments(), {}, {});
  find_tone_mapper(tone_);
  if (!ev100_.empty()) check_number("ev100", ev100_);
  if (!exposure_.empty() && exposure_ != "auto") check_number("exposure", exposure_);
}

std::string SharedMix::json() const {
  Json settings = Json::object(), weights = Json::object();
  const MixSpec mix = make_mix(groups_, assignments(), {}, {});
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const Rgb& w = mix.weights[g];
    settings[groups_[g].name] = settings_[g];
    weights[groups_[g].name] = {w.r, w.g, w.b};
  }
  const Json out = {{"settings", settings}, {"exposure", exposure_}, {"ev100", ev100_},
                    {"tone", tone_},        {"from", from_},         {"weights", weights}};
  return out.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void SharedMix::change(std::string_view text) {
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object())
    throw UsageError({}, "the mix is no JSON object", R"({"settings": {"GROUP": "SETTING"}})");
  SharedMix next = *this;
  next.from_.clear();
  for (const auto& [key, value] : json.items()) {
    if (key == "settings") {
      if (!value.is_object()) throw UsageError("'settings'", "is no object", R"({"GROUP": "SETTING"})");
      for (const auto& [name, setting] : value.items()) {
        const auto group =
            std::find_if(groups_.begin(), groups_.end(), [&](const GroupInfo& g) { return g.name == name; });
        std::vector<std::string> names;
        for (const GroupInfo& g : groups_) names.push_back(g.name);
        if (group == groups_.end())
          throw UsageError({}, "unknown light group '" + name + "'" + did_you_mean(name, names),
                           join(names, ", "));
        next.settings_[static_cast<std::size_t>(group - groups_.begin())] = text_of(name, setting);
      }
    } else if (key == "exposure" || key == "ev100") {
      const std::string& asked = text_of(key, value);
      if (asked.empty()) continue;
      next.exposure_ = key == "exposure" ? asked : "";
      next.ev100_ = key == "ev100" ? asked : "";
    } else if (key == "tone" || key == "from") {
      (key == "tone" ? next.tone_ : next.from_) = text_of(key, value);
    } else if (key != "weights") {  // of what was read before
      throw UsageError({}, "unknown key '" + key + "'", "settings, exposure, ev100, tone, from");
    }
  }
  next.check();
  *this = std::move(next);
}

}  // namespace sconce::web
