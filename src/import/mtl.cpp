// SPDX-License-Identifier: Apache-2.0
#include "import/mtl.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/error.h"
#include "core/files.h"
#include "core/text.h"
#include "import/obj_text.h"
#include "import/uri.h"

namespace fs = std::filesystem;

namespace sconce {

namespace {

/// All of what is left, as finite numbers; empty where something is none.
std::vector<float> numbers(std::string_view rest) {
  std::vector<float> out;
  for (std::string_view word = take_word(rest); !word.empty(); word = take_word(rest)) {
    const auto value = parse_number(word);
    if (!value || std::abs(*value) > 1e30) return {};
    out.push_back(static_cast<float>(*value));
  }
  return out;
}

void set_color(std::string_view rest, Rgb& color) {
  const std::vector<float> v = numbers(rest);
  if (v.size() == 1) color = Rgb(v[0]);
  if (v.size() == 3) color = {v[0], v[1], v[2]};
}

/// Options that stand before a map's file, and how many words follow each.
struct MapOption {
  std::string_view name;
  int words;
  bool fewer;  ///< of numbers, the last ones may be missing
};
constexpr MapOption kMapOptions[] = {{"-blendu", 1, false},  {"-blendv", 1, false}, {"-bm", 1, false},
                                     {"-boost", 1, false},   {"-cc", 1, false},     {"-clamp", 1, false},
                                     {"-imfchan", 1, false}, {"-mm", 2, false},     {"-o", 3, true},
                                     {"-s", 3, true},        {"-t", 3, true},       {"-texres", 1, false},
                                     {"-type", 1, false}};

PlainMaterial::Map map_of(std::string_view rest) {
  PlainMaterial::Map map;
  while (true) {
    std::string_view behind = rest;
    const std::string name = lower(take_word(behind));
    const auto* option = std::find_if(std::begin(kMapOptions), std::end(kMapOptions),
                                      [&](const MapOption& o) { return o.name == name; });
    if (option == std::end(kMapOptions)) break;
    for (int i = 0; i < option->words; ++i) {
      std::string_view after = behind;
      const std::string_view word = take_word(after);
      if (option->fewer && !parse_number(word)) break;
      if (name == "-clamp") map.clamped = lower(word) == "on";
      behind = after;
    }
    rest = behind;
  }
  map.file = trim(rest);  // the rest of the line: names hold blanks
  return map;
}

}  // namespace

std::vector<PlainMaterial> parse_mtl(std::string text) {
  std::vector<PlainMaterial> out;
  std::map<std::string, std::size_t, std::less<>> known;
  PlainMaterial* m = nullptr;
  ObjText lines(std::move(text));
  for (ObjStatement s; lines.next(s);) {
    const std::string keyword = lower(s.keyword);
    if (keyword == "newmtl") {
      m = nullptr;
      if (s.rest.empty()) continue;
      const auto [at, is_new] = known.try_emplace(std::string(s.rest), out.size());
      if (is_new) out.push_back({at->first, kUnsaidDiffuse, Rgb(0), 1, {}, {}, {}});
      m = &out[at->second];
    }
    if (m == nullptr) continue;
    if (keyword == "kd") set_color(s.rest, m->diffuse);
    if (keyword == "ke") set_color(s.rest, m->emissive);
    if (keyword == "map_kd") m->diffuse_map = map_of(s.rest);
    if (keyword == "map_ke") m->emissive_map = map_of(s.rest);
    if (keyword == "map_d") m->opacity_map = map_of(s.rest);
    if (keyword != "d" && keyword != "tr") continue;
    const std::vector<float> v = numbers(s.rest);
    if (v.size() == 1) m->opacity = keyword == "d" ? v[0] : 1 - v[0];
  }
  return out;
}

std::vector<fs::path> mtl_files(const fs::path& obj) {
  std::vector<fs::path> out;
  ObjText lines(read_file(obj));
  for (ObjStatement s; lines.next(s);) {
    if (s.keyword != "mtllib" || s.rest.empty()) continue;
    // One name with blanks, or several without.
    const fs::path whole = find_beside(obj, std::string(s.rest));
    std::vector<fs::path> several;
    for (std::string_view word = take_word(s.rest); !word.empty(); word = take_word(s.rest))
      several.push_back(find_beside(obj, std::string(word)));
    if (is_file(whole) || std::none_of(several.begin(), several.end(), is_file)) several = {whole};
    out.insert(out.end(), several.begin(), several.end());
  }
  return out;
}

std::vector<fs::path> obj_files(const fs::path& obj) {
  if (lower(obj.extension().string()) != ".obj") throw NotMyFormat(obj.string(), "is no OBJ file");
  std::set<fs::path> out;
  for (const fs::path& mtl : mtl_files(obj)) {
    if (!is_file(mtl)) continue;
    out.insert(mtl);
    for (const PlainMaterial& m : parse_mtl(read_file(mtl)))
      for (const PlainMaterial::Map* map : {&m.diffuse_map, &m.emissive_map, &m.opacity_map})
        if (const fs::path file = find_beside(obj, map->file); !map->file.empty() && is_file(file))
          out.insert(file);
  }
  return {out.begin(), out.end()};
}

}  // namespace sconce
