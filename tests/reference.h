// SPDX-License-Identifier: Apache-2.0
// A package against path-traced references of its scene, group by group: the bar of contract.md, "Relative
// RMSE".
#pragma once

#include <fmt/format.h>

#include "image/io.h"
#include "image/metrics.h"
#include "picture/render.h"

namespace sconce::test {

struct GroupError {
  std::string group;
  double mean_ratio, rmse, noise;
};

/// What `render --camera main --others off GROUP=1 --tone linear` shows, against
/// FOLDER/SCENE.main.GROUP.s0.exr and s1.exr.
/// @param pictures  when not empty: error pictures go there
inline std::vector<GroupError> compare_to_references(const Package& package, const std::string& scene,
                                                     const std::filesystem::path& folder, int samples = 64,
                                                     const std::filesystem::path& pictures = {}) {
  std::vector<GroupError> result;
  const View view(package);
  const Camera camera = view.camera("main");
  for (const GroupInfo& group : package.manifest().groups) {
    const auto name = [&](int seed) {
      return folder / fmt::format("{}.main.{}.s{}.exr", scene, group.name, seed);
    };
    const Image s0 = read_exr(name(0)), s1 = read_exr(name(1));
    const std::vector<std::string> settings{group.name + "=1"};
    const MixSpec mix = make_mix(package.manifest().groups, settings, "off", {});
    PictureParams params;
    params.width = s0.width, params.height = s0.height, params.samples = samples;
    Image coverage;
    const Image picture = view.render(camera, mix, mix_pages(package, mix), params, {}, &coverage);
    const RelativeRmse error = relative_rmse(picture, s0, &s1, &coverage);
    result.push_back({group.name, error.mean_ratio, error.rmse, error.noise});
    if (!pictures.empty()) {
      write_png(pictures / fmt::format("{}.{}.error.png", scene, group.name),
                error_picture(picture, s0, &coverage, error.boxes));
      write_exr(pictures / fmt::format("{}.{}.exr", scene, group.name), picture, PixelType::full);
    }
  }
  return result;
}

}  // namespace sconce::test
