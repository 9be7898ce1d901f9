// SPDX-License-Identifier: Apache-2.0
// How much of a bake is rays: the rays of a bake's own paths, recorded, then replayed through bare Embree
// calls with the same flags and threads. Default: modern-hall below SCONCE_TEST_DATA at 512 x 512 texels, 64
// samples, 8 bounces; or replay SCENE. Every 16th tile is measured: all rays at once would not fit in memory.
#include <embree3/rtcore.h>
#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <chrono>
#include <cstdlib>

#include "core/parallel.h"
#include "import/import.h"
#include "receive/atlas.h"
#include "scene/groups.h"
#include "solve/path_kernel.h"

using namespace sconce;

namespace {

constexpr std::size_t kEvery = 16;

struct Recorded {
  Ray ray;
  bool shadow;
};

/// Passes rays on to a Tracer and remembers them.
struct Recorder {
  const Tracer& tracer;
  std::vector<Recorded>& rays;

  template <class Random>
  Passage follow(const Ray& ray, Random&& random) const {
    rays.push_back({ray, false});
    return tracer.follow(ray, random);
  }
  Rgb transmittance(const Ray& ray) const {
    rays.push_back({ray, true});
    return tracer.transmittance(ray);
  }
};

RTCScene bare_scene(RTCDevice device, const World& world) {
  RTCScene scene = rtcNewScene(device);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<Vec3*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Vec3), world.positions.size()));
  auto* triangles = static_cast<Triangle*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(Triangle), world.triangles.size()));
  std::copy(world.positions.begin(), world.positions.end(), vertices);
  std::copy(world.triangles.begin(), world.triangles.end(), triangles);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene);
  return scene;
}

/// @return what the rays met, so that nothing is optimised away
uint64_t replay(RTCScene scene, const std::vector<Recorded>& rays) {
  uint64_t hits = 0;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  for (const auto& [ray, shadow] : rays) {
    RTCRayHit query;
    RTCRay& r = query.ray;
    r.org_x = ray.origin.x, r.org_y = ray.origin.y, r.org_z = ray.origin.z;
    r.dir_x = ray.direction.x, r.dir_y = ray.direction.y, r.dir_z = ray.direction.z;
    r.tnear = 0, r.tfar = ray.far, r.time = 0, r.mask = 0xffffffffu, r.id = 0, r.flags = 0;
    if (shadow) {
      rtcOccluded1(scene, &context, &r);
      hits += r.tfar < 0;
    } else {
      query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
      rtcIntersect1(scene, &context, &query);
      hits += query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
    }
  }
  return hits;
}

double timed(const std::function<void()>& f) {
  const auto start = std::chrono::steady_clock::now();
  f();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

int main(int argc, char** argv) {
  const char* data = std::getenv("SCONCE_TEST_DATA");
  const std::string path =
      argc > 1 ? argv[1] : std::string(data != nullptr ? data : "../shared/data") + "/glb/modern-hall.glb";
  try {
    Scene scene = import_scene(path);
    assign_groups(scene, Grouping::automatic);
    const World world = make_world(scene);
    const Tracer tracer(scene, world);
    const Lamps lamps(scene, world);
    AtlasParams atlas_params;
    atlas_params.page_size = 512;
    Atlas atlas = make_atlas(scene, world, tracer, atlas_params);
    const TexelReceivers receivers(world, tracer, atlas);
    BakeParams params;
    params.samples = 64;
    params.bounces = 8;

    const std::size_t tiles = (receivers.tiles() + kEvery - 1) / kEvery;
    const auto each = [&](std::size_t k, const auto& rays) {
      PathKernel kernel(scene, world, rays, lamps, params.bounces);
      std::vector<GroupValue> out(scene.groups.size());
      const std::size_t first = k * kEvery * TexelReceivers::kTile;
      for (std::size_t i = first; i < std::min(receivers.size(), first + TexelReceivers::kTile); ++i)
        solve_receiver(kernel, receivers.footprint(i), params, out);
    };
    std::vector<std::vector<Recorded>> recorded(tiles);
    parallel_for(tiles, 1, [&](std::size_t k) { each(k, Recorder{tracer, recorded[k]}); });
    uint64_t count = 0;
    for (const auto& rays : recorded) count += rays.size();

    const RTCDevice device = rtcNewDevice(nullptr);
    const RTCScene bare = bare_scene(device, world);
    std::vector<double> ratios;
    for (int round = 0; round < 5; ++round) {
      const double bake = timed([&] { parallel_for(tiles, 1, [&](std::size_t k) { each(k, tracer); }); });
      std::vector<uint64_t> hits(tiles);
      const double rays =
          timed([&] { parallel_for(tiles, 1, [&](std::size_t k) { hits[k] = replay(bare, recorded[k]); }); });
      ratios.push_back(rays / bake);
      fmt::print("bake {:.3f} s, its {:.1f} M rays replayed {:.3f} s ({:.1f} M rays/s): {:.1f} %\n", bake,
                 static_cast<double>(count) / 1e6, rays, static_cast<double>(count) / rays / 1e6,
                 100 * rays / bake);
    }
    std::sort(ratios.begin(), ratios.end());
    fmt::print("median: rays are {:.1f} % of the bake's time ({} receivers of {}, {} threads)\n",
               100 * ratios[2], tiles * TexelReceivers::kTile, receivers.size(),
               tbb::this_task_arena::max_concurrency());
    rtcReleaseScene(bare);
    rtcReleaseDevice(device);
  } catch (const std::exception& error) {
    fmt::print(stderr, "replay: {}\n", error.what());
    return 1;
  }
}
