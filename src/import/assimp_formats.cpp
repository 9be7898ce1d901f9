// SPDX-License-Identifier: Apache-2.0
// Formats that assimp reads and that need no care of ours but for units and axes.
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "core/error.h"
#include "core/text.h"
#include "import/assimp_materials.h"
#include "import/assimp_scene.h"
#include "import/import.h"

namespace fs = std::filesystem;

namespace sconce {

namespace {

struct AssimpFormat {
  std::string_view ending, name;
  bool has_units;  ///< else metres, with a warning
};
constexpr AssimpFormat kFormats[] = {
    {".3ds", "3DS", false}, {".fbx", "FBX", true},  {".dae", "COLLADA", true},
    {".ply", "PLY", false}, {".stl", "STL", false},
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

}  // namespace

Scene import_assimp(const fs::path& path, const Progress& progress) {
  const AssimpFormat& format = format_of(path);
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);
  const aiScene& read = run_assimp(importer, path, format.name, aiProcess_GlobalScale);
  if (!format.has_units)
    progress.warn(path.string() + ": " + std::string(format.name) + " has no units; [scene] of the side file gives them, else they are metres");
  return read_assimp(read, path, upright(read), progress);
}

std::vector<fs::path> assimp_files(const fs::path& path) {
  const AssimpFormat& format = format_of(path);
  Assimp::Importer importer;
  return texture_files(path, run_assimp(importer, path, format.name));
}

}  // namespace sconce
