// SPDX-License-Identifier: Apache-2.0
// Moved lamps by OpenGL against the CPU's: direct light outside a band of two shadow texels to 1e-3, indirect
// light by the same operator, light shaders against lamps of the same kind.
#include <gtest/gtest.h>

#include "bumpy_room.h"
#include "core/sobol.h"
#include "gpu/direct_light.h"
#include "gpu/transfer.h"
#include "gpu/view.h"
#include "import/lights.h"
#include "package/test_unlit.h"
#include "relight/relight.h"
#include "relit_room.h"
#include "transfer/folded_bounces.h"

namespace sconce {
namespace {

using namespace test;

/// Direct light alone, by rays and by OpenGL, at the middles of pixels.
class DirectLight : public testing::Test {
 protected:
  explicit DirectLight(const std::filesystem::path& package = room().package)
      : package_(Package::open(package)), view_(package_) {
    params_.width = 96, params_.height = 96, params_.samples = 1;
    camera_ = view_.camera("");
    black_.assign(static_cast<std::size_t>(package_.manifest().pages),
                  Image::rgb(package_.manifest().width, package_.manifest().height));
    mix_.weights.assign(package_.manifest().groups.size(), Rgb(0));
  }

  Image by_rays(const std::vector<Light>& lights, const std::vector<MovedGroup>& groups = {},
                int samples = 1) {
    lamps_ = std::make_unique<MovedLamps>(view_.scene(), view_.world(), view_.tracer(),
                                          MoreLights{lights, luminaires_}, groups);
    params_.samples = samples;
    return view_.render(
        camera_, mix_, black_, params_, {}, nullptr,
        [&](const SurfacePoint& at, int x, int y, uint32_t sample) {
          return lamps_->illuminance(at, mix32(static_cast<uint32_t>(x), static_cast<uint32_t>(y)), sample);
        },
        components_);
  }
  Image by_opengl(std::vector<gpu::LampShader> lamps) {
    gpu::View view(context_, view_.shown(), true);
    gpu::DirectLight light(context_, view.geometry(), view_.world().bounds, std::move(lamps));
    gpu::AddedLight* added[] = {&light};
    view.draw(camera_, mix_.weights, gpu::MixedPages(context_, black_, components_), params_, {},
              {.added = added});
    mishaps_ = light.mishaps();
    return view.linear();
  }
  /// The lamps of the last by_rays().
  std::vector<gpu::LampShader> same_lamps(int patches = 16) const {
    return gpu::lamp_shaders(lamps_->lamps(), lamps_->chosen(), patches, kSide);
  }

  /// Whether the edge of a shadow is at most two texels away from what a pixel sees.
  bool near_edge(int x, int y, const gpu::LampShader& lamp) const {
    const Lens lens(camera_, params_);
    const Hit hit = view_.tracer().closest(
        {lens.eye(), lens.direction({static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f})});
    if (!hit) return false;
    const SurfacePoint at = surface_point(view_.world(), hit);
    const Mat3 frame(lamp.frame);
    const bool sun = lamp.shadow == gpu::LampShader::Shadow::sun;
    const Vec3 lamp_at(lamp.frame[3]), to = at.position - lamp_at;
    // A texel's steps on the map's plane through the point: shadow_map.cpp.
    Vec3 step[2]{frame[0], frame[1]};
    float texel = 2 * view_.world().bounds.diagonal() / (kSide - 6);  // no less than a fitted one
    if (lamp.shadow == gpu::LampShader::Shadow::map) {
      texel = glm::dot(to, -frame[2]) * std::tan(lamp.opening / 2) / (kSide / 2 - 3);
    } else if (!sun) {
      const Vec3 local = glm::abs(to * frame);
      const int major = local.x >= local.y && local.x >= local.z ? 0 : local.y >= local.z ? 1 : 2;
      step[0] = frame[(major + 1) % 3], step[1] = frame[(major + 2) % 3];
      texel = local[major] / (kSide / 2 - 3);
    }
    int lit = 0;
    for (int i = -2; i <= 2; ++i)
      for (int j = -2; j <= 2; ++j) {
        const Vec3 through =
            at.position + texel * (static_cast<float>(i) * step[0] + static_cast<float>(j) * step[1]);
        const Vec3 from = sun ? through + 10.0f * frame[2] : lamp_at;
        const Vec3 direction = glm::normalize(through - from);
        const float plane =
            glm::dot(at.position - from, at.geometric_normal) / glm::dot(direction, at.geometric_normal);
        const Hit first = view_.tracer().closest({from, direction});
        lit += first && first.distance < plane * (1 - 1e-4f) ? 0 : 1;
      }
    return lit != 0 && lit != 25;
  }

  /// @param filtered  through textures that the device filters, hardware in steps of 1/256 texel
  void expect_alike(const Light& light, bool filtered = false) {
    const float near = filtered && !context_.capabilities().software ? 1.0f / 64 : 1e-3f;
    const Image rays = by_rays({light});
    const std::vector<gpu::LampShader> lamps = same_lamps();
    const Image device = by_opengl(lamps);
    ASSERT_EQ(lamps.size(), 1u);
    double mean = 0;
    for (const float v : rays.data) mean += static_cast<double>(v) / static_cast<double>(rays.data.size());
    std::size_t compared = 0, alike = 0, banded = 0;
    for (int y = 0; y < rays.height; ++y)
      for (int x = 0; x < rays.width; ++x) {
        if (near_edge(x, y, lamps[0])) {
          ++banded;
          continue;
        }
        const Rgb a = rays.rgb_at(x, y), b = device.rgb_at(x, y);
        ++compared;
        alike += std::abs(a.g - b.g) <= near * std::max(a.g, 0.01f * static_cast<float>(mean)) ? 1 : 0;
      }
    EXPECT_GT(mean, 0.5);
    EXPECT_GT(compared, 9 * rays.pixels() / 10) << banded;
    EXPECT_GE(static_cast<double>(alike), 0.995 * static_cast<double>(compared)) << "of " << compared;
  }

  /// The more small lamps the lamps of the last by_rays() are drawn as, the nearer.
  void expect_nearer(const Image& rays) {
    double before = 1;
    for (const int patches : {1, 4, 16}) {
      const double error = error_of(rays, by_opengl(same_lamps(patches)));
      EXPECT_LT(error, before) << patches;
      before = error;
    }
    EXPECT_LT(before, 0.04);
  }

  static constexpr int kSide = 1024;
  const Package package_;
  const View view_;
  const gpu::Context context_;
  Camera camera_;
  PictureParams params_;
  std::vector<Image> black_, components_;  ///< of a lightmap that knows directions
  MixSpec mix_;
  std::unique_ptr<MovedLamps> lamps_;
  std::vector<Luminaire> luminaires_;  ///< that lights name
  std::vector<gpu::DirectLight::Report> mishaps_;
};

TEST_F(DirectLight, PointsSpotsAndSunsOutsideTheEdgesOfShadows) {
  for (const char* text :
       {"point,position=-0.3,1.5,0.2,lumens=400", "point,position=0.35,1.2,-0.3,lumens=400,range=2",
        "spot,position=-0.2,1.9,0.3,target=0.3,0.5,-0.4,lumens=400,inner=10,outer=40",
        "spot,position=0.35,1.9,-0.35,target=0.3,0,0,lumens=400,outer=85",
        "sun,direction=0.3,-0.2,-1,intensity=500"}) {
    SCOPED_TRACE(text);
    expect_alike(parse_lights(text, "test").lights.at(0));
  }
}

/// The room with waves on its walls, unlit.
const std::filesystem::path& bumpy_package() {
  static const TemporaryFolder folder;
  static const std::filesystem::path path = [] {
    Scene scene = open_room();
    std::erase_if(scene.instances, [](const Instance& i) { return i.name.starts_with("lamp"); });
    add_waves(scene);
    return unlit(std::move(scene), folder.path()).path();
  }();
  return path;
}

class BumpyDirectLight : public DirectLight {
 protected:
  BumpyDirectLight() : DirectLight(bumpy_package()) {}
};

// By the rule of View::render(): where the lightmap's light sees normal maps.
TEST_F(BumpyDirectLight, AsItsRays) {
  const Light spot =
      parse_lights("spot,position=-0.2,1.9,0.3,target=0.3,0.5,-0.4,lumens=400,inner=10,outer=40", "test")
          .lights.at(0);
  expect_alike(spot, true);
  const Image smooth = by_rays({spot});
  components_.assign(3 * black_.size(), black_.front());
  expect_alike(spot, true);
  EXPECT_GT(error_of(smooth, by_rays({spot})), 0.05);
  expect_alike(parse_lights("point,position=0.35,1.2,-0.3,lumens=400,range=2", "test").lights.at(0), true);
}

TEST_F(DirectLight, AProjectorAsItsRays) {
  auto slide = std::make_shared<Image>(Image::rgb(8, 6));
  for (std::size_t i = 0; i < slide->data.size(); ++i)
    slide->data[i] = 0.1f + 0.9f * static_cast<float>(i % 7) / 6;
  for (const char* fov : {"40", "130"}) {
    SCOPED_TRACE(fov);
    Light light =
        parse_lights("spot,position=-0.2,1.9,0.3,target=0.3,0.3,-0.4,intensity=100", "test").lights.at(0);
    light.shape = ProjectorLight{slide, glm::radians(std::stof(fov)), 8.0f / 6};
    expect_alike(light, true);
  }
}

// A table that no axis mirrors: C0 towards -x here, C90 towards the viewer.
TEST_F(DirectLight, AMeasuredLampAsItsRays) {
  Photometry table;
  table.azimuths = {0, 90, 200, 360};
  table.polars = {0, 35, 70, 120};
  table.candela = {300, 200, 90, 0, 300, 60, 150, 0, 300, 120, 20, 0, 300, 200, 90, 0};
  luminaires_ = {{"lamp.ldt", table}};
  Light light;
  light.intensity = Rgb(0.5f);
  light.frame = Mat4({-1, 0, 0, 0}, {0, 0, 1, 0}, {0, 1, 0, 0}, {-0.2f, 1.6f, 0.3f, 1});
  light.shape = LuminaireLight{Id<Luminaire>(0)};
  expect_alike(light);
}

TEST_F(DirectLight, ManyPointsAreAnOpening) {
  MoreLights panel = parse_lights("area,size=0.6,0.2,position=0.2,1.9,0.1,lumens=200", "test");
  luminaires_ = panel.luminaires;
  expect_nearer(by_rays(panel.lights, {}, 64));
}

TEST_F(DirectLight, ManyPatchesAreAnAreaLamp) {
  expect_nearer(by_rays({}, {{Id<LightGroup>(0), Rgb(1)}}, 64));
}

gpu::LampShader own(const std::string& text, const Vec3& position = Vec3(0, 1.5f, 0)) {
  gpu::LampShader lamp;
  lamp.name = lamp.file = "own.glsl";
  lamp.text = text;
  lamp.frame[3] = glm::vec4(position, 1);
  return lamp;
}

// With all its controls left alone an uber-light is a point that shines forwards; each control takes light
// away.
TEST_F(DirectLight, AnUberLightIsAPointAndLess) {
  const Vec3 at(0, 1.5f, 0);
  Light point = parse_lights("point,position=0,1.5,0,intensity=100", "test").lights.at(0);
  gpu::LampShader uber = own(read_file(example("uber.glsl")), at);
  uber.frame = point.frame;  // downwards
  uber.intensity = Rgb(100);
  const Image all = by_rays({point}), open = by_opengl({uber});
  const Lens lens(camera_, params_);
  std::size_t below = 0, alike = 0;
  for (int y = 0; y < all.height; ++y)
    for (int x = 0; x < all.width; ++x) {
      const Hit hit = view_.tracer().closest(
          {lens.eye(), lens.direction({static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f})});
      if (!hit || near_edge(x, y, uber)) continue;
      if (view_.world().position(hit.triangle, hit.barycentric).y < 1.499f) {
        ++below;
        alike +=
            std::abs(open.rgb_at(x, y).g - all.rgb_at(x, y).g) <= 1e-3f * all.rgb_at(x, y).g + 1e-4f ? 1 : 0;
      } else if (view_.world().position(hit.triangle, hit.barycentric).y > 1.501f) {
        EXPECT_EQ(open.rgb_at(x, y), Rgb(0));
      }
    }
  EXPECT_GT(below, 4000u);
  EXPECT_GE(static_cast<double>(alike), 0.995 * static_cast<double>(below));
  const auto light = [&](std::vector<gpu::LampUniform> uniforms) {
    uber.uniforms = std::move(uniforms);
    double sum = 0;
    for (const float v : by_opengl({uber}).data) sum += static_cast<double>(v);
    return sum;
  };
  const double whole = light({});
  for (const std::vector<gpu::LampUniform>& uniforms :
       {std::vector<gpu::LampUniform>{{"width", {30}, ""}, {"height", {20}, ""}},
        {{"barn_left", {10}, ""}},
        {{"barn_top", {10}, ""}},
        {{"near_start", {1}, ""}, {"near_end", {1.2f}, ""}},
        {{"far_start", {1}, ""}, {"far_end", {1.2f}, ""}}}) {
    const double some = light(uniforms);
    EXPECT_GT(some, 0.02 * whole) << uniforms[0].name;
    EXPECT_LT(some, 0.98 * whole) << uniforms[0].name;
  }
  // A rectangle of the same width and height holds its ellipse.
  EXPECT_GT(light({{"width", {30}, ""}, {"height", {20}, ""}, {"roundness", {0}, ""}}),
            light({{"width", {30}, ""}, {"height", {20}, ""}}));
  EXPECT_NEAR(light({{"barn_left", {-95}, ""}, {"edge", {1}, ""}}), 0, 1e-6);
}

TEST_F(DirectLight, ShadowMapsTooLargeSaySo) {
  by_rays({});
  gpu::LampShader lamp = own("vec3 light(vec3 P, vec3 N) { return vec3(1.0); }");
  lamp.side = context_.capabilities().max_texture_size + 1;
  try {
    by_opengl({lamp});
    FAIL();
  } catch (const Error& e) {
    EXPECT_TRUE(std::string(e.what()).starts_with("shadow map of own.glsl: ")) << e.what();
  }
}

TEST_F(DirectLight, WhatOpenGlDoesNotMoveIsNamed) {
  Light sky;
  sky.name = "dome";
  sky.intensity = Rgb(1);
  sky.shape = SkyLight{};
  by_rays({sky});
  EXPECT_THROW(same_lamps(), gpu::UnknownLamp);
}

TEST_F(DirectLight, NoNumberIsCountedAndPaintedOver) {
  by_rays({});
  const Image plain = by_opengl({own("vec3 light(vec3 P, vec3 N) { return vec3(1.0); }")});
  EXPECT_TRUE(mishaps_.empty());
  // One pixel, which looks like its neighbours then.
  constexpr int kAt = 60;
  const Lens lens(camera_, params_);
  const Hit hit = view_.tracer().closest({lens.eye(), lens.direction({kAt + 0.5f, kAt + 0.5f})});
  const Vec3 place = view_.world().position(hit.triangle, hit.barycentric);
  const Image spotted =
      by_opengl({own("vec3 light(vec3 P, vec3 N) { return vec3(distance(P, vec3(" + std::to_string(place.x) +
                     "," + std::to_string(place.y) + "," + std::to_string(place.z) +
                     ")) < 0.003 ? sqrt(-lamp_position.y) : 1.0); }")});
  ASSERT_EQ(mishaps_.size(), 1u);
  EXPECT_EQ(mishaps_[0].file, "own.glsl");
  EXPECT_EQ(mishaps_[0].pixels.count, 1u);
  EXPECT_EQ(mishaps_[0].pixels.first, static_cast<uint32_t>(kAt * params_.width + kAt));
  EXPECT_GT(plain.rgb_at(kAt, kAt).g, 0.01f);
  for (std::size_t i = 0; i < plain.data.size(); ++i)
    ASSERT_NEAR(spotted.data[i], plain.data[i], 1e-4f * plain.data[i]) << i / 3;
  // Half the room: dark but for its seam.
  const Image holed =
      by_opengl({own("vec3 light(vec3 P, vec3 N) { return vec3(1.0, P.x < 0.0 ? 1.0 / max(P.x, 0.0) : 1.0, "
                     "1.0); }")});
  ASSERT_EQ(mishaps_.size(), 1u);
  std::size_t dark = 0;
  for (std::size_t i = 0; i < holed.data.size(); i += 3) {
    ASSERT_TRUE(std::isfinite(holed.data[i]));
    dark += holed.data[i] == 0 && plain.data[i] > 0 ? 1 : 0;
  }
  EXPECT_GT(dark, 1000u);
  EXPECT_GE(mishaps_[0].pixels.count, dark);
}

// The operator of the room's lightmap. Slots differ where edges of shadows cross them, and nowhere else.
TEST_F(DirectLight, OnTheCloudAndThroughTheOperator) {
  const Operator op = open_operator(package_.path() / "operators" / "lightmap.bin");
  by_rays({parse_lights("point,position=-0.3,1.5,0.2,lumens=400", "test").lights.at(0)});
  const std::vector<Rgbx> rays = light_cloud(op, *lamps_);

  const gpu::View view(context_, view_.shown());
  gpu::DirectLight light(context_, view.geometry(), view_.world().bounds, same_lamps());
  const gpu::Transfer transfer(context_, op);
  light.light_cloud({context_, op.lit, "cloud"}, op.slots(), op.points_per_slot, transfer.exitance());
  std::vector<Rgbx> device(op.slots());
  transfer.exitance().read(std::span(device).size_bytes(), device.data());
  std::size_t lit = 0, alike = 0;
  double all = 0, all_device = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    all += static_cast<double>(rays[i][1]), all_device += static_cast<double>(device[i][1]);
    if (rays[i][1] == 0) continue;
    ++lit;
    alike += std::abs(rays[i][1] - device[i][1]) <= 1e-3f * rays[i][1] ? 1 : 0;
  }
  EXPECT_GT(lit, rays.size() / 2);
  EXPECT_GT(static_cast<double>(alike), 0.94 * static_cast<double>(lit)) << "of " << lit;
  EXPECT_NEAR(all_device, all, 2e-3 * all);

  std::vector<Rgbx> coefficients = rays;
  std::vector<Rgb> expected(op.gather.rows);
  FoldedBounces(op).indirect(coefficients, expected);
  transfer.exitance().write(std::span(rays).size_bytes(), rays.data());
  transfer.apply();
  const std::vector<Rgb> seen = transfer.read();
  double mean = 0;
  for (const Rgb& e : expected) mean += static_cast<double>(e.g) / static_cast<double>(expected.size());
  ASSERT_GT(mean, 0);
  for (std::size_t i = 0; i < seen.size(); ++i)
    ASSERT_NEAR(seen[i].g, expected[i].g, 1e-3f * std::max(expected[i].g, 0.01f * static_cast<float>(mean)))
        << i;
}

}  // namespace
}  // namespace sconce
