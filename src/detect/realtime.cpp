// SPDX-License-Identifier: Apache-2.0
#include "detect/realtime.h"

#include <atomic>
#include <chrono>

#include "core/error.h"
#include "core/parallel.h"
#include "core/stopwatch.h"

namespace sconce {

namespace {

constexpr uint32_t kNone = 0xffffffffu;
constexpr int kRings = 4;  // of texels around receivers that filtering may read

Vec3 position_of(const OperatorPoint& p) {
  return {p.position[0], p.position[1], p.position[2]};
}

/// The materials that were found: rows are fitted to light that they reflect. What lets light through has two
/// sides.
Scene found_scene(const TracedScene& traced, const Detection& detection) {
  constexpr float kLeast = 0.5f;  // of black surfaces that shine, or their light would be no light to fit to
  Scene found = with_detected(traced.scene, detection);
  for (std::size_t m = 0; m < found.materials.size(); ++m) {
    const DetectedMaterial& is = detection.materials[m];
    Material& material = found.materials[m];
    if (is.lets_through() || is.two_sided) material.double_sided = true;
    if (is.response.emission.max() > 0 && material.base_color.max() < kLeast)
      material.base_color = Rgb(kLeast);
  }
  return found;
}

}  // namespace

RealtimeRadiosity::RealtimeRadiosity(const TracedScene& traced, const RelightReceivers& receivers,
                                     TextureSpace direct, HostRenderer host, const Detection& detection,
                                     TransferParams params, const Progress& progress)
    : world_(traced.world),
      tracer_(traced.tracer),
      direct_(std::move(direct)),
      host_(std::move(host)),
      detection_(detection) {
  find_backs(detection);
  // Few receivers of a scene are unlike each other: then fewer of them share a basis.
  params.cluster = std::min(params.cluster, 16 * static_cast<int>((receivers.source.count + 4095) / 4096));
  const Scene found = found_scene(traced, detection);
  const TracedScene seen{found, world_, tracer_};
  std::vector<std::vector<float>> ways = tints(detection);
  if (ways.empty()) ways.emplace_back();
  std::vector<Operator> operators;
  for (std::vector<float>& transmission : ways) {
    params.transmission = std::move(transmission);
    if (params.movable) {
      check(params);
      parts_.push_back(
          std::make_unique<OperatorParts>(seen, receivers, params, "", TransferWork{progress, nullptr}));
      operators.push_back(parts_.back()->make({progress, nullptr}));
    } else {
      operators.push_back(make_operator(seen, receivers, params, {}, {progress, nullptr}));
    }
  }
  now_ = make_solver(std::move(operators), detection);
  const Operator& op = transfer();
  ambient_.resize(static_cast<std::size_t>(op.width) * static_cast<std::size_t>(op.height) *
                  static_cast<std::size_t>(op.pages));
  if (op.kind == OperatorReceivers::texels) find_copies();
}

std::unique_ptr<RealtimeRadiosity::Solver> RealtimeRadiosity::make_solver(std::vector<Operator> operators,
                                                                          const Detection& detection) const {
  auto solver = std::make_unique<Solver>(Solver{TintedBounces(std::move(operators)), {}, {}, 0});
  find_faces(*solver);
  set_albedo(*solver, detection);
  return solver;
}

void RealtimeRadiosity::follow() {
  if (parts_.empty())
    throw UsageError("things that move", "an operator that stays", "TransferParams::movable");
  wait();
  next_ = std::async(std::launch::async, [this, detection = detection_] {
    std::vector<Operator> operators;
    for (const std::unique_ptr<OperatorParts>& parts : parts_) operators.push_back(parts->follow({}));
    return make_solver(std::move(operators), detection);
  });
}

void RealtimeRadiosity::wait() {
  if (!next_.valid()) return;
  std::unique_ptr<Solver> next = next_.get();
  next->bounces.go_on_from(now_->bounces);
  now_ = std::move(next);
}

void RealtimeRadiosity::find_backs(const Detection& detection) {
  backs_ = direct_;
  backs_.triangles.clear(), backs_.corners.clear();
  for (std::size_t i = 0; i < direct_.triangles.size(); ++i)
    if (detection.materials[world_.materials[direct_.triangles[i]].value].two_sided) {
      backs_.triangles.push_back(direct_.triangles[i]);
      backs_.corners.push_back(direct_.corners[i]);
    }
  backs_ = backs_.triangles.empty() ? TextureSpace() : mirrored(std::move(backs_));
}

// The operator knows its points by place alone; a ray from just above finds the face again.
void RealtimeRadiosity::find_faces(Solver& solver) const {
  const auto index_of = [&](const TextureSpace& space) {
    std::vector<uint32_t> index(world_.size(), kNone);
    for (uint32_t i = 0; i < space.triangles.size(); ++i) index[space.triangles[i]] = i;
    return index;
  };
  const std::vector<uint32_t> fronts = index_of(direct_), backs = index_of(backs_);
  const std::span<const OperatorPoint> lit = solver.bounces.op().lit;
  solver.faces.assign(lit.size(), {});
  solver.blends.assign(lit.size(), {});
  const float near = 1e-3f * world_.bounds.diagonal();
  std::atomic<std::size_t> uncovered = 0;
  parallel_for(lit.size(), 256, [&](std::size_t i) {
    const Vec3 n = unpack_normal(lit[i].geometric);
    const Hit hit = tracer_.closest({offset_origin(position_of(lit[i]), n, n), -n, near});
    if (hit) solver.faces[i] = {hit.triangle, hit.barycentric};
    const TextureSpace& space = hit.back ? backs_ : direct_;
    const uint32_t face = hit ? (hit.back ? backs : fronts)[hit.triangle] : kNone;
    if (face != kNone) {
      const auto& [a, b, c] = space.corners[face];
      if (const auto blend = blend_at(space, a + hit.barycentric.x * (b - a) + hit.barycentric.y * (c - a))) {
        solver.blends[i] = *blend;
        if (hit.back)
          for (uint32_t& pixel : solver.blends[i].pixels) pixel += static_cast<uint32_t>(direct_.pixels());
        return;
      }
    }
    ++uncovered;
  });
  solver.uncovered = uncovered;
}

void RealtimeRadiosity::find_copies() {
  const Operator& op = transfer();
  const int rows = op.height * op.pages;
  std::vector<uint32_t> from(ambient_.size(), kNone);
  std::vector<uint32_t> front(op.places.begin(), op.places.end());
  for (const uint32_t place : front) from[place] = place;
  for (int ring = 0; ring < kRings; ++ring) {
    std::vector<uint32_t> next;
    for (const uint32_t place : front)
      for (int k = 0; k < 9; ++k) {
        const int x = static_cast<int>(place) % op.width + k % 3 - 1,
                  y = static_cast<int>(place) / op.width + k / 3 - 1;
        if (x < 0 || y < 0 || x >= op.width || y >= rows) continue;
        const auto to = static_cast<uint32_t>(y * op.width + x);
        if (from[to] != kNone) continue;
        from[to] = from[place];
        copies_.push_back({to, from[place]});
        next.push_back(to);
      }
    front = std::move(next);
  }
}

void RealtimeRadiosity::set_materials(const Detection& detection) {
  wait();
  detection_ = detection;
  set_albedo(*now_, detection);
}

void RealtimeRadiosity::set_albedo(Solver& solver, const Detection& detection) const {
  const Operator& op = solver.bounces.op();
  std::vector<Rgb> reflectance(op.albedo.size());
  const std::size_t points = op.lit.size() / reflectance.size();
  for (std::size_t node = 0; node < reflectance.size(); ++node) {
    Rgb sum;
    for (std::size_t i = points * node; i < points * (node + 1); ++i)
      sum += solver.faces[i].triangle != kNone
                 ? detection.at(world_, solver.faces[i].triangle, solver.faces[i].barycentric).reflectance
                 : unpack_albedo(op.lit[i].albedo);
    reflectance[node] = sum / static_cast<float>(points);
  }
  solver.bounces.set_reflectance(reflectance);
}

FrameReport RealtimeRadiosity::update(const FrameBudget& budget) {
  FrameReport report;
  if (next_.valid() && next_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) wait();
  report.following = next_.valid();
  const Operator& op = transfer();
  const std::vector<PixelBlend>& blends = now_->blends;
  DrawRequest request;
  request.lights = DrawRequest::Lights::all;
  Captured direct;
  try {
    Captured backs;
    if (!backs_.triangles.empty()) backs = capture_once(host_, backs_, request, "direct light on backs");
    // A renderer that lit backs draws: fronts in the dark need no second look.
    const bool lit =
        std::any_of(backs.light.begin(), backs.light.end(), [](const Rgb& e) { return e.max() > 0; });
    direct = lit ? capture_once(host_, direct_, request, "direct light")
                 : capture(host_, direct_, request, "direct light");
    direct.append(backs);
  } catch (const Error& e) {
    report.fault = e.what();
    std::fill(ambient_.begin(), ambient_.end(), Rgb());
    return report;
  }
  report.capture = direct.cost;

  const Stopwatch solving;
  // What is drawn has its reflectance and its emission in it already: it is all that leaves the surface.
  std::vector<Rgbx> light(op.slots());
  std::atomic<std::size_t> clipped = 0;
  const std::size_t points = op.points_per_slot;
  parallel_for(light.size(), 256, [&](std::size_t slot) {
    Rgb sum;
    for (std::size_t i = points * slot; i < points * (slot + 1); ++i) {
      bool bright = false;
      for (std::size_t k = 0; k < 4; ++k) {
        const float weight = blends[i].weights[k];
        if (weight == 0) continue;
        sum += weight * direct.light[blends[i].pixels[k]];
        bright = bright || direct.is_clipped(blends[i].pixels[k]);
      }
      if (bright) ++clipped;
    }
    sum *= 1 / static_cast<float>(points);
    light[slot] = {sum.r, sum.g, sum.b, 0};
  });
  report.clipped = clipped;
  report.coarse = now_->bounces.solve(light, budget, solving);
  for (std::size_t i = 0; i < op.places.size(); ++i) ambient_[op.places[i]] = now_->bounces.light(i);
  for (const Copy& copy : copies_) ambient_[copy.to] = ambient_[copy.from];
  report.solve_milliseconds = solving.milliseconds();
  return report;
}

}  // namespace sconce
