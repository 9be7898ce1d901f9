// SPDX-License-Identifier: Apache-2.0
// OBJ + MTL through assimp.
#include <assimp/config.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>

#include "core/error.h"
#include "core/text.h"
#include "import/assimp_scene.h"
#include "import/import.h"
#include "import/mtl_filter.h"
#include "import/obj_files.h"

namespace sconce {

Scene import_obj(const std::filesystem::path& path, const Progress& progress) {
  if (lower(path.extension().string()) != ".obj") throw NotMyFormat(path.string(), "is no OBJ file");
  for (const std::filesystem::path& mtl : mtl_files(path)) {
    std::error_code ec;
    if (!std::filesystem::exists(mtl, ec))
      progress.warn(path.string() + ": material file " + mtl.string() + " is missing; grey is used");
  }
  Assimp::Importer importer;
  importer.SetIOHandler(new MtlFilter);  // the importer owns it
  return read_assimp(run_assimp(importer, path, "OBJ"), path, Mat4(1), progress);
}

}  // namespace sconce
