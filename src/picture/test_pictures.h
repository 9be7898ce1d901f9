// SPDX-License-Identifier: Apache-2.0
// For tests only: a scene with everything that shines, and pictures compared.
#pragma once

#include <gtest/gtest.h>

#include <memory>

#include "package/test_package.h"
#include "picture/render.h"
#include "scene/shapes.h"
#include "tone/apply.h"

namespace sconce {

/// A wall, two lamps before it, one of no group, and a sky around: two pages, three groups.
inline PackageContents lit_wall(int width, int height) {
  PackageContents c = test_package(3, 2, width, height);
  c.scene.materials[0].base_color = {0.8f, 0.5f, 0.1f};
  for (const Id<LightGroup> group : {Id<LightGroup>(0), Id<LightGroup>()}) {
    Material lamp;
    lamp.emission = {5, 4, 1};
    lamp.base_color = Rgb(0.3f);
    c.scene.materials.push_back(lamp);
    Mesh quad = test_quad("lamp", Id<Material>(c.scene.materials.size() - 1), 0.5f);
    for (Vec3& p : quad.positions) p = {0.2f * p.x + (group ? 0.3f : -0.3f), 0.2f * p.y, p.z};
    c.scene.meshes.push_back(quad);
    Instance instance;
    instance.name = "lamp";
    instance.mesh = Id<Mesh>(c.scene.meshes.size() - 1);
    instance.group = group;
    c.scene.instances.push_back(instance);
    c.manifest.instance_pages.push_back(1);
    c.manifest.instance_twins.push_back(-1);
  }
  add_sky(c.scene, Rgb(0.2f, 0.4f, 0.9f), Id<LightGroup>(2));
  c.scene.cameras[0].yfov = 1.3f;  // past the wall's edges
  return c;
}

/// A package on disk, opened, mixed and looked at.
class PictureTest : public testing::Test {
 protected:
  void open(const PackageContents& contents, const MixSpec& mix) {
    write_package(folder_ / "x.sconce", contents);
    package_ = std::make_unique<Package>(Package::open(folder_ / "x.sconce"));
    view_ = std::make_unique<View>(*package_);
    camera_ = view_->camera("");
    mix_ = mix;
    pages_ = mix_pages(*package_, mix);
  }
  TemporaryFolder folder_;
  std::unique_ptr<Package> package_;
  std::unique_ptr<View> view_;
  Camera camera_;
  MixSpec mix_;
  std::vector<Image> pages_;
  PictureParams params_{.width = 70, .height = 45, .samples = 1};
};

/// In codes.
inline int largest_difference(const Image8& a, const Image8& b) {
  EXPECT_EQ(a.data.size(), b.data.size());
  int largest = 0;
  for (std::size_t i = 0; i < a.data.size(); ++i)
    largest = std::max(largest, std::abs(int{a.data[i]} - int{b.data[i]}));
  return largest;
}

/// Of the channels whose codes differ by at most 1.
inline double share_alike(const Image8& a, const Image8& b) {
  EXPECT_EQ(a.data.size(), b.data.size());
  std::size_t alike = 0;
  for (std::size_t i = 0; i < a.data.size(); ++i)
    alike += std::abs(int{a.data[i]} - int{b.data[i]}) <= 1 ? 1 : 0;
  return static_cast<double>(alike) / static_cast<double>(a.data.size());
}

inline Image8 to_codes(const Image& coded) {
  Image8 out{coded.width, coded.height, 3, {}};
  for (const float v : coded.data) out.data.push_back(static_cast<unsigned char>(v * 255.0f + 0.5f));
  return out;
}

/// The picture of fixed_function() by View::render() alone, without cached hits, tables and 8-bit textures:
/// a lightmap of display codes takes the place of the light, one of pi lux shows the albedo.
inline Image8 plain_fixed_function(const View& view, const Camera& camera, const MixSpec& mix,
                                   const std::vector<Image>& pages, const PictureParams& params,
                                   const Exposure& exposure, const ToneMapper& mapper) {
  std::vector<Image> toned = pages, white = pages, black = pages;
  for (std::size_t p = 0; p < pages.size(); ++p) {
    for (int y = 0; y < pages[p].height; ++y)
      for (int x = 0; x < pages[p].width; ++x)
        toned[p].set_rgb(x, y, tone_map(pages[p].rgb_at(x, y) * kInvPi, exposure, mapper));
    std::fill(white[p].data.begin(), white[p].data.end(), kPi);
    std::fill(black[p].data.begin(), black[p].data.end(), 0.0f);
  }
  const MixSpec off{std::vector<Rgb>(mix.weights.size())};
  const Image none = view.render(camera, off, black, params);  // what shines without a group
  const Image albedo = view.render(camera, off, white, params),
              light = view.render(camera, off, toned, params);
  Image out = view.render(camera, mix, black, params);
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x) {
      const Rgb rho = albedo.rgb_at(x, y) - none.rgb_at(x, y), lit = light.rgb_at(x, y) - none.rgb_at(x, y);
      Rgb c = tone_map(out.rgb_at(x, y), exposure, mapper);
      for (const auto channel : {&Rgb::r, &Rgb::g, &Rgb::b}) {
        // rho / pi * T over rho.
        if (rho.*channel > 1e-6f)
          c.*channel += linear_to_srgb(std::min(rho.*channel, 1.0f)) * (lit.*channel * kPi / (rho.*channel));
        c.*channel = std::clamp(c.*channel, 0.0f, 1.0f);
      }
      out.set_rgb(x, y, c);
    }
  return to_codes(out);
}

}  // namespace sconce
