// SPDX-License-Identifier: Apache-2.0
// Every encoding, in every tier, mixed both ways, against the CPU's decoding of the same codes.
#include "gpu/mix.h"

#include <random>

#include "core/error.h"
#include "gpu/test_context.h"
#include "mix/test_layers.h"

namespace sconce::gpu {
namespace {

constexpr int kWidth = 20, kHeight = 12;  // bc6h: whole blocks

/// Light that falls off over 1:400,000, coloured, smooth.
Image layer(std::size_t g, int page) {
  Image image = Image::rgb(kWidth, kHeight);
  std::mt19937 random(static_cast<unsigned>(10 * g) + static_cast<unsigned>(page));
  std::uniform_real_distribution<float> vary(0.8f, 1);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const float e = 4000 * std::exp2(-18.6f * static_cast<float>(x + y) / (kWidth + kHeight - 2));
      image.set_rgb(x, y, {e * vary(random), 0.5f * e * vary(random), 0.3f * e * vary(random)});
    }
  return image;
}

EncodedLayers layers_of(const std::vector<EncodingChoice>& choices, int pages) {
  std::vector<Rgb> colors;
  for (std::size_t g = 0; g < choices.size(); ++g)
    colors.emplace_back(1.5f, 0.9f, 0.4f + 0.1f * static_cast<float>(g));
  return encode_layers(choices, pages, colors, layer);
}

std::vector<Rgb> weights_of(std::size_t groups) {
  std::vector<Rgb> weights;
  for (std::size_t g = 0; g < groups; ++g)
    weights.push_back(g == 1 ? Rgb(0)
                             : Rgb(1.0f / static_cast<float>(g + 1), 0.7f, 0.1f * static_cast<float>(g % 8)));
  return weights;
}

/// Relative to each value, but for rounding at the foot of the brightest.
void expect_near(const Image& mixed, const Image& expected, float relative) {
  for (std::size_t i = 0; i < expected.data.size(); ++i)
    ASSERT_NEAR(mixed.data[i], expected.data[i], relative * expected.data[i] + 1e-7f * 4000) << i;
}

class Mixing : public GlTest {
 protected:
  static constexpr int kScale = 4;  // places at whole 1/256 of a texel, as hardware filters know them
  /// The light source at places between texel centres of all pages.
  Image look(const LightSource& light, int page) const {
    const Program program(
        "look", whole_target_vertex(),
        "#version 450 core\n" + light.glsl() +
            "uniform int page;\nuniform vec2 size;\nuniform vec3 offset;\nout vec4 color;\nvoid main() {\n"
            "  color = vec4(illuminance(gl_FragCoord.xy / size, page, offset), 1.0);\n}\n");
    const Texture out(context_, {.width = kScale * kWidth, .height = kScale * kHeight}, "look");
    const Framebuffer target(out, 0);
    light.bind(program, 1);
    program.set("page", page);
    program.set("size", Vec2(kScale * kWidth, kScale * kHeight));
    return draw(program, target, out);
  }
  Image draw(const Program& program, const Framebuffer& target, const Texture& out) const {
    GLuint nothing = 0;
    glCreateVertexArrays(1, &nothing);
    glBindVertexArray(nothing);
    program.use();
    target.use();
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDeleteVertexArrays(1, &nothing);
    Image image = Image::rgb(out.params().width, out.params().height);
    target.read(GL_RGB, GL_FLOAT, image.data.data());
    context_.check("looking");
    return image;
  }
  static Image bilinear(const Image& page) {
    Image out = Image::rgb(kScale * page.width, kScale * page.height);
    for (int y = 0; y < out.height; ++y)
      for (int x = 0; x < out.width; ++x) {
        const auto place = [&](int at, int size, int* low) {
          const float p = std::clamp((static_cast<float>(at) + 0.5f) / static_cast<float>(kScale) - 0.5f,
                                     0.0f, static_cast<float>(size - 1));
          *low = std::min(static_cast<int>(p), size - 2);
          return p - static_cast<float>(*low);
        };
        int x0 = 0, y0 = 0;
        const float fx = place(x, page.width, &x0), fy = place(y, page.height, &y0);
        const Rgb a = (1 - fx) * page.rgb_at(x0, y0) + fx * page.rgb_at(x0 + 1, y0);
        const Rgb b = (1 - fx) * page.rgb_at(x0, y0 + 1) + fx * page.rgb_at(x0 + 1, y0 + 1);
        out.set_rgb(x, y, (1 - fy) * a + fy * b);
      }
    return out;
  }
  /// Both ways, both forms, in every tier.
  void expect_right(const std::vector<EncodingChoice>& choices, int pages) {
    const std::vector<Rgb> weights = weights_of(choices.size());
    for (const ShaderTier& tier : shader_tiers()) {
      SCOPED_TRACE(tier.name);
      const EncodedLayers layers = for_tier(layers_of(choices, pages), tier);
      const std::vector<Image> expected = plain_mix(layers, weights);
      PixelMix pixel(context_, layers, tier);
      pixel.set(weights);
      for (int page = 0; page < pages; ++page)
        expect_near(look(pixel, page), bilinear(expected[static_cast<std::size_t>(page)]), 1e-3f);
      if (!tier.f16) {
        EXPECT_THROW(AtlasMix(context_, layers, tier), Error);
        continue;
      }
      for (const auto form : {AtlasMix::Form::fragment, AtlasMix::Form::compute}) {
        const AtlasMix atlas(context_, layers, tier, form);
        atlas.mix(weights);
        const std::vector<Image> mixed = atlas.read();
        for (std::size_t page = 0; page < mixed.size(); ++page) {
          expect_near(mixed[page], expected[page], 1e-3f);
          expect_near(look(atlas, static_cast<int>(page)), bilinear(expected[page]), 2e-3f);
        }
      }
    }
  }
};

class EveryEncoding : public Mixing, public testing::WithParamInterface<const char*> {};

TEST_P(EveryEncoding, EqualsTheCpu) {
  expect_right(std::vector<EncodingChoice>(5, parse_encoding(GetParam())), 2);
}

INSTANTIATE_TEST_SUITE_P(All, EveryEncoding,
                         testing::Values("f32", "f16", "exp8", "rgbe8", "srgbe8", "multi8", "bc6h", "lum:f32",
                                         "lum:f16", "lum:exp8", "lum:multi8"),
                         [](const auto& name) {
                           std::string text = name.param;
                           std::replace(text.begin(), text.end(), ':', '_');
                           return text;
                         });

TEST_F(Mixing, AllEncodingsTogether) {
  std::vector<EncodingChoice> choices;
  for (const char* name : {"f16", "lum:f16", "exp8", "lum:exp8", "rgbe8", "lum:f16", "multi8", "bc6h"})
    choices.push_back(parse_encoding(name));
  expect_right(choices, 1);
}

// Beyond the texture units: arrays. Beyond the arrays' slices: several passes, which give the same.
TEST_F(Mixing, ManyLayersOnASmallDevice) {
  const std::vector<Rgb> weights = weights_of(40);
  const EncodedLayers layers = layers_of(std::vector<EncodingChoice>(40, parse_encoding("f16")), 2);
  const std::vector<Image> expected = plain_mix(layers, weights);
  const ShaderTier& full = find_shader_tier("full");
  Capabilities small = context_.capabilities();
  small.max_units = 16;
  small.max_array_layers = 26;
  small.software = false;  // computes only where one shader can read all
  context_.pretend(small);
  const AtlasMix atlas(context_, layers, full);
  EXPECT_EQ(atlas.passes(), 4u);  // 80 slices; pages of 12 plain textures would be 4, too
  atlas.mix(weights);
  const std::vector<Image> mixed = atlas.read();
  for (std::size_t page = 0; page < mixed.size(); ++page) expect_near(mixed[page], expected[page], 1e-3f);
  EXPECT_THROW(PixelMix(context_, layers, full), Error);
  EXPECT_THROW(AtlasMix(context_, layers, full, AtlasMix::Form::compute), Error);
  small.max_array_layers = 1;
  context_.pretend(small);
  EXPECT_THROW(PixelMix(context_, layers, full), Error);
}

TEST_F(Mixing, TierOfADevice) {
  Capabilities can = context_.capabilities();
  EXPECT_EQ(tier_of(can).name, "full");
  can.float_linear = false;
  EXPECT_EQ(tier_of(can).name, "half");
}

}  // namespace
}  // namespace sconce::gpu
