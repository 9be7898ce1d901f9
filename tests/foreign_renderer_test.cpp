// SPDX-License-Identifier: Apache-2.0
// Somebody else's renderer with our global illumination: the OpenSceneGraph, the OGRE and the three.js
// example against paths in their room, lit by their light model.
#include <gtest/gtest.h>

#include "../examples/room/room.h"
#include "browser.h"
#include "core/parallel.h"
#include "core/sobol.h"
#include "image/io.h"
#include "scene/lens.h"
#include "scene/shapes.h"
#include "trace/tracer.h"

namespace sconce {
namespace {

constexpr int kBox = 4;  // pixels, a side: errors are of means over boxes

Vec3 vec(const room::Triple& t) {
  return {t[0], t[1], t[2]};
}
Rgb rgb(const room::Triple& t) {
  return {t[0], t[1], t[2]};
}

/// The renderer's room, for rays.
class Paths {
 public:
  Paths(const room::Lamp& lamp, bool repainted) : lamp_(lamp) {
    for (const room::Paint& paint : room::kPaints)
      add_material(scene_, paint.name, rgb(paint.color), rgb(paint.emission));
    if (repainted) scene_.materials[room::kRepainted].base_color = rgb(room::kNewColor);
    for (const room::Wall& w : room::walls())
      add_quad(scene_, "wall", Id<Material>(w.paint), vec(w.corner), vec(w.a), vec(w.b));
    world_ = make_world(scene_);
    tracer_ = std::make_unique<Tracer>(scene_, world_);
  }

  /// What bounces add to the picture, mean over boxes.
  Image indirect(uint32_t paths) const {
    Camera camera = look_at(vec(room::kEye), vec(room::kTarget));
    camera.yfov = room::kFieldOfView * kPi / 180;
    PictureParams size;
    size.width = room::kWidth, size.height = room::kHeight;
    const Lens lens(camera, size);
    Image out = Image::rgb(room::kWidth / kBox, room::kHeight / kBox);
    parallel_for(out.pixels(), 16, [&](std::size_t i) {
      const int x = static_cast<int>(i) % out.width, y = static_cast<int>(i) / out.width;
      Rgb sum;
      for (uint32_t p = 0; p < paths; ++p) {
        const auto stream = static_cast<uint32_t>(i);
        const Vec2 at = static_cast<float>(kBox) *
                        (Vec2(static_cast<float>(x), static_cast<float>(y)) + sobol_pair(p, 0, stream));
        const Hit hit = tracer_->closest({lens.eye(), lens.direction(at)});
        if (hit && !hit.back) sum += gathered(hit, p, stream);
      }
      out.set_rgb(x, y, sum / static_cast<float>(paths));
    });
    return out;
  }

 private:
  Rgb reflectance(const Hit& hit) const { return scene_[world_.materials[hit.triangle]].base_color; }
  Rgb shown(const Hit& hit) const {
    const SurfacePoint at = surface_point(world_, hit);
    const Vec3 to = vec(lamp_.position) - at.position;
    const float distance = glm::length(to),
                cosine = std::max(0.0f, glm::dot(to, at.shading_normal) / distance);
    const float loss = lamp_.falloff > 0 ? 0.25f * distance * distance : 1;
    return scene_[world_.materials[hit.triangle]].emission +
           reflectance(hit) * rgb(lamp_.strength) * (cosine / loss);
  }
  Rgb gathered(Hit hit, uint32_t path, uint32_t stream) const {
    Rgb sum, throughput(1);
    for (uint32_t step = 1; step < 40; ++step) {
      const SurfacePoint at = surface_point(world_, hit);
      const Rgb rho = reflectance(hit);
      const float survival = step > 3 ? rho.max() : 1;
      if (sobol_pair(path, 2 * step, stream).x >= survival) break;
      throughput *= rho / survival;
      const Vec3 direction =
          Frame(at.shading_normal).to_world(square_to_cosine(sobol_pair(path, 2 * step - 1, stream)));
      hit = tracer_->closest({offset_origin(at.position, at.geometric_normal, direction), direction});
      if (!hit || hit.back) break;
      sum += throughput * shown(hit);
    }
    return sum;
  }

  room::Lamp lamp_;
  Scene scene_;
  World world_;
  std::unique_ptr<Tracer> tracer_;
};

struct Difference {
  double relative_rmse = 0, mean_ratio = 0;
};

/// Of what bounces add in the renderer's pictures to what they do by paths.
Difference difference(const std::string& with, const std::string& without, const Image& paths) {
  const Image lit = read_exr(with), direct = read_exr(without);
  double squares = 0, sum = 0, expected = 0;
  for (int y = 0; y < paths.height; ++y)
    for (int x = 0; x < paths.width; ++x) {
      Rgb mean;
      for (int k = 0; k < kBox * kBox; ++k) {
        const int u = kBox * x + k % kBox, v = kBox * y + k / kBox;
        mean += (lit.rgb_at(u, v) - direct.rgb_at(u, v)) * (1.0f / (kBox * kBox));
      }
      const Rgb d = mean - paths.rgb_at(x, y);
      squares += static_cast<double>(d.r * d.r + d.g * d.g + d.b * d.b) / 3;
      sum += static_cast<double>(mean.r + mean.g + mean.b) / 3;
      expected += static_cast<double>(paths.rgb_at(x, y).r + paths.rgb_at(x, y).g + paths.rgb_at(x, y).b) / 3;
    }
  const auto n = static_cast<double>(paths.pixels());
  return {std::sqrt(squares / n) / (expected / n), sum / expected};
}

class Renderer : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    if (in_browser()) SCONCE_NEEDS_BROWSER();
  }
  static bool in_browser() { return std::string(GetParam()).ends_with("/three_radiosity"); }
  test::Outcome run(std::vector<std::string> arguments) const {
    if (in_browser()) {
      arguments.insert(arguments.begin(), {SCONCE_SOURCE_DIR "/web/test/three.mjs", GetParam()});
      return test::run_program("node", arguments, "timeout 300");
    }
    return test::run_program(GetParam(), arguments, test::with_display("640x480", 300));
  }
  TemporaryFolder folder_;
  const std::string out_ = (folder_ / "room").string();
};

INSTANTIATE_TEST_SUITE_P(Examples, Renderer, testing::Values(FOREIGN_RENDERERS), [](const auto& row) {
  return std::filesystem::path(row.param).filename().string();
});

TEST_P(Renderer, BouncesAreThoseOfPaths) {
  const test::Outcome outcome = run({out_});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out.find("Lambertian"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("reflectance 0.6500 0.1200 0.1000"), std::string::npos) << outcome.out;
  // What reading back took is told of every frame, and is part of what the renderer took.
  double drawn = 0, read = 0;
  const std::size_t frame = outcome.out.find("frame: ");
  ASSERT_NE(frame, std::string::npos) << outcome.out;
  ASSERT_EQ(std::sscanf(&outcome.out[frame], "frame: %lf ms in the renderer, %lf of them", &drawn, &read), 2);
  EXPECT_GT(read, 0);
  EXPECT_LT(read, drawn);
  room::Lamp lamp;
  for (const std::string change : {"", "changed", "painted"}) {
    const Difference d = difference(out_ + "-" + (change.empty() ? "with" : change) + ".exr",
                                    out_ + "-" + change + (change.empty() ? "" : "-") + "direct.exr",
                                    Paths(lamp, change == "painted").indirect(256));
    RecordProperty(change + " rmse", std::to_string(d.relative_rmse));
    RecordProperty(change + " mean", std::to_string(d.mean_ratio));
    EXPECT_LT(d.relative_rmse, 0.10);
    EXPECT_NEAR(d.mean_ratio, 1, 0.03);
    lamp.falloff = 1;
  }
}

TEST_P(Renderer, LacquerIsNotLambertian) {
  const test::Outcome outcome = run({out_, "--shiny"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("lacquer is not Lambertian: "), std::string::npos) << outcome.out;
  EXPECT_EQ(outcome.out.find("plaster is not"), std::string::npos) << outcome.out;
}

// A lost context, a shader that cannot be rewritten, NaN, sconce gone: one line, and the page goes on.
TEST(ThreeJs, GoesOnWithoutBounces) {
  SCONCE_NEEDS_BROWSER();
  const TemporaryFolder folder;
  const test::Outcome outcome = test::run_program(
      "node",
      {SCONCE_SOURCE_DIR "/web/test/three_faults.mjs", THREE_RADIOSITY, (folder / "room.png").string()},
      "timeout 300");
  EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
}

}  // namespace
}  // namespace sconce
