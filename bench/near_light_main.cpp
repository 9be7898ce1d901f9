// SPDX-License-Identifier: Apache-2.0
// Table 1 of Granier, Goesele, Heidrich and Seidel 2003 again: frames per second of their three data sets,
// made by our virtual bench, in two rooms like theirs; the lamp moves in every frame, so that all shadow maps
// are drawn again. near_light [WIDTH HEIGHT]; no processor's column where a size is given. Markdown to
// standard output.
#include <fmt/format.h>

#include <charconv>
#include <cstring>
#include <thread>

#include "core/parallel.h"
#include "core/scratch_folder.h"
#include "device.h"
#include "gpu/near_lights.h"
#include "gpu/view.h"
#include "luminaires.h"
#include "measure/field.h"
#include "measure/virtual_bench.h"
#include "package/test_unlit.h"
#include "picture/render.h"
#include "relight/test_near_spots.h"
#include "scene/groups.h"
#include "vaults.h"

namespace {

using namespace sconce;

constexpr uint64_t kRays = 2'000'000;
constexpr int kPixels = 300;  // of an image's edge, as in the paper
constexpr int kSide = 256;    // of a shadow map

struct Sample {
  const char* name;
  Scene scene;
  double spacing, angle;  ///< m; degrees
  double paper[2][2];     ///< crypt, cloister: frames per second with and without shadows
};

LightField measured(const Sample& lamp) {
  Scene scene = lamp.scene;
  assign_groups(scene, Grouping::automatic);
  const World world = make_world(scene);
  BenchParams bench;
  bench.rays = kRays;
  const auto rays = trace_luminaire(scene, world, Tracer(scene, world), Lamps(scene, world), bench);
  FieldParams params;
  params.basis = NearBasis::bell;
  params.spacing = lamp.spacing;
  params.angle = lamp.angle;
  params.pixels = kPixels;
  return measure_field([&](const auto& f) { f(rays); }, params, lamp.name).field;
}

/// The room's first camera, and the lamp beside it that shines where it looks.
class Room {
 public:
  explicit Room(Scene scene)
      : package_(unlit(std::move(scene), folder_.path())),
        view_(package_),
        camera_(view_.camera("")),
        black_(1, Image::rgb(1, 1)) {}

  const View& view() const { return view_; }
  Lamps lamps(const std::shared_ptr<const LightField>& field, Scene& scene) const {
    scene = view_.scene();
    scene.luminaires.push_back({"lamp", {}, field});
    Light light;
    light.intensity = Rgb(1);
    light.shape = LuminaireLight{Id<Luminaire>(0)};
    light.frame = camera_.frame;
    light.frame[3] += camera_.frame * glm::vec4(0.3f, -0.2f, 0, 0);
    scene.lights.push_back(light);
    assign_groups(scene, Grouping::one);
    return {scene, view_.world()};
  }

  /// Seconds of a picture on all processors, every term with a shadow ray of its own.
  double on_cpu(const Lamps& lamps, const PictureParams& params, bool shadows, double* lit) const {
    using Clock = std::chrono::steady_clock;
    const auto& lamp = std::get<NearFieldLamp>(lamps.all().at(0).shape);
    const auto start = Clock::now();
    const Image image = view_.render(
        camera_, {}, black_, params, {}, nullptr, [&](const SurfacePoint& at, int, int, uint32_t) {
          return Rgb(static_cast<float>(near_spots(lamp, at, shadows ? &view_.tracer() : nullptr)));
        });
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    *lit = 0;
    for (std::size_t i = 0; i < image.data.size(); i += 3) *lit += image.data[i] != 0;
    *lit /= static_cast<double>(image.pixels());
    return seconds;
  }

  /// @param camera  moves, too, so that the scene is drawn again
  double on_device(const gpu::Context& context, const Lamps& lamps, const PictureParams& params,
                   const gpu::NearLightParams& near, bool camera) const {
    gpu::View view(context, view_.shown());
    const std::pair<std::size_t, Rgb> chosen(0, Rgb(1));
    gpu::NearLights light(context, view.geometry(), view_.world().bounds, lamps, {&chosen, 1}, near);
    const auto& lamp = std::get<NearFieldLamp>(lamps.all().at(0).shape);
    const gpu::MixedPages black(context, black_);
    gpu::AddedLight* added[] = {&light};
    view.draw(camera_, {}, black, params, {}, {.added = added, .keep = true});
    return device_seconds(context, [&] {
      light.move(0, lamp.position, lamp.to_world);
      if (camera)
        view.draw(camera_, {}, black, params, {}, {.added = added});
      else
        view.relight(added);
    });
  }

 private:
  ScratchFolder folder_;
  Package package_;
  View view_;
  Camera camera_;
  std::vector<Image> black_;
};

int number(const char* text) {
  int out = 0;
  const auto end = text + std::strlen(text);
  if (std::from_chars(text, end, out).ptr != end || out < 1 || out > 8192)
    throw UsageError("near_light", fmt::format("'{}' is no size", text), "1 to 8192");
  return out;
}

void report(int argc, char** argv) {
  PictureParams params;
  const bool sized = argc == 3;
  params.width = sized ? number(argv[1]) : 400, params.height = sized ? number(argv[2]) : 400;
  params.samples = 1;
  const gpu::Context context({.debug = false});
  const gpu::Capabilities& can = context.capabilities();
  fmt::print(
      "# Light fields in a room, by frames per second\n\n"
      "`near_light`: Table 1 of Granier, Goesele, Heidrich and Seidel 2003 with our own lamps and rooms, {} "
      "x {} "
      "pixels, light fields\nof {} x {} pixels, shadow maps of {} x {} texels. The lamp moves in every "
      "frame, so all "
      "maps are drawn again; *camera*: that moves, too. Figures are with shadows (without).\n*Lit*: share of "
      "the pixels that any term "
      "reaches. *Paper*: GeForce FX 5800 Ultra, 400 x 400, X = 3.{}\n\nOpenGL: {}, {}\n\n",
      params.width, params.height, kPixels, kPixels, kSide, kSide,
      sized ? ""
            : fmt::format(" *CPU*: {} threads, one shadow ray per pixel and term.",
                          std::thread::hardware_concurrency()),
      can.renderer, can.version);
  fmt::print(
      "| light field | room | terms | lit |{} OpenGL, one pass | and the camera | OpenGL, X = 3 | paper "
      "|\n|---|---|---|---|{}---|---|---|---|\n",
      sized ? "" : " CPU |", sized ? "" : "---|");
  using namespace demo;
  const Sample samples[] = {
      {"torch 5 x 5", make_torch(), 0.01, 30, {{2.7, 3.2}, {1.3, 1.6}}},
      {"torch 7 x 7", make_torch(), 0.005, 30, {{1.5, 1.7}, {0.7, 0.85}}},
      {"bicycle light 9 x 7", make_bicycle_light(), 0.0075, 40, {{1.2, 1.4}, {0.55, 0.7}}}};
  const Room rooms[] = {Room(make_crypt()), Room(make_cloister())};
  for (const Sample& sample : samples) {
    const auto field = std::make_shared<LightField>(measured(sample));
    for (int r = 0; r < 2; ++r) {
      const Room& room = rooms[r];
      Scene scene;
      const Lamps lamps = room.lamps(field, scene);
      double lit = 0;
      PictureParams few = params;
      if (sized) few.width = few.height = 64;
      const double cpu[2] = {1 / room.on_cpu(lamps, few, true, &lit),
                             1 / room.on_cpu(lamps, few, false, &lit)};
      const auto both = [](double with, double without) {
        return fmt::format(" {:.3g} ({:.3g}) |", with, without);
      };
      const auto device = [&](int x, int side, bool camera) {
        return 1 / room.on_device(context, lamps, params, {.shadow_side = side, .terms_per_pass = x}, camera);
      };
      fmt::print(
          "| {} | {} | {} | {:.0f} % |{}{}{}{}{}\n", sample.name, room.view().scene().name, field->terms(),
          100 * lit, sized ? "" : both(cpu[0], cpu[1]), both(device(0, kSide, false), device(0, 0, false)),
          both(device(0, kSide, true), device(0, 0, true)), fmt::format(" {:.3g} |", device(3, kSide, false)),
          both(sample.paper[r][0], sample.paper[r][1]));
      std::fflush(stdout);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    report(argc, argv);
    return 0;
  } catch (const std::exception& e) {
    fmt::print(stderr, "near_light: {}\n", e.what());
    return 1;
  }
}
