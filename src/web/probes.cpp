// SPDX-License-Identifier: Apache-2.0
#include "package/points.h"
#include "web/parts.h"

namespace sconce::web {

Json write_probes(SiteFiles& files, const Package& package) {
  const std::optional<ProbeGrid> grid = read_probes(package);
  if (!grid) return nullptr;
  std::vector<float> values;
  for (const ProbeValue& value : grid->values)
    for (const Rgb& k : value)
      for (const float c : {k.r, k.g, k.b}) values.push_back(c);
  return {{"origin", {grid->origin.x, grid->origin.y, grid->origin.z}},
          {"spacing", grid->spacing},
          {"size", grid->size},
          {"valid", files.write_packed("probes-valid.bin", grid->valid)},
          {"values", files.write_packed("probes-values.bin", values, 12 * grid->groups)}};
}

}  // namespace sconce::web
