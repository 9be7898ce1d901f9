// SPDX-License-Identifier: Apache-2.0
// glTF, as text and as GLB, through the importer.
#include "fuzz.h"
#include "import/import.h"
#include "scene/validate.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  using namespace sconce;
  static fuzz::File text("scene.gltf"), binary("scene.glb");
  const std::string_view bytes = fuzz::text(data, size);
  const std::filesystem::path& path = (bytes.starts_with("glTF") ? binary : text).hold(bytes);
  return fuzz::answers([&] {
    Scene scene = import_gltf(path);
    validate(scene);
  });
}
