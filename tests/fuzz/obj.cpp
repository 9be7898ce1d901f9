// SPDX-License-Identifier: Apache-2.0
// OBJ, and MTL behind a line "#mtl", through the importer.
#include "fuzz.h"
#include "import/import.h"
#include "scene/validate.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  using namespace sconce;
  static fuzz::File obj("scene.obj"), mtl("scene.mtl");
  const std::string_view bytes = fuzz::text(data, size);
  const std::size_t at = bytes.find("#mtl\n");
  const std::string library = "mtllib " + mtl.hold(at < bytes.size() ? bytes.substr(at) : "").string() + "\n";
  const std::filesystem::path& path = obj.hold(library + std::string(bytes.substr(0, at)));
  return fuzz::answers([&] {
    Scene scene = import_obj(path);
    validate(scene);
  });
}
