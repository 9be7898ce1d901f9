// SPDX-License-Identifier: Apache-2.0
#include "import/obj_files.h"

#include <set>
#include <sstream>

#include "core/error.h"
#include "core/files.h"
#include "core/text.h"
#include "import/assimp_materials.h"
#include "import/uri.h"

namespace fs = std::filesystem;

namespace sconce {

namespace {

/// What follows `keyword` on the lines that begin with it.
std::vector<std::string> statements(const fs::path& file, std::string_view keyword) {
  std::vector<std::string> out;
  std::istringstream lines(read_file(file));
  for (std::string line; std::getline(lines, line);) {
    line = trim(line);
    if (line.size() > keyword.size() && lower(line.substr(0, keyword.size())) == keyword &&
        std::isspace(static_cast<unsigned char>(line[keyword.size()])))
      out.push_back(trim(line.substr(keyword.size())));
  }
  return out;
}

}  // namespace

std::vector<fs::path> mtl_files(const fs::path& obj) {
  std::vector<fs::path> out;
  for (const std::string& name : statements(obj, "mtllib")) out.push_back(find_beside(obj, name));
  return out;
}

std::vector<fs::path> obj_files(const fs::path& obj) {
  if (lower(obj.extension().string()) != ".obj") throw NotMyFormat(obj.string(), "is no OBJ file");
  std::set<fs::path> out;
  for (const fs::path& mtl : mtl_files(obj)) {
    if (!is_file(mtl)) continue;
    out.insert(mtl);
    for (const char* key : {"map_kd", "map_ke", "map_d"})
      for (const std::string& value : statements(mtl, key)) {
        // Options stand before the name, which may hold spaces: the longest tail that is a file.
        for (std::size_t at = 0; at != std::string::npos; at = value.find(' ', at + 1)) {
          const fs::path file = find_beside(obj, trim(value.substr(at)));
          if (!is_file(file)) continue;
          out.insert(file);
          break;
        }
      }
  }
  return {out.begin(), out.end()};
}

}  // namespace sconce
