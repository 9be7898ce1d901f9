// SPDX-License-Identifier: Apache-2.0
// The software path on a real package: faders on cached camera hits, and hardware without shaders.
#include <gtest/gtest.h>

#include "mix/mixer.h"
#include "picture/show.h"
#include "picture/test_pictures.h"
#include "process.h"
#include "stage.h"

namespace sconce {
namespace {

TEST(Software, OurBathroomByEveryCurve) {
  const TemporaryFolder folder;
  const std::string path = (folder / "x.sconce").string();
  const auto outcome =
      test::run_sconce({"bake", std::string(SCONCE_SOURCE_DIR) + "/scenes/bathroom.glb", "-o", path,
                        "--atlas", "256", "--samples", "2", "--solver", "path", "--bounces", "1", "--quiet"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Package package = Package::open(path);
  const View view(package);
  const auto software = app::make_stage(package, "software");
  const PictureParams params{.width = 200, .height = 150, .samples = 1};
  Mixer mixer(package);
  for (const auto& [camera_name, assignment] : {std::pair{"", "all=1"}, {"shower", "window=off"}}) {
    const Camera camera = *find_camera(view.scene(), camera_name);
    const MixSpec mix = make_mix(package.manifest().groups, std::vector<std::string>{assignment}, "", {});
    const std::vector<Image> pages = mix_pages(package, mix);
    const Metering metering = meter(package, mix, pages);
    const Exposure exposure = auto_exposure(metering.log_mean, metering.maximum);
    const CameraHits hits = view.hits(camera, params);
    const Image linear = view.render(camera, mix, pages, params);
    software->draw(camera, mix, pages, params, {});
    for (const ToneMapper& mapper : tone_mappers()) {
      const Image8 expected = tone_map(linear, exposure, mapper);
      EXPECT_LE(largest_difference(show(hits, mix, mixer.mix(mix), ToneCodes(exposure, mapper)), expected), 1)
          << mapper.name;
      const Image8 drawn = software->toned(exposure, mapper);
      EXPECT_GE(share_alike(drawn, plain_fixed_function(view, camera, mix, pages, params, exposure, mapper)),
                0.995)
          << mapper.name;
      EXPECT_LT(share_alike(drawn, expected), 0.9) << mapper.name << ": the order matters";
    }
  }
}

}  // namespace
}  // namespace sconce
