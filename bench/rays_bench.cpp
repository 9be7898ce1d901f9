// SPDX-License-Identifier: Apache-2.0
// How many rays a second: closest hits and shadow rays in a room full of spheres, one thread and all of them.
#include <benchmark/benchmark.h>

#include <memory>

#include "core/parallel.h"
#include "core/sobol.h"
#include "trace/tracer.h"

using namespace sconce;

namespace {

constexpr float kRoom = 10;  ///< m, edge of the cube
constexpr int kSpheresPerEdge = 5;
constexpr uint32_t kRays = 1u << 16, kBatch = 256;

Vec3 on_sphere(Vec2 u) {
  const float z = 1 - 2 * u.x, r = std::sqrt(std::max(0.0f, 1 - z * z)), phi = 2 * kPi * u.y;
  return {r * std::cos(phi), r * std::sin(phi), z};
}

Mesh make_sphere(uint32_t rings, uint32_t segments) {
  Mesh mesh;
  mesh.material = Id<Material>(0);
  for (uint32_t i = 0; i <= rings; ++i) {
    for (uint32_t j = 0; j <= segments; ++j) {
      const float theta = kPi * static_cast<float>(i) / static_cast<float>(rings);
      const float phi = 2 * kPi * static_cast<float>(j) / static_cast<float>(segments);
      mesh.positions.emplace_back(std::sin(theta) * std::cos(phi), std::cos(theta),
                                  -std::sin(theta) * std::sin(phi));
    }
  }
  for (uint32_t i = 0; i < rings; ++i) {
    for (uint32_t j = 0; j < segments; ++j) {
      const uint32_t a = i * (segments + 1) + j, b = a + segments + 1;
      mesh.triangles.push_back({{a, b, b + 1}});
      mesh.triangles.push_back({{a, b + 1, a + 1}});
    }
  }
  return mesh;
}

/// Unit cube [0,1]^3 seen from inside.
Mesh make_room() {
  Mesh mesh;
  mesh.material = Id<Material>(0);
  for (uint32_t i = 0; i < 8; ++i) mesh.positions.emplace_back(i & 1, i >> 1 & 1, i >> 2);
  for (const auto& q : {std::array{0u, 1u, 3u, 2u},
                        {4u, 6u, 7u, 5u},
                        {0u, 2u, 6u, 4u},
                        {1u, 5u, 7u, 3u},
                        {0u, 4u, 5u, 1u},
                        {2u, 3u, 7u, 6u}}) {
    mesh.triangles.push_back({{q[0], q[1], q[2]}});
    mesh.triangles.push_back({{q[0], q[2], q[3]}});
  }
  return mesh;
}

struct Room {
  Scene scene;
  std::unique_ptr<World> world;
  std::unique_ptr<Tracer> tracer;
  std::vector<Ray> rays;

  Room() {
    scene.materials.emplace_back();
    scene.meshes = {make_room(), make_sphere(32, 32)};
    const auto place = [&](std::size_t mesh, const Vec3& at, float scale) {
      Instance instance;
      instance.mesh = Id<Mesh>(mesh);
      instance.transform = Mat4(scale);
      instance.transform[3] = {at.x, at.y, at.z, 1};
      scene.instances.push_back(instance);
    };
    place(0, Vec3(0), kRoom);
    constexpr float kSpacing = kRoom / kSpheresPerEdge;
    for (int i = 0; i < kSpheresPerEdge * kSpheresPerEdge * kSpheresPerEdge; ++i) {
      const Vec3 cell(i % kSpheresPerEdge, i / kSpheresPerEdge % kSpheresPerEdge,
                      i / (kSpheresPerEdge * kSpheresPerEdge));
      place(1, (cell + 0.5f) * kSpacing, 0.35f * kSpacing);
    }
    world = std::make_unique<World>(make_world(scene));
    tracer = std::make_unique<Tracer>(scene, *world);
    for (uint32_t i = 0; i < kRays;
         ++i) {  // from the walls of the cells into all directions: incoherent, as in a bake
      Sampler sampler(1, 0, i);
      const Vec2 a = sampler.next(), b = sampler.next(), c = sampler.next();
      const Vec3 origin(std::floor(a.x * kSpheresPerEdge) * kSpacing + 0.01f, 0.01f + 0.98f * kRoom * a.y,
                        0.01f + 0.98f * kRoom * b.x);
      rays.push_back({origin, on_sphere(c), 1e30f});
    }
  }
};

const Room& room() {
  static const Room made;
  return made;
}

/// @param trace  true on a hit
template <class Trace>
void measure(benchmark::State& state, const Trace& trace) {
  const Room& r = room();
  const ThreadLimit limit(static_cast<int>(state.range(0)));
  std::vector<uint32_t> hits(kRays / kBatch);
  for (auto _ : state) {
    parallel_for(hits.size(), 1, [&](std::size_t batch) {
      uint32_t count = 0;
      for (uint32_t i = 0; i < kBatch; ++i) count += trace(*r.tracer, r.rays[batch * kBatch + i]) ? 1u : 0u;
      hits[batch] = count;
    });
    benchmark::DoNotOptimize(hits.data());
  }
  double hit = 0;
  for (const uint32_t count : hits) hit += count;
  state.counters["rays/s"] =
      benchmark::Counter(static_cast<double>(state.iterations()) * kRays, benchmark::Counter::kIsRate);
  state.counters["hit share"] = hit / kRays;
  state.counters["triangles"] = static_cast<double>(r.world->size());
}

void closest(benchmark::State& state) {
  measure(state, [](const Tracer& tracer, const Ray& ray) { return static_cast<bool>(tracer.closest(ray)); });
}

void occluded(benchmark::State& state) {
  measure(state, [](const Tracer& tracer, const Ray& ray) {
    Ray shadow = ray;
    shadow.far = 0.5f * kRoom;
    return tracer.occluded(shadow);
  });
}

}  // namespace

BENCHMARK(closest)->ArgName("threads")->Arg(1)->Arg(0)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(occluded)->ArgName("threads")->Arg(1)->Arg(0)->UseRealTime()->Unit(benchmark::kMillisecond);
