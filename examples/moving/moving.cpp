// SPDX-License-Identifier: Apache-2.0
// A viewer of global illumination in real time, of pictures in the place of a window: a scene's camera and
// lamps move, and so does one of its objects; bounces follow. It draws with rays and lights of its own and
// knows of sconce what docs/foreign-renderers.md tells. A bar along the top says that bounces are still those
// of the object's old place.
//
//   moving SCENE OBJECT OUT [FRAMES]     any scene that sconce reads; OUT-00.png, OUT-01.png, ...
#include <fmt/format.h>

#include <cstdlib>

#include "core/error.h"
#include "core/parallel.h"
#include "core/sobol.h"
#include "detect/realtime.h"
#include "detect/split.h"
#include "image/io.h"
#include "import/import.h"
#include "scene/lens.h"

using namespace sconce;

namespace {

constexpr int kWidth = 480, kHeight = 270, kShadowRays = 16;

/// A ball of light.
struct Bulb {
  Vec3 position;
  Rgb intensity;
  float radius;
};

/// The renderer: local light with soft shadows, and what it is told to add.
class Renderer {
 public:
  explicit Renderer(Scene scene) : scene_(std::move(scene)) {
    for (const Light& light : scene_.lights)
      if (std::holds_alternative<PointLight>(light.shape) || std::holds_alternative<SpotLight>(light.shape))
        bulbs_.push_back({Vec3(light.frame[3]), light.intensity, 0});
    const Bounds& b = world_.bounds;
    if (bulbs_.empty())
      bulbs_.push_back({Vec3(b.center().x, 0.2f * b.lo.y + 0.8f * b.hi.y, b.center().z), Rgb(100), 0});
    for (Bulb& bulb : bulbs_) bulb.radius = 0.01f * b.diagonal();
  }

  TracedScene traced() const { return {scene_, world_, tracer_}; }
  const World& world() const { return world_; }
  std::vector<Bulb>& bulbs() { return bulbs_; }

  /// Moves all objects of that name. @return whether there are any
  bool move(const std::string& name, const Vec3& by) {
    bool any = false;
    for (Instance& instance : scene_.instances)
      if (instance.name == name) instance.transform[3] += Mat4::col_type(by.x, by.y, by.z, 0), any = true;
    world_ = make_world(scene_);
    tracer_ = Tracer(scene_, world_);
    return any;
  }

  /// The only thing that sconce asks for: faces in texture space, lit as it is told to.
  Drawing draw(const DrawRequest& request) const {
    const auto width = static_cast<std::size_t>(request.width);
    Drawing out;
    out.width = request.width, out.height = request.height;
    out.values.assign(3 * width * static_cast<std::size_t>(request.height), request.background);
    TextureSpace space;
    space.width = request.width, space.height = request.height;
    space.corners.assign(request.corners.begin(), request.corners.end());
    parallel_for(request.triangles.size(), 16, [&](std::size_t i) {
      const uint32_t t = request.triangles[i];
      const auto& [a, b, c] = request.corners[i];
      const glm::mat2 inverse = glm::inverse(glm::mat2(b - a, c - a));
      each_pixel(space, i, [&](std::size_t pixel) {
        const Vec2 at = inverse * (pixel_middle(space, pixel) - a);
        const Shade surface = shade(scene_, world_, t, at);
        const Rgb rho = request.white_card ? Rgb(1) : surface.base_color;
        const Vec3 n = world_.normal(t, at);
        Rgb value = request.white_card ? Rgb() : surface.emission;
        if (request.lights == DrawRequest::Lights::probe)
          value += rho * (request.probe.intensity * std::max(0.0f, glm::dot(n, request.probe.to_light)));
        if (request.lights == DrawRequest::Lights::all)
          value += rho * lit(world_.position(t, at), n, world_.face_normals[t], static_cast<uint32_t>(pixel));
        out.values[3 * pixel] = value.r, out.values[3 * pixel + 1] = value.g,
                       out.values[3 * pixel + 2] = value.b;
      });
    });
    return out;
  }

  /// What the camera sees. @param ambient  per vertex of the world
  Image picture(const Camera& camera, std::span<const Rgb> ambient) const {
    PictureParams size;
    size.width = kWidth, size.height = kHeight;
    const Lens lens(camera, size);
    Image out = Image::rgb(kWidth, kHeight);
    parallel_for(out.pixels(), 64, [&](std::size_t i) {
      const int x = static_cast<int>(i) % kWidth, y = static_cast<int>(i) / kWidth;
      const Hit hit = tracer_.closest(
          {lens.eye(), lens.direction({static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f})});
      if (!hit || hit.back) return;
      const Shade surface = shade(scene_, world_, hit.triangle, hit.barycentric);
      const SurfacePoint at = surface_point(world_, hit);
      const auto& v = world_.triangles[hit.triangle].v;
      const Vec2 w = hit.barycentric;
      const Rgb bounced = (1 - w.x - w.y) * ambient[v[0]] + w.x * ambient[v[1]] + w.y * ambient[v[2]];
      out.set_rgb(x, y,
                  surface.emission +
                      surface.base_color * (bounced + lit(at.position, at.shading_normal, at.geometric_normal,
                                                          static_cast<uint32_t>(i))));
    });
    return out;
  }

 private:
  /// Light by the bulbs, in the renderer's unit: a white card a metre below a bulb of 1 shows 1.
  Rgb lit(const Vec3& at, const Vec3& n, const Vec3& face, uint32_t stream) const {
    Rgb sum;
    const Vec3 start = offset_origin(at, face, face);
    for (const Bulb& bulb : bulbs_) {
      const Frame across(normalize_or(at - bulb.position, Vec3(0, 0, 1)));
      for (uint32_t r = 0; r < kShadowRays; ++r) {
        const Vec2 u = sobol_pair(r, 0, stream);
        const float far = bulb.radius * std::sqrt(u.x), angle = 2 * kPi * u.y;
        const Vec3 to =
            bulb.position + far * (std::cos(angle) * across.x + std::sin(angle) * across.y) - start;
        const float distance = glm::length(to), cosine = glm::dot(to, n) / distance;
        if (cosine <= 0 || tracer_.occluded({start, to / distance, distance})) continue;
        sum += bulb.intensity * (cosine / (distance * distance * kShadowRays));
      }
    }
    return sum;
  }

  Scene scene_;
  World world_{make_world(scene_)};
  Tracer tracer_{scene_, world_};
  std::vector<Bulb> bulbs_;
};

void write(const std::string& name, const Image& linear, float exposure, bool following) {
  Image8 out{linear.width, linear.height, 3, {}};
  constexpr int kBar = 4;
  for (int y = 0; y < linear.height; ++y)
    for (int x = 0; x < linear.width; ++x) {
      const Rgb v = following && y < kBar ? Rgb(1, 0.2f, 0) : linear.rgb_at(x, y) * exposure;
      for (const float channel : {v.r, v.g, v.b})
        out.data.push_back(
            static_cast<unsigned char>(std::lround(255 * linear_to_srgb(std::clamp(channel, 0.0f, 1.0f)))));
    }
  write_png(name, out);
}

void run(const std::string& file, const std::string& object, const std::string& out, int frames) {
  Scene scene = import_scene(file);
  // Ambient terms per vertex want vertices.
  scene = split_large_faces(scene, make_world(scene).bounds.diagonal() / 16);
  Renderer renderer(std::move(scene));
  const World& world = renderer.world();
  if (!renderer.move(object, Vec3(0)))
    throw UsageError("OBJECT", object, "the name of an object of the scene");

  const HostRenderer host{[&](const DrawRequest& r) { return renderer.draw(r); }};
  const TracedScene traced = renderer.traced();
  const float size = world.bounds.diagonal();
  const Detection found = detect_materials(traced.scene, world, host);
  for (const std::string& finding : found.findings) fmt::print("{}\n", finding);
  std::vector<uint32_t> all(world.size());
  for (uint32_t t = 0; t < all.size(); ++t) all[t] = t;
  TransferParams params;
  params.gather = 4096, params.rays = 256, params.keep_sums = true, params.movable = true;
  RealtimeRadiosity radiosity(traced, vertex_receivers(traced),
                              face_cells(all, texels_by_area(world, all, size / 128, 64)), host, found,
                              params);

  const Camera* own = find_camera(traced.scene, "");
  const Vec3 middle = world.bounds.center();
  const Camera camera =
      own != nullptr ? *own : look_at(middle + 0.4f * size * Vec3(0.6f, 0.25f, 0.75f), middle);
  float exposure = 0;
  for (int frame = 0; frame < frames; ++frame) {
    // Camera and lamps move in each frame; the object whenever bounces have caught up.
    const float step = static_cast<float>(frame) / static_cast<float>(std::max(1, frames - 1));
    Camera moved = camera;
    moved.frame[3] += moved.frame[0] * (0.02f * size * step);
    for (Bulb& bulb : renderer.bulbs()) bulb.position.x += 0.002f * size;
    const bool last = frame + 1 == frames;
    if (last) radiosity.wait();
    if (frame > 0 && !last && !radiosity.following()) {
      renderer.move(object, Vec3(0.01f * size, 0, 0));
      radiosity.follow();
    }
    const FrameReport report = radiosity.update();
    if (!report) throw Error(file, report.fault);
    const Image picture = renderer.picture(moved, radiosity.ambient());
    if (exposure == 0) {
      double sum = 0;
      for (const float v : picture.data) sum += static_cast<double>(v);
      exposure = static_cast<float>(0.25 * static_cast<double>(picture.data.size()) / std::max(sum, 1e-9));
    }
    write(fmt::format("{}-{:02}.png", out, frame), picture, exposure, report.following);
    fmt::print("frame {}: drawing {:.0f} ms, bounces {:.1f} ms{}\n", frame, report.capture.milliseconds,
               report.solve_milliseconds, report.following ? ", of the object's old place" : "");
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4 && argc != 5) {
    fmt::print(stderr, "moving SCENE OBJECT OUT [FRAMES]\n");
    return 2;
  }
  try {
    run(argv[1], argv[2], argv[3], argc == 5 ? std::atoi(argv[4]) : 12);
    return 0;
  } catch (const std::exception& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 1;
  }
}
