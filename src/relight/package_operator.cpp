// SPDX-License-Identifier: Apache-2.0
#include "relight/package_operator.h"

#include <algorithm>

#include "core/error.h"
#include "core/text.h"
#include "package/manifest.h"
#include "relight/precompute.h"

namespace fs = std::filesystem;

namespace sconce {

fs::path operator_path(const fs::path& package, const std::string& camera) {
  return package / kOperatorFolder /
         (camera.empty() ? "lightmap.bin" : "camera-" + safe_file_name(camera) + ".bin");
}

fs::path lobes_path(const fs::path& package, const std::string& camera) {
  return package / kOperatorFolder / ("camera-" + safe_file_name(camera) + ".lobes.bin");
}

std::optional<Operator> find_lobes(const Package& package, const Operator& op) {
  const fs::path path = lobes_path(package.path(), op.camera);
  std::error_code ec;
  if (op.kind != OperatorReceivers::pixels || !fs::exists(path, ec)) return std::nullopt;
  Operator lobes = open_operator(path);
  const auto same = [](const OperatorPoint& a, const OperatorPoint& b) {
    return a.position == b.position && a.albedo == b.albedo;
  };
  if (lobes.kind != OperatorReceivers::lobes || lobes.scene != op.scene || lobes.width != op.width ||
      lobes.height != op.height ||
      !std::equal(lobes.lit.begin(), lobes.lit.end(), op.lit.begin(), op.lit.end(), same))
    throw Error(path.string(), "belongs to another operator: 'sconce transfer' makes both");
  return lobes;
}

bool has_operator(const Package& package, const std::string& camera) {
  try {
    find_operator(package, camera);
    return true;
  } catch (const Error&) {
    return false;
  }
}

Operator find_operator(const Package& package, const std::string& camera) {
  const fs::path path = operator_path(package.path(), camera);
  std::error_code ec;
  if (!fs::exists(path, ec)) {
    std::vector<std::string> there;
    for (const auto& entry : fs::directory_iterator(package.path() / kOperatorFolder, ec))
      if (entry.path().extension() == ".bin") there.push_back(entry.path().stem().string());
    std::sort(there.begin(), there.end());
    throw Error(path.string(),
                "no such operator: 'sconce transfer' makes it, 'sconce bake --movable' the lightmap's",
                there.empty() ? "" : join(there, ", "));
  }
  Operator op = open_operator(path);
  if (op.scene != operator_scene(package))
    throw Error(path.string(), "belongs to another state of this package: 'sconce transfer' makes it anew");
  return op;
}

}  // namespace sconce
