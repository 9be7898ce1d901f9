// SPDX-License-Identifier: Apache-2.0
#include "import/mtl_filter.h"

#include <assimp/MemoryIOWrapper.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <sstream>

#include "core/error.h"
#include "core/files.h"
#include "core/text.h"

namespace sconce {

namespace {

/// @param inside  of a material
bool kept(const std::string& line, bool& inside) {
  std::istringstream words(line);
  std::string keyword, word;
  words >> keyword;
  keyword = lower(keyword);
  const bool begins = keyword == "newmtl" && words >> word;
  inside |= begins;
  if (!inside) return false;  // assimp writes into the material that is not there
  if (begins || keyword == "map_kd" || keyword == "map_ke" || keyword == "map_d") return true;
  const bool color = keyword == "kd" || keyword == "ke";
  if (!color && keyword != "d" && keyword != "tr") return false;
  int numbers = 0;
  while (words >> word && word[0] != '#') {
    if (!parse_number(word)) return false;
    ++numbers;
  }
  return numbers == (color ? 3 : 1);
}

}  // namespace

std::string filtered_mtl(std::string text) {
  for (char& c : text)
    if (c == '\r' || c == '\0') c = '\n';  // lines end there for assimp
  std::string out;
  std::istringstream lines(text);
  bool inside = false;
  for (std::string line; std::getline(lines, line);)
    if (kept(line, inside)) out += trim(line) + "\n";
  return out;
}

Assimp::IOStream* MtlFilter::Open(const char* file, const char* mode) {
  if (lower(std::filesystem::path(file).extension().string()) != ".mtl")
    return DefaultIOSystem::Open(file, mode);
  std::string text;
  try {
    text = filtered_mtl(read_file(file));
  } catch (const Error&) {
    return nullptr;  // a warning has named it
  }
  auto* bytes = new uint8_t[text.size() + 1];
  std::memcpy(bytes, text.c_str(), text.size() + 1);
  return new Assimp::MemoryIOStream(bytes, text.size(), true);
}

}  // namespace sconce
