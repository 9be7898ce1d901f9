// SPDX-License-Identifier: Apache-2.0
#include "receive/density.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <tuple>

#include "core/parallel.h"
#include "core/sobol.h"

namespace sconce {

namespace {

constexpr uint32_t kCameraPaths = 1u << 17, kLampPaths = 1u << 17;
constexpr int kVertices = 4;           // per path: the first hit and three bounces
constexpr uint32_t kCameraWeight = 4;  // a surface in the picture matters more than one that lights it
constexpr double kFullDensity = 0.1;   // relative hits from which on density is full
constexpr double kReachedBack = 0.02;  // relative hits from which on a back is lit and seen
constexpr double kUnseen = 0.01;       // relative hits below which a triangle is kept apart from seen ones
constexpr double kMostSpent = 30;      // texels spent on a patch per texel of its seen part
constexpr double kCellVisits = 400;    // on an ordinary surface
constexpr uint32_t kNobody = 0xffffffffu;
constexpr double kEnough = 8;  // hits expected at kFullDensity before their absence says something

Vec2 triangle_point(Vec2 u) {
  const float s = std::sqrt(u.x);
  return {s * (1 - u.y), s * u.y};
}

/// Emissive triangles and lamps as starting points.
class Starts {
 public:
  Starts(const Scene& scene, const World& world, const MeshGraph& graph) : scene_(scene), world_(world) {
    // Half by area, half by flux: large dim windows and small bright lamps both light what can be seen.
    double area = 0, flux = 0;
    std::vector<double> weights;
    for (uint32_t t = 0; t < world.size(); ++t) {
      const Material& material = scene[world.materials[t]];
      if (!material.emits()) continue;
      triangles_.push_back(t);
      area += static_cast<double>(graph.areas[t]);
      flux += static_cast<double>(graph.areas[t] * luminance(material.emission));
    }
    double sum = 0;
    for (const uint32_t t : triangles_) {
      const double a = static_cast<double>(graph.areas[t]);
      const double l = static_cast<double>(luminance(scene[world.materials[t]].emission));
      sum += 0.5 * a / area + (flux > 0 ? 0.5 * a * l / flux : 0.0);
      cumulative_.push_back(sum);
    }
  }

  std::size_t lamps() const { return scene_.lights.size() + (triangles_.empty() ? 0 : 1); }

  /// A ray of the lamp, or one without direction.
  Ray ray(std::size_t lamp, Vec2 u, Vec2 v, Vec2 w) const {
    if (lamp < scene_.lights.size()) return ray_of(scene_.lights[lamp], u, v);
    const double at = static_cast<double>(w.x) * cumulative_.back();
    const auto it = std::upper_bound(cumulative_.begin(), cumulative_.end(), at);
    const std::size_t i = std::min(static_cast<std::size_t>(it - cumulative_.begin()), triangles_.size() - 1);
    const uint32_t t = triangles_[i];
    const bool back = scene_[world_.materials[t]].double_sided && w.y < 0.5f;
    const Vec3 n = back ? -world_.face_normals[t] : world_.face_normals[t];
    const Vec3 direction = Frame(n).to_world(square_to_cosine(v));
    return {offset_origin(world_.position(t, triangle_point(u)), n, direction), direction};
  }

 private:
  Ray ray_of(const Light& light, Vec2 u, Vec2 v) const {
    const Vec3 place(light.frame[3]);
    const Vec3 forward = normalize_or(-Vec3(light.frame[2]), Vec3(0, -1, 0));
    const float radius = 0.51f * world_.bounds.diagonal();
    if (std::holds_alternative<PointLight>(light.shape)) return {place, square_to_sphere(u)};
    if (const auto* measured = std::get_if<LuminaireLight>(&light.shape)) {
      // Where it is dark, the ray goes the other way: a downlight lights no attic.
      const Vec3 local = square_to_sphere(u);
      const bool lit = intensity(scene_[measured->luminaire].photometry, local) > 0;
      return {place, glm::normalize(Mat3(light.frame) * (lit ? local : -local))};
    }
    if (const auto* spot = std::get_if<SpotLight>(&light.shape)) {
      const float c = 1 - u.x * (1 - std::cos(std::min(spot->outer, kPi))), phi = 2 * kPi * u.y;
      const float s = std::sqrt(std::max(0.0f, 1 - c * c));
      return {place, glm::normalize(Frame(forward).to_world(Vec3(s * std::cos(phi), s * std::sin(phi), c)))};
    }
    if (const auto* projector = std::get_if<ProjectorLight>(&light.shape)) {
      const float half = std::tan(0.5f * projector->yfov);
      const Vec3 local((2 * u.x - 1) * half * projector->aspect, (2 * u.y - 1) * half, -1);
      return {place, glm::normalize(Mat3(light.frame) * local)};
    }
    const bool sun = std::holds_alternative<SunLight>(light.shape);
    const Vec3 direction = sun ? forward : square_to_sphere(v);
    const float r = radius * std::sqrt(u.x), phi = 2 * kPi * u.y;
    const Vec3 disk = Frame(direction).to_world(Vec3(r * std::cos(phi), r * std::sin(phi), -2 * radius));
    return {world_.bounds.center() + disk, direction};
  }

  const Scene& scene_;
  const World& world_;
  std::vector<uint32_t> triangles_;
  std::vector<double> cumulative_;
};

Ray camera_ray(const Camera& camera, Vec2 u) {
  const float h = std::tan(0.5f * camera.yfov);
  const Vec3 d = Mat3(camera.frame) * Vec3((2 * u.x - 1) * h * camera.aspect, (1 - 2 * u.y) * h, -1);
  return {Vec3(camera.frame[3]), normalize_or(d, Vec3(0))};
}

/// Weight per m2 of the smallest area that takes nine tenths of all visits.
double ordinary(const std::vector<uint64_t>& weights, const MeshGraph& graph) {
  std::vector<uint32_t> order;
  double total = 0;
  for (uint32_t i = 0; i < weights.size(); ++i)
    if (weights[i] > 0) order.push_back(i), total += static_cast<double>(weights[i]);
  const auto density = [&](uint32_t i) {
    return static_cast<double>(weights[i]) / static_cast<double>(graph.areas[i / 2]);
  };
  std::sort(order.begin(), order.end(),
            [&](uint32_t a, uint32_t b) { return std::tuple(-density(a), a) < std::tuple(-density(b), b); });
  double sum = 0, area = 0;
  for (const uint32_t i : order) {
    if (sum >= 0.9 * total) break;
    sum += static_cast<double>(weights[i]);
    area += static_cast<double>(graph.areas[i / 2]);
  }
  return std::max(area > 0 ? sum / area : 0.0, 1e-6);
}

struct Vertex {
  uint32_t side = kNobody, weight = 0;
  Vec3 position;
};

/// Sorted and summed by side and cell.
Visibility tally(const std::vector<Vertex>& vertices, const World& world, const MeshGraph& graph) {
  Visibility seen;
  std::vector<uint64_t> weights(2 * world.size(), 0);
  for (const Vertex& v : vertices)
    if (v.side != kNobody) weights[v.side] += v.weight;
  seen.reference = ordinary(weights, graph);
  // A few hundred visits on an ordinary surface, so that their number means something.
  seen.cell_area = kCellVisits / seen.reference;
  const double step = std::sqrt(seen.cell_area);
  std::vector<Visibility::Visit> all;
  for (const Vertex& v : vertices) {
    if (v.side == kNobody) continue;
    const glm::dvec3 p = glm::dvec3(v.position - world.bounds.lo) / step;
    const auto index = [](double x) { return static_cast<uint64_t>(std::clamp(x, 0.0, 2097151.0)); };
    all.push_back({v.side, v.weight, index(p.x) | index(p.y) << 21 | index(p.z) << 42});
  }
  const auto key = [](const Visibility::Visit& v) { return std::pair(v.side, v.cell); };
  std::sort(all.begin(), all.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
  for (const Visibility::Visit& visit : all) {
    if (!seen.visits.empty() && key(seen.visits.back()) == key(visit))
      seen.visits.back().weight += visit.weight;
    else
      seen.visits.push_back(visit);
  }
  seen.first.assign(2 * world.size() + 1, 0);
  for (const Visibility::Visit& visit : seen.visits) ++seen.first[visit.side + 1];
  std::partial_sum(seen.first.begin(), seen.first.end(), seen.first.begin());
  return seen;
}

}  // namespace

Visibility probe_visibility(const Scene& scene, const World& world, const MeshGraph& graph,
                            const Tracer& tracer, uint32_t seed, const Progress& progress) {
  const Starts starts(scene, world, graph);
  const std::size_t cameras = scene.cameras.size(), lamps = starts.lamps();
  if (cameras + lamps == 0) {
    // Nothing looks and nothing shines: fronts count as seen.
    std::vector<Vertex> vertices;
    for (uint32_t t = 0; t < world.size(); ++t)
      vertices.push_back({2 * t, 1u + static_cast<uint32_t>(std::min(1e4f * graph.areas[t], 1e9f)),
                          world.position(t, Vec2(1.0f / 3))});
    return tally(vertices, world, graph);
  }
  const uint32_t camera_paths = cameras > 0 ? kCameraPaths : 0, lamp_paths = lamps > 0 ? kLampPaths : 0;
  std::vector<Vertex> vertices(std::size_t{camera_paths + lamp_paths} * kVertices);
  constexpr std::size_t kBlock = 4096;
  const std::size_t blocks = (camera_paths + lamp_paths) / kBlock;
  std::atomic<uint64_t> done = 0;
  parallel_for(blocks, 1, [&](std::size_t block) {
    progress.check();
    for (uint32_t path = static_cast<uint32_t>(block * kBlock); path < (block + 1) * kBlock; ++path) {
      const bool from_camera = path < camera_paths;
      const uint32_t local = from_camera ? path : path - camera_paths;
      const auto sources = static_cast<uint32_t>(from_camera ? cameras : lamps);
      const uint32_t source = local % sources;
      Sampler sampler(seed ^ 0x70726f62u, source + (from_camera ? 0u : 0x10000u), local / sources);
      const Vec2 u = sampler.next();
      Ray ray;
      if (from_camera) {
        ray = camera_ray(scene.cameras[source], u);
      } else {
        const Vec2 v = sampler.next();
        ray = starts.ray(source, u, v, sampler.next());
      }
      if (!(glm::dot(ray.direction, ray.direction) > 0.5f)) continue;
      for (int vertex = 0; vertex < kVertices; ++vertex) {
        const Hit hit = tracer.follow(ray, [&] { return sampler.next().x; }).hit;
        if (!hit) break;
        const Vec3 position = world.position(hit.triangle, hit.barycentric);
        vertices[std::size_t{path} * kVertices + static_cast<std::size_t>(vertex)] = {
            2 * hit.triangle + (hit.back ? 1 : 0), from_camera && vertex == 0 ? kCameraWeight : 1, position};
        if (hit.back && !scene[world.materials[hit.triangle]].double_sided) break;  // black
        const Vec3 n = hit.back ? -world.face_normals[hit.triangle] : world.face_normals[hit.triangle];
        const Vec3 direction = Frame(n).to_world(square_to_cosine(sampler.next()));
        ray = {offset_origin(position, n, direction), direction};
      }
    }
    progress.at("visibility", ++done, blocks);
  });
  return tally(vertices, world, graph);
}

uint64_t Visibility::weight(uint32_t side) const {
  uint64_t sum = 0;
  for (uint32_t i = first[side]; i < first[side + 1]; ++i) sum += visits[i].weight;
  return sum;
}

float density_scale(const Visibility& seen, const MeshGraph& graph, const Patch& patch, bool back,
                    float least) {
  double area = 0, total = 0;
  std::map<uint64_t, double> cells;
  for (const uint32_t t : patch) {
    area += static_cast<double>(graph.areas[t]);
    const uint32_t side = 2 * t + (back ? 1 : 0);
    for (uint32_t i = seen.first[side]; i < seen.first[side + 1]; ++i) {
      cells[seen.visits[i].cell] += seen.visits[i].weight;
      total += seen.visits[i].weight;
    }
  }
  area = std::max(area, 1e-20);
  // The smallest part of the patch that takes nine tenths of its visits.
  std::vector<double> weights;
  for (const auto& [cell, weight] : cells) weights.push_back(weight);
  std::sort(weights.begin(), weights.end(), std::greater<>());
  double sum = 0;
  std::size_t used = 0;
  while (used < weights.size() && sum < 0.9 * total) sum += weights[used++];
  const double seen_area = std::min(area, static_cast<double>(used) * seen.cell_area);
  const double doubt = 1.0 / (area * seen.reference);  // one visit more than was counted
  const double relative = (seen_area > 0 ? sum / (seen_area * seen.reference) : 0.0) + doubt;
  const double share = std::min(1.0, kMostSpent * seen_area / area + doubt / kFullDensity);
  return std::clamp(static_cast<float>(std::sqrt(std::min(1.0, relative / kFullDensity) * share)), least,
                    1.0f);
}

std::vector<double> importances(const Visibility& seen, const MeshGraph& graph, const Patch& patch,
                                bool back) {
  std::vector<double> visits, expected;
  for (const uint32_t t : patch) {
    visits.push_back(static_cast<double>(seen.weight(2 * t + (back ? 1 : 0))));
    expected.push_back(static_cast<double>(graph.areas[t]) * seen.reference);
  }
  const double sum = std::accumulate(visits.begin(), visits.end(), 0.0);
  if (!(sum > 0)) return std::vector<double>(patch.size(), 0.0);
  // A gamma distribution around the mean, as if kEnough visits had been counted before.
  const double before = kEnough * std::accumulate(expected.begin(), expected.end(), 0.0) / sum;
  std::vector<double> out;
  for (std::size_t i = 0; i < patch.size(); ++i)
    out.push_back((visits[i] + kEnough) / (expected[i] + before));
  return out;
}

bool is_reached(const Visibility& seen, const Patch& patch, bool back) {
  return std::ranges::any_of(patch, [&](uint32_t t) { return seen.weight(2 * t + (back ? 1 : 0)) > 0; });
}

bool back_is_reached(const Visibility& seen, const MeshGraph& graph, const Patch& patch) {
  double sum = 0, area = 0;
  for (const uint32_t t : patch) {
    sum += static_cast<double>(seen.weight(2 * t + 1));
    area += static_cast<double>(graph.areas[t]);
  }
  return sum > kReachedBack * area * seen.reference;
}

std::vector<uint8_t> unseen_triangles(const Visibility& seen, const MeshGraph& graph) {
  std::vector<uint8_t> result(graph.size(), 0);
  for (uint32_t t = 0; t < graph.size(); ++t) {
    const double expected = static_cast<double>(graph.areas[t]) * seen.reference;
    result[t] =
        expected * kFullDensity >= kEnough && static_cast<double>(seen.weight(2 * t)) < kUnseen * expected
            ? 1
            : 0;
  }
  return result;
}

}  // namespace sconce
