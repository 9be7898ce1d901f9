// SPDX-License-Identifier: Apache-2.0
// Every tone curve's shader twin against the curve, computed and looked up.
#include <fmt/format.h>

#include "gpu/test_context.h"
#include "tone/apply.h"
#include "tone/lut.h"
#include "tone/test_colors.h"

namespace sconce::gpu {
namespace {

class ToneTwins : public GlTest {
 protected:
  void expect_equal(const std::vector<Rgb>& shown, const ToneMapper& mapper, const Exposure& exposure,
                    float allowed) const {
    SCOPED_TRACE(fmt::format("{} maximum {:g}", mapper.name, exposure.params.maximum));
    for (std::size_t i = 0; i < colors_.size(); ++i) {
      const Rgb expected = tone_map(colors_[i], exposure, mapper);
      for (const auto channel : {&Rgb::r, &Rgb::g, &Rgb::b})
        ASSERT_NEAR(shown[i].*channel, expected.*channel, allowed)
            << colors_[i].r << ' ' << colors_[i].g << ' ' << colors_[i].b;
    }
  }
  static std::string shader(const std::string& functions, const ToneParams& p) {
    return functions +
           fmt::format(
               "vec3 apply(vec3 c) {{ return linear_to_srgb(tone_map(c, ToneParams({:e}, {:e}, {:e}))); }}",
               p.maximum, p.adaptation, p.drago_bias);
  }
  std::vector<Rgb> colors_ = test_colors();
};

TEST_F(ToneTwins, ComputeTheCurves) {
  for (const ToneMapper& mapper : tone_mappers())
    for (const float maximum : {1e-4f, 1e5f}) {
      Exposure exposure;
      exposure.params.maximum = maximum;
      expect_equal(apply(shader(tone_glsl(mapper), exposure.params), colors_), mapper, exposure, 0.1f / 255);
    }
}

TEST_F(ToneTwins, LookTheCurvesUp) {
  for (const ToneMapper& mapper : tone_mappers()) {
    if (mapper.curve == nullptr) continue;
    for (const float maximum : {0.5f, 1e5f}) {
      Exposure exposure;
      exposure.params.maximum = maximum;
      const ToneLut lut = make_tone_lut(mapper, exposure.params);
      const Texture table(context_, {.format = GL_R32F, .width = static_cast<int>(lut.values.size())},
                          "table");
      table.upload(GL_RED, GL_FLOAT, lut.values.data());
      table.bind(1);
      expect_equal(apply(shader(tone_glsl(lut), exposure.params), colors_, {{"tone_lut", 1}}), mapper,
                   exposure, 0.5f / 255);
    }
  }
}

}  // namespace
}  // namespace sconce::gpu
