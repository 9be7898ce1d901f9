// SPDX-License-Identifier: Apache-2.0
#include "detect/realtime.h"

#include <atomic>
#include <chrono>

#include "core/error.h"
#include "core/parallel.h"

namespace sconce {

namespace {

constexpr uint32_t kNone = 0xffffffffu;
constexpr int kRings = 4;  // of texels around receivers that filtering may read

Vec3 position_of(const OperatorPoint& p) {
  return {p.position[0], p.position[1], p.position[2]};
}

TransferParams with_transmission(TransferParams params, const Detection& detection) {
  bool any = false;
  for (const DetectedMaterial& m : detection.materials) {
    const Rgb& t = m.response.transmission;
    params.transmission.push_back((t.r + t.g + t.b) / 3);
    any = any || params.transmission.back() > 0.01f;  // below it is rounding
  }
  if (!any) params.transmission.clear();
  return params;
}

}  // namespace

RealtimeRadiosity::RealtimeRadiosity(const TracedScene& traced, const RelightReceivers& receivers,
                                     TextureSpace direct, HostRenderer host, const Detection& detection,
                                     TransferParams params, const Progress& progress)
    : world_(traced.world),
      direct_(std::move(direct)),
      host_(std::move(host)),
      op_(make_operator(traced, receivers, with_transmission(std::move(params), detection), {},
                        {progress, nullptr})),
      indirect_(op_.gather.rows),
      ambient_(static_cast<std::size_t>(op_.width) * static_cast<std::size_t>(op_.height) *
               static_cast<std::size_t>(op_.pages)) {
  find_faces(traced);
  if (op_.kind == OperatorReceivers::texels) find_copies();
  set_materials(detection);
}

// The operator knows its points by place alone; a ray from just above finds the face again.
void RealtimeRadiosity::find_faces(const TracedScene& traced) {
  std::vector<uint32_t> index(world_.size(), kNone);
  for (uint32_t i = 0; i < direct_.triangles.size(); ++i) index[direct_.triangles[i]] = i;
  faces_.assign(op_.lit.size(), kNone);
  blends_.assign(op_.lit.size(), {});
  const float near = 1e-3f * world_.bounds.diagonal();
  std::atomic<std::size_t> uncovered = 0;
  parallel_for(op_.lit.size(), 256, [&](std::size_t i) {
    const Vec3 n = unpack_normal(op_.lit[i].geometric);
    const Hit hit = traced.tracer.closest({offset_origin(position_of(op_.lit[i]), n, n), -n, near});
    if (hit) faces_[i] = hit.triangle;
    if (hit && !hit.back && index[hit.triangle] != kNone) {
      const auto& [a, b, c] = direct_.corners[index[hit.triangle]];
      if (const auto blend =
              blend_at(direct_, a + hit.barycentric.x * (b - a) + hit.barycentric.y * (c - a))) {
        blends_[i] = *blend;
        return;
      }
    }
    ++uncovered;
  });
  uncovered_ = uncovered;
}

void RealtimeRadiosity::find_copies() {
  const int rows = op_.height * op_.pages;
  std::vector<uint32_t> from(ambient_.size(), kNone);
  std::vector<uint32_t> front(op_.places.begin(), op_.places.end());
  for (const uint32_t place : front) from[place] = place;
  for (int ring = 0; ring < kRings; ++ring) {
    std::vector<uint32_t> next;
    for (const uint32_t place : front)
      for (int k = 0; k < 9; ++k) {
        const int x = static_cast<int>(place) % op_.width + k % 3 - 1,
                  y = static_cast<int>(place) / op_.width + k / 3 - 1;
        if (x < 0 || y < 0 || x >= op_.width || y >= rows) continue;
        const auto to = static_cast<uint32_t>(y * op_.width + x);
        if (from[to] != kNone) continue;
        from[to] = from[place];
        copies_.push_back({to, from[place]});
        next.push_back(to);
      }
    front = std::move(next);
  }
}

void RealtimeRadiosity::set_materials(const Detection& detection) {
  albedo_.resize(op_.albedo.size());
  const std::size_t points = op_.lit.size() / albedo_.size();
  for (std::size_t node = 0; node < albedo_.size(); ++node) {
    Rgb sum;
    for (std::size_t i = points * node; i < points * (node + 1); ++i)
      sum +=
          faces_[i] != kNone ? detection.of(world_, faces_[i]).reflectance : unpack_albedo(op_.lit[i].albedo);
    sum *= 1 / static_cast<float>(points);
    albedo_[node] = {sum.r, sum.g, sum.b, 0};
  }
  op_.albedo = albedo_;
  bounces_ = std::make_unique<FoldedBounces>(op_);
}

FrameReport RealtimeRadiosity::update() {
  FrameReport report;
  DrawRequest request;
  request.lights = DrawRequest::Lights::all;
  Captured direct;
  try {
    direct = capture(host_, direct_, request, "direct light");
  } catch (const Error& e) {
    report.fault = e.what();
    std::fill(ambient_.begin(), ambient_.end(), Rgb());
    return report;
  }
  report.capture = direct.cost;

  const auto start = std::chrono::steady_clock::now();
  // What is drawn has its reflectance and its emission in it already: it is all that leaves the surface.
  std::vector<Rgbx> light(op_.slots());
  std::atomic<std::size_t> clipped = 0;
  const std::size_t points = op_.points_per_slot;
  parallel_for(light.size(), 256, [&](std::size_t slot) {
    Rgb sum;
    for (std::size_t i = points * slot; i < points * (slot + 1); ++i) {
      bool bright = false;
      for (std::size_t k = 0; k < 4; ++k) {
        const float weight = blends_[i].weights[k];
        if (weight == 0) continue;
        sum += weight * direct.light[blends_[i].pixels[k]];
        bright = bright || direct.is_clipped(blends_[i].pixels[k]);
      }
      if (bright) ++clipped;
    }
    sum *= 1 / static_cast<float>(points);
    light[slot] = {sum.r, sum.g, sum.b, 0};
  });
  report.clipped = clipped;
  bounces_->indirect(light, indirect_);
  for (std::size_t i = 0; i < indirect_.size(); ++i) ambient_[op_.places[i]] = indirect_[i];
  for (const Copy& copy : copies_) ambient_[copy.to] = ambient_[copy.from];
  report.solve_milliseconds =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  return report;
}

}  // namespace sconce
