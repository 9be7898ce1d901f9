// SPDX-License-Identifier: Apache-2.0
#include "session/search.h"

#include <algorithm>
#include <map>

#include "core/text.h"

namespace sconce {

namespace {

bool holds(const std::string& name, const std::vector<std::string>& words) {
  return std::all_of(words.begin(), words.end(),
                     [&](const std::string& word) { return name.find(word) != std::string::npos; });
}

std::string first_word(const std::string& name) {
  return name.substr(0, name.find_first_of(" _.-0123456789"));
}

}  // namespace

std::vector<FaderFolder> fader_folders(std::span<const std::string> names, std::string_view search) {
  std::vector<std::string> words = split(lower(search), ' ');
  std::erase(words, "");
  std::map<std::string, int> alike;
  if (names.size() > kMany)
    for (const std::string& name : names) ++alike[first_word(name)];
  std::vector<FaderFolder> folders;
  for (std::size_t g = 0; g < names.size(); ++g) {
    if (!holds(lower(names[g]), words)) continue;
    const std::size_t slash = names[g].find('/');
    std::string folder = slash == std::string::npos ? "" : names[g].substr(0, slash);
    if (const std::string word = first_word(names[g]); folder.empty() && !word.empty())
      if (const auto found = alike.find(word); found != alike.end() && found->second >= 3) folder = word;
    auto place = std::find_if(folders.begin(), folders.end(),
                              [&](const FaderFolder& f) { return !folder.empty() && f.name == folder; });
    if (place == folders.end()) {
      if (folder.empty() && !folders.empty() && folders.back().name.empty())
        place = folders.end() - 1;
      else
        place = folders.insert(folders.end(), {folder, {}});
    }
    place->groups.push_back(g);
  }
  return folders;
}

}  // namespace sconce
