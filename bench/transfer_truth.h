// SPDX-License-Identifier: Apache-2.0
// What moved lamps' indirect light is held against: lamps at random places, and converged paths over boxes of
// pixels.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/parallel.h"
#include "core/sobol.h"
#include "relight/moved_lamps.h"
#include "relight/receivers.h"
#include "solve/solver.h"

namespace sconce {

/// Lamps in free space that is seen: between a random receiver and the camera, or along a random ray; every
/// other one a spot.
inline std::vector<Light> random_lamps(const View& view, const Operator& op, int count, uint32_t seed) {
  std::vector<Light> lamps;
  // By places, whatever the operator's own order is.
  std::vector<std::pair<uint32_t, uint32_t>> by_place;
  for (uint32_t i = 0; i < op.places.size(); ++i) by_place.emplace_back(op.places[i], i);
  std::sort(by_place.begin(), by_place.end());
  for (uint32_t i = 0; static_cast<int>(lamps.size()) < count && i < 10000; ++i) {
    Sampler sampler(seed, 0x6c616d70u, i);
    const Vec2 pick = sampler.next(), along = sampler.next(), aim = sampler.next(), shape = sampler.next();
    const auto& r =
        op.receivers[by_place[static_cast<std::size_t>(pick.x * static_cast<float>(by_place.size()))].second];
    const Vec3 from(r.position[0], r.position[1], r.position[2]), n = unpack_normal(r.geometric);
    Vec3 direction = Frame(n).to_world(square_to_cosine(along));
    float distance = view.tracer().closest({offset_origin(from, n, direction), direction}).distance;
    if (op.kind == OperatorReceivers::pixels) {
      const Vec3 to_eye = Vec3(op.camera_frame[3]) - from;
      distance = glm::length(to_eye), direction = to_eye / distance;
    }
    if (distance < 0.05f * view.world().bounds.diagonal()) continue;
    Light light;
    light.name = light.group_name = fmt::format("lamp {}", lamps.size());
    light.intensity = Rgb(100);
    const Vec3 at = from + (0.2f + 0.6f * pick.y) * distance * direction;
    const Vec3 z = -Frame(direction).to_world(square_to_cosine(aim));
    const Frame frame(z);
    light.frame = Mat4(glm::vec4(frame.x, 0), glm::vec4(frame.y, 0), glm::vec4(z, 0), glm::vec4(at, 1));
    if (lamps.size() % 2 == 1) {
      SpotLight spot;
      spot.outer = 0.35f + 0.45f * shape.x, spot.inner = 0.8f * spot.outer;
      light.shape = spot;
    }
    lamps.push_back(std::move(light));
  }
  return lamps;
}

/// Receivers, by their number in the operator, whose mean is looked at: side x side pixels, or a texel.
using Boxes = std::vector<std::vector<uint32_t>>;

/// So many of all, evenly by place.
inline Boxes make_boxes(const Operator& op, std::size_t count, uint32_t side) {
  const auto width = static_cast<uint32_t>(op.width);
  const bool pixels = op.kind == OperatorReceivers::pixels;
  std::map<uint32_t, std::vector<uint32_t>> all;
  for (uint32_t i = 0; i < op.places.size(); ++i) {
    const uint32_t place = op.places[i];
    all[pixels ? place / width / side * width + place % width / side : place].push_back(i);
  }
  Boxes boxes;
  std::size_t k = 0;
  for (auto& [place, box] : all)
    if (count * k++ / all.size() == boxes.size()) boxes.push_back(std::move(box));
  return boxes;
}

/// Indirect light of each lamp on boxes: luminance of its illuminance, lux.
struct Truth {
  std::vector<std::vector<double>> light, squared_noise;  ///< per lamp, per box
};

/// By paths. @param paths  per box
inline Truth trace_truth(const View& view, const Operator& op, const std::vector<Light>& lamps,
                         const Boxes& boxes, int paths) {
  // Every lamp is a group of one scene, so that one set of paths serves all.
  Scene scene = view.scene();
  scene.lights = lamps;
  scene.groups.clear();
  for (Material& material : scene.materials) material.emission = Rgb(0);
  for (Light& light : scene.lights) {
    light.group = Id<LightGroup>(scene.groups.size());
    scene.groups.push_back({light.name});
  }
  const Lamps all(scene, view.world());
  BakeParams params;
  params.samples = std::max(kBatches, paths / static_cast<int>(boxes.at(0).size()));
  const auto solver = find_solver("path").prepare({scene, view.world(), view.tracer(), all}, params, {});
  const std::size_t groups = lamps.size();
  Truth truth;
  truth.light.assign(groups, std::vector<double>(boxes.size()));
  truth.squared_noise = truth.light;
  std::vector<std::unique_ptr<MovedLamps>> moved;
  for (const Light& lamp : lamps)
    moved.push_back(std::make_unique<MovedLamps>(view.scene(), view.world(), view.tracer(),
                                                 MoreLights{{lamp}}, std::span<const MovedGroup>()));
  parallel_for(boxes.size(), 1, [&](std::size_t k) {
    const auto n = static_cast<double>(boxes[k].size());
    std::vector<GroupValue> values(groups);
    for (const uint32_t i : boxes[k]) {
      const SurfacePoint at = point_of(op.receivers[i]);
      solver->solve(Footprint::point(i, ReceiverKind::texel, at), values);
      for (std::size_t g = 0; g < groups; ++g) {
        const auto error = static_cast<double>(values[g].error);
        truth.light[g][k] +=
            static_cast<double>(luminance(values[g].illuminance - moved[g]->illuminance(at, 0, 0))) / n;
        truth.squared_noise[g][k] += error * error / (n * n);
      }
    }
  });
  return truth;
}

/// Of lamps of one kind.
struct Errors {
  double mean = 0, rmse = 0, worst = 0, noise = 0;
  int lamps = 0;

  /// One lamp more: what boxes have beside what they should, whose noise is taken off.
  void add(const std::vector<double>& have, const Truth& truth, std::size_t lamp) {
    double sum = 0, expected = 0, squares = 0, squared_noise = 0;
    const std::vector<double>& want = truth.light[lamp];
    for (std::size_t k = 0; k < want.size(); ++k) {
      sum += have[k], expected += want[k];
      squares += (have[k] - want[k]) * (have[k] - want[k]);
      squared_noise += truth.squared_noise[lamp][k];
    }
    const auto n = static_cast<double>(want.size());
    const double one = std::sqrt(std::max(0.0, squares - squared_noise) / n) / (expected / n);
    mean += sum / expected, rmse += one, worst = std::max(worst, one);
    noise += std::sqrt(squared_noise / n) / (expected / n);
    ++lamps;
  }
  std::string text() const {
    return fmt::format("mean {:.3f}, relative RMSE {:.1f} %, worst {:.1f} %, noise taken off {:.1f} %",
                       mean / lamps, 100 * rmse / lamps, 100 * worst, 100 * noise / lamps);
  }
};

/// Means over boxes of what receivers have.
inline std::vector<double> over_boxes(const Boxes& boxes, std::span<const Rgb> light) {
  std::vector<double> out;
  for (const std::vector<uint32_t>& box : boxes) {
    double sum = 0;
    for (const uint32_t i : box) sum += static_cast<double>(luminance(light[i]));
    out.push_back(sum / static_cast<double>(box.size()));
  }
  return out;
}

}  // namespace sconce
