// SPDX-License-Identifier: Apache-2.0
#include "picture/fixed_function.h"

#include "core/error.h"
#include "mix/tone_lightmap.h"
#include "picture/test_pictures.h"

namespace sconce {
namespace {

class FixedFunction : public PictureTest {
 protected:
  void open(const PackageContents& contents) {
    PictureTest::open(contents, {std::vector<Rgb>(contents.manifest.groups.size(), Rgb(0.7f))});
  }
  Image8 draw(const Exposure& exposure, const ToneMapper& mapper) const {
    return to_codes(fixed_function(view_->hits(camera_, params_), mix_,
                                   tone_lightmap(pages_, exposure, mapper), exposure, mapper));
  }
};

TEST_F(FixedFunction, IsThePictureOfRaysInTheSameOrder) {
  for (const auto& [width, height] : {std::pair{16, 16}, {1, 3}, {3, 1}}) {
    open(lit_wall(width, height));
    const Exposure exposure = auto_exposure(0.6, 10);
    for (const ToneMapper& mapper : tone_mappers()) {
      const Image8 plain = plain_fixed_function(*view_, camera_, mix_, pages_, params_, exposure, mapper);
      EXPECT_GE(share_alike(draw(exposure, mapper), plain), 0.995) << mapper.name;
    }
  }
}

// 0.5 of albedo is code 188, 100 lux are code 200 of a white wall: 188 * 200 / 255.
TEST_F(FixedFunction, MultipliesCodes) {
  PackageContents c = test_package(1, 1, 4, 4);
  for (float& v : c.layers[0][0].data) v = 100 / 0.7f;
  open(c);
  Exposure exposure;
  exposure.scale = kPi / 100 * srgb_to_linear(200 / 255.0f);
  for (const unsigned char code : draw(exposure, find_tone_mapper("linear")).data) EXPECT_EQ(code, 147);
}

TEST_F(FixedFunction, OrderDoesNotMatterOnWhite) {
  PackageContents c = test_package(1, 1, 4, 4);
  c.scene.materials[0].base_color = Rgb(1);
  for (float& v : c.layers[0][0].data) v = 100;
  open(c);
  const Exposure exposure = auto_exposure(50, 200);
  for (const ToneMapper& mapper : tone_mappers())
    EXPECT_LE(largest_difference(draw(exposure, mapper),
                                 tone_map(view_->render(camera_, mix_, pages_, params_), exposure, mapper)),
              1)
        << mapper.name;
}

TEST_F(FixedFunction, OtherPagesAreRefused) {
  open(lit_wall(8, 8));
  const ToneMapper& agx = find_tone_mapper("agx");
  const CameraHits hits = view_->hits(camera_, params_);
  EXPECT_THROW(fixed_function(hits, mix_, {}, {}, agx), Error);
  EXPECT_THROW(fixed_function(hits, {{Rgb(1)}}, tone_lightmap(pages_, {}, agx), {}, agx), Error);
}

}  // namespace
}  // namespace sconce
