// SPDX-License-Identifier: Apache-2.0
#include "core/error.h"
#include "core/text.h"
#include "mix/settings.h"

namespace sconce {

namespace {

/// The two sides of "GROUP=SETTING".
struct Assignment {
  std::string group, setting;
  bool literal = false;  ///< quoted: no glob, not the word `all`
};

Assignment parse_assignment(const std::string& text) {
  const auto fail = [&] { throw UsageError({}, "'" + text + "' is no group setting", "GROUP=SETTING"); };
  if (!text.empty() && (text[0] == '"' || text[0] == '\'')) {
    const std::size_t close = text.rfind(text[0]);
    if (close == 0 || close + 1 >= text.size() || text[close + 1] != '=') fail();
    return {text.substr(1, close - 1), text.substr(close + 2), true};
  }
  const std::size_t equals = text.rfind('=');  // settings hold none, names may
  if (equals == std::string::npos || equals == 0) fail();
  return {text.substr(0, equals), text.substr(equals + 1), false};
}

std::vector<std::size_t> find_groups(std::span<const GroupInfo> groups, const Assignment& a) {
  std::vector<std::size_t> found;
  for (std::size_t g = 0; g < groups.size(); ++g)
    if (groups[g].name == a.group) found.push_back(g);
  if (!found.empty() || a.literal) return found;
  for (std::size_t g = 0; g < groups.size(); ++g)
    if (a.group == "all" || glob_match(a.group, groups[g].name)) found.push_back(g);
  return found;
}

[[noreturn]] void fail_unknown(std::span<const GroupInfo> groups, const std::string& wrong) {
  std::vector<std::string> names;
  for (const GroupInfo& group : groups) names.push_back(group.name);
  throw UsageError({}, "unknown light group '" + wrong + "'" + did_you_mean(wrong, names),
                   names.empty() ? "none: there is no light group" : join(names, ", "));
}

}  // namespace

bool names_group(std::span<const GroupInfo> groups, const std::string& assignment, std::string_view name) {
  for (const std::size_t g : find_groups(groups, parse_assignment(assignment)))
    if (groups[g].name == name) return true;
  return false;
}

MixSpec make_mix(std::span<const GroupInfo> groups, std::span<const std::string> assignments,
                 std::string_view others, const std::function<void(const std::string&)>& warn) {
  std::vector<std::optional<GroupSetting>> settings(groups.size());
  for (const std::string& text : assignments) {
    const Assignment assignment = parse_assignment(text);
    const GroupSetting setting = parse_setting(assignment.setting);
    const std::vector<std::size_t> found = find_groups(groups, assignment);
    if (found.empty()) fail_unknown(groups, assignment.group);
    for (const std::size_t g : found) settings[g] = setting;
  }
  const GroupSetting rest = others.empty() ? GroupSetting{} : parse_setting(others);
  MixSpec mix;
  for (std::size_t g = 0; g < groups.size(); ++g)
    mix.weights.push_back(group_weight(groups[g], settings[g].value_or(rest), warn));
  return mix;
}

}  // namespace sconce
