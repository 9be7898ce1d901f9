// SPDX-License-Identifier: Apache-2.0
// Formats that assimp reads and that need no care of ours but for units and axes.
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <assimp/Importer.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "core/error.h"
#include "core/text.h"
#include "import/assimp_materials.h"
#include "import/assimp_scene.h"
#include "import/import.h"
#include "import/side_table.h"

namespace fs = std::filesystem;

namespace sconce {

namespace {

struct AssimpFormat {
  std::string_view ending, name;
  bool has_units;      ///< else metres, with a warning
  bool has_materials;  ///< else white is assimp's word, and grey is used
};
constexpr AssimpFormat kFormats[] = {
    {".3ds", "3DS", false, true},  {".fbx", "FBX", true, true},   {".dae", "COLLADA", true, true},
    {".ply", "PLY", false, false}, {".stl", "STL", false, false},
};

const AssimpFormat& format_of(const fs::path& path) {
  const std::string ending = lower(path.extension().string());
  for (const AssimpFormat& format : kFormats)
    if (format.ending == ending) return format;
  throw NotMyFormat(path.string(), "is no 3DS, FBX, COLLADA, PLY or STL file");
}

/// FBX says which axis is up; assimp leaves it at that. COLLADA's and 3DS' it turns itself.
Mat4 upright(const aiScene& read) {
  int32_t axis = 1, sign = 1;
  if (read.mMetaData == nullptr || !read.mMetaData->Get("UpAxis", axis)) return Mat4(1);
  read.mMetaData->Get("UpAxisSign", sign);
  const float turn = static_cast<float>(sign) * kPi / 2;
  if (axis == 2) return glm::rotate(Mat4(1), -turn, Vec3(1, 0, 0));
  if (axis == 0) return glm::rotate(Mat4(1), turn, Vec3(0, 0, 1));
  return Mat4(1);
}

/// Walls that lose no light would be the brightest there are.
void use_grey(Scene& scene) {
  for (Material& m : scene.materials)
    if (m.base_color == Rgb(1) && !m.base_color_texture.texture) m.base_color = kUnsaidDiffuse;
}

bool side_file_has_unit(const fs::path& path) {
  const auto side = side_file_of(path);
  if (!side) return false;
  const SideNode root = parse_side_file(*side);
  const SideNode* whole = root.find("scene");
  return whole != nullptr && whole->find("unit") != nullptr;
}

std::string assumed_metres(const fs::path& path, std::string_view format, const Scene& scene) {
  Bounds bounds;
  for (const Instance& instance : scene.instances)
    for (const Vec3& p : scene[instance.mesh].positions)
      bounds.add(Vec3(instance.transform * glm::vec4(p, 1)));
  const Vec3 size = bounds.empty() ? Vec3(0) : bounds.hi - bounds.lo;
  return fmt::format(
      "{}: {} has no units: its {:.4g} x {:.4g} x {:.4g} are taken as metres; [scene] unit in {} says "
      "otherwise (mm, cm, m, inch, foot)",
      path.string(), format, size.x, size.y, size.z,
      fs::path(path).replace_extension(".toml").filename().string());
}

}  // namespace

Scene import_assimp(const fs::path& path, const Progress& progress) {
  const AssimpFormat& format = format_of(path);
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);
  const aiScene& read = run_assimp(importer, path, format.name, aiProcess_GlobalScale);
  Scene scene = read_assimp(read, path, upright(read), progress);
  if (!format.has_materials) use_grey(scene);
  if (!format.has_units && !side_file_has_unit(path)) progress.warn(assumed_metres(path, format.name, scene));
  return scene;
}

std::vector<fs::path> assimp_files(const fs::path& path) {
  const AssimpFormat& format = format_of(path);
  Assimp::Importer importer;
  return texture_files(path, run_assimp(importer, path, format.name));
}

}  // namespace sconce
