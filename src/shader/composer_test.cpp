// SPDX-License-Identifier: Apache-2.0
// Composed shaders are compiled by the reference compiler, whatever they are composed of.
#include "shader/composer.h"

#include <gtest/gtest.h>

#include <functional>
#include <random>
#include <set>

#include "core/error.h"
#include "shader/test_glslang.h"

namespace sconce {
namespace {

using Form = ShaderSpec::Form;

/// Every encoding of colours and of luminance.
std::vector<EncodingChoice> kinds() {
  std::vector<EncodingChoice> all;
  for (const bool luminance : {false, true})
    for (const Encoding& e : encodings())
      if (!luminance || e.per_channel) all.push_back({&e, luminance});
  return all;
}

/// A texture per entry; luminances are full.
ShaderSpec spec_of(const std::vector<EncodingChoice>& textures, int pages = 1) {
  ShaderSpec spec;
  for (const EncodingChoice& choice : textures) {
    LayerTexture texture{
        choice, {}, std::vector<std::array<float, 4>>(static_cast<std::size_t>(pages), {1, 2, 3, 4})};
    for (int i = 0; i < (choice.luminance ? 4 : 1); ++i) texture.groups.push_back(spec.groups++);
    spec.textures.push_back(std::move(texture));
  }
  spec.pages = pages;
  spec.target = &find_shader_target("glsl450");
  spec.tier = &find_shader_tier("full");
  return spec;
}

/// The same for the basis sh1: a texture per coefficient.
ShaderSpec directional(ShaderSpec spec) {
  const std::vector<LayerTexture> flat = spec.textures;
  for (std::size_t c = 1; c < coefficients(Basis::sh1); ++c)
    for (LayerTexture texture : flat) {
      texture.coefficient = c;
      spec.textures.push_back(std::move(texture));
    }
  return spec;
}

/// Texts that differ, for glslangValidator.
class Shaders {
 public:
  /// In every tier; dialects, forms and curves take turns.
  void add(ShaderSpec spec) {
    for (const ShaderTier& tier : shader_tiers()) {
      spec.tier = &tier;
      const std::size_t turn = count_++;
      spec.target = &shader_targets()[turn % shader_targets().size()];
      spec.tone = turn % 9 == 8 ? nullptr : &tone_mappers()[turn % tone_mappers().size()];
      spec.form = turn % 5 == 4 ? Form::atlas : Form::picture;
      texts_.insert(compose(spec).text);
    }
  }

  void add_text(const std::string& text) { texts_.insert(text); }

  void expect_valid() const { expect_valid_glsl(texts_, "frag"); }
  std::size_t size() const { return texts_.size(); }

 private:
  std::set<std::string> texts_;
  std::size_t count_ = 0;
};

TEST(Composer, HomogeneousCounts) {
  Shaders shaders;
  for (const EncodingChoice& kind : kinds())
    for (std::size_t count = 1; count <= 32; ++count) shaders.add(spec_of(std::vector(count, kind)));
  EXPECT_GT(shaders.size(), 500u);
  shaders.expect_valid();
}

TEST(Composer, EveryMultisetOfUpToFour) {
  Shaders shaders;
  const std::vector<EncodingChoice> all = kinds();
  std::vector<std::size_t> chosen;
  const std::function<void(std::size_t)> choose = [&](std::size_t from) {
    std::vector<EncodingChoice> textures;
    for (const std::size_t i : chosen) textures.push_back(all[i]);
    if (!textures.empty()) shaders.add(spec_of(textures));
    if (chosen.size() == 4) return;
    for (std::size_t i = from; i < all.size(); ++i) {
      chosen.push_back(i);
      choose(i);
      chosen.pop_back();
    }
  };
  choose(0);
  EXPECT_GT(shaders.size(), 1364u);
  shaders.expect_valid();
}

TEST(Composer, RandomCombinations) {
  Shaders shaders;
  std::mt19937 random(5);
  const std::vector<EncodingChoice> all = kinds();
  for (int round = 0; round < 500; ++round) {
    std::vector<EncodingChoice> textures(1 + random() % 40);
    for (EncodingChoice& t : textures) t = all[random() % all.size()];
    shaders.add(spec_of(textures, 1 + static_cast<int>(random() % 5)));
  }
  shaders.expect_valid();
}

/// By formula and by table, each curve in each dialect.
TEST(Composer, EveryCurveInEveryDialect) {
  Shaders shaders;
  for (const ToneMapper& mapper : tone_mappers())
    for (const ShaderTarget& target : shader_targets()) {
      ShaderSpec spec = spec_of({parse_encoding("f16"), parse_encoding("exp8")});
      spec.target = &target;
      spec.tone = &mapper;
      shaders.add_text(compose(spec).text);
      if (mapper.curve == nullptr) continue;
      const ToneLut lut = make_tone_lut(mapper, {});
      spec.lut = &lut;
      shaders.add_text(compose(spec).text);
    }
  shaders.expect_valid();
}

TEST(Composer, FunctionsStandAlone) {
  ShaderSpec spec = spec_of({parse_encoding("lum:exp8"), parse_encoding("rgbe8")});
  spec.form = Form::functions;
  const std::string text = compose(spec).text;
  EXPECT_EQ(text.find("#version"), std::string::npos);
  EXPECT_EQ(text.find("void main"), std::string::npos);
  Shaders shaders;
  shaders.add_text("#version 330 core\n" + text +
                   "in vec2 uv; out vec3 lux; void main() { lux = sconce_illuminance(uv, 0); }\n");
  shaders.expect_valid();
}

/// Every signed encoding in every tier, plain and in arrays; what is uploaded for g is signed, too.
TEST(Composer, DirectionalBasis) {
  Shaders shaders;
  for (const char* name : {"f32", "f16", "srgbe8"})
    for (const std::size_t groups : {1u, 3u, 8u})
      for (const ShaderTier& tier : shader_tiers())
        for (const ShaderTarget& target : shader_targets()) {
          ShaderSpec spec = directional(spec_of(std::vector(groups, parse_encoding(name)), 2));
          spec.tier = &tier, spec.target = &target, spec.tone = &tone_mappers()[0];
          const ComposedShader shader = compose(spec);
          for (const ShaderSampler& sampler : shader.samplers)
            for (const ShaderSampler::Slice& slice : sampler.slices)
              EXPECT_TRUE(spec.textures[slice.texture].coefficient == 0 ||
                          sampler.encoding.encoding->is_signed);
          shaders.add_text(shader.text);
        }
  ShaderSpec spec = directional(spec_of({parse_encoding("f16")}));
  spec.form = Form::functions;
  const std::string text = compose(spec).text;
  shaders.add_text("#version 330 core\n" + text +
                   "in vec2 uv; in vec3 offset; out vec3 lux;\n"
                   "void main() { lux = sconce_illuminance(uv, 0, offset); }\n");
  for (const char* term :
       {"offset.x * sconce_weight[0]", "offset.y * sconce_weight[0]", "max(sum, vec3(0.0))"})
    EXPECT_NE(text.find(term), std::string::npos) << term;
  shaders.expect_valid();

  spec.form = Form::atlas;
  EXPECT_THROW(compose(spec), Error) << "coefficients must not be summed";
  spec.textures.erase(spec.textures.begin(), spec.textures.begin() + 3);
  EXPECT_EQ(compose(spec).text.find("max(sum"), std::string::npos) << "g is signed";
}

TEST(Composer, ArraysWhereUnitsEnd) {
  ShaderSpec spec = spec_of(std::vector(12, parse_encoding("f16")));
  EXPECT_EQ(compose(spec).samplers.size(), 12u);
  spec = spec_of(std::vector(13, parse_encoding("f16")), 2);
  spec.textures.push_back({parse_encoding("multi8"), {13}, {{1, 1, 1, 1}, {2, 2, 2, 2}}});
  spec.groups = 14;
  const std::vector<ShaderSampler> samplers = compose(spec).samplers;
  ASSERT_EQ(samplers.size(), 2u);
  EXPECT_TRUE(samplers[0].array);
  ASSERT_EQ(samplers[0].slices.size(), 26u);
  EXPECT_EQ(samplers[0].slices[3].texture, 1u);
  EXPECT_EQ(samplers[0].slices[3].page, 1);
  ASSERT_EQ(samplers[1].slices.size(), 4u);
  EXPECT_EQ(samplers[1].slices[2].plane, 1);
}

/// Codes are never interpolated before they are decoded, but where decoding is linear.
TEST(Composer, FiltersDecodedValues) {
  for (const EncodingChoice& kind : kinds())
    for (const ShaderTier& tier : shader_tiers()) {
      ShaderSpec spec = spec_of({kind});
      spec.tier = &tier;
      const ComposedShader shader = compose(spec);
      const Encoding& uploaded = *shader.samplers[0].encoding.encoding;
      const bool linear = uploaded.filters && (tier.filter || uploaded.type == TexelType::u8);
      SCOPED_TRACE(kind.name() + " " + std::string(tier.name));
      EXPECT_EQ(shader.samplers[0].linear, linear);
      EXPECT_EQ(shader.text.find("texelFetch") == std::string::npos, linear);
      EXPECT_TRUE(uploaded.type != TexelType::f32 || tier.f32);
      EXPECT_TRUE(uploaded.type != TexelType::f16 || tier.f16);
      EXPECT_TRUE(uploaded.type != TexelType::bc6h || tier.bc6h);
    }
}

TEST(Composer, WhatDoesNotExist) {
  EXPECT_THROW(find_shader_target("hlsl"), UsageError);
  EXPECT_THROW(find_shader_tier("quantum"), UsageError);
  ShaderSpec spec = spec_of({parse_encoding("f16")});
  spec.form = Form::compute;
  spec.target = &find_shader_target("glsl300es");
  EXPECT_THROW(compose(spec), Error);
}

}  // namespace
}  // namespace sconce
