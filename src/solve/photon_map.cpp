// SPDX-License-Identifier: Apache-2.0
#include "solve/photon_map.h"

#include <atomic>

#include "core/parallel.h"
#include "core/sobol.h"

namespace sconce {

namespace {

constexpr uint32_t kPanePair = 0xfffffeffu;  // no landing's pair
constexpr std::size_t kChunk = 4096;         // photons traced at a time

/// Follows one photon and appends its landings.
class PhotonTracer {
 public:
  PhotonTracer(const SolveContext& context, int landings, uint32_t lamp, std::size_t emitted, uint32_t seed)
      : context_(context),
        lamp_(lamp),
        group_(context.lamps.all()[lamp].group),
        landings_(landings < 0 ? ~0u : static_cast<uint32_t>(landings)),
        share_(context.wants(group_) ? 1 / static_cast<float>(emitted) : 0),
        stream_(mix32(mix32(seed, 0x70686f74u), lamp)) {}

  void trace(uint32_t index, std::vector<Photon>& out) const {
    const uint32_t reversed = detail::reverse_bits(index);
    const auto pair = [&](uint32_t slot) { return sobol_bits(reversed, slot, stream_).unit(); };
    const EmittedLight light = context_.lamps.emit(lamp_, pair(0), pair(1));
    Ray ray{offset_origin(light.position, light.normal, light.direction), light.direction};
    Rgb weight{1.0f};  // of the photon relative to what left the lamp: decides how it ends
    Rgb flux = light.flux * share_;
    uint32_t panes = 0;
    for (uint32_t landed = 0; landed < landings_;) {
      const Hit hit = context_.tracer.closest(ray);
      if (!hit) return;
      const Material& material = context_.scene[context_.world.materials[hit.triangle]];
      const Rgb arriving = landed == 0 ? flux * context_.lamps.reach(lamp_, hit.distance) : flux;
      const float side = hit.back ? -1.0f : 1.0f;
      const Vec3 face = context_.world.face_normals[hit.triangle] * side;
      const Vec3 smooth = context_.world.normal(hit.triangle, hit.barycentric) * side;
      // Photons land in proportion to the cosine with the face; a layer weighs light by that with the
      // interpolated normal (Veach 1997, 5.3).
      const float on_face = -glm::dot(ray.direction, face), on_smooth = -glm::dot(ray.direction, smooth);
      const bool lands = (!hit.back || material.double_sided) && on_face > 0 && on_smooth > 0;
      const Vec3 position = context_.world.position(hit.triangle, hit.barycentric);
      const Rgb landing = lands ? weight * (on_smooth / on_face) : Rgb(0.0f);
      if (lands) {
        Photon photon;
        photon.position = position;
        for (int c = 0; c < 3; ++c) photon.normal[c] = static_cast<int8_t>(std::lround(127 * face[c]));
        photon.reflections = static_cast<uint8_t>(std::min(landed, 255u));
        photon.flux = arriving * landing;
        photon.group = group_;
        out.push_back(photon);
      }
      // All light lands on a pane; then a share of it goes on.
      const Passing passing = context_.tracer.passing(hit);
      if (const float share = passing.share(); share > 0 && pair(kPanePair - panes++).x < share) {
        weight *= passing.rgb() * (1 / share);
        if (weight.is_black()) return;
        ray = context_.tracer.beyond(ray, hit);
        continue;
      }
      if (!lands) return;

      flux = arriving;
      weight = landing * shade(context_.scene, context_.world, hit.triangle, hit.barycentric).base_color;
      const float survival = std::min(1.0f, weight.max());
      if (weight.is_black() || !(pair(3 + 2 * landed).x < survival)) return;
      weight *= 1 / survival;
      ray = {offset_origin(position, face, face),
             Frame(face).to_world(square_to_cosine(pair(2 + 2 * landed)))};
      ++landed;
    }
  }

 private:
  const SolveContext& context_;
  uint32_t lamp_;
  Id<LightGroup> group_;
  uint32_t landings_;
  float share_;
  uint32_t stream_;
};

/// Every third bit from the lowest ten.
uint32_t spread(uint32_t v) {
  v = (v | v << 16) & 0x030000ff;
  v = (v | v << 8) & 0x0300f00f;
  v = (v | v << 4) & 0x030c30c3;
  return (v | v << 2) & 0x09249249;
}

/// Photons in the order of a Morton curve: what is near in space is near in memory, where searches wait for
/// it.
void sort_along_curve(std::vector<Photon>& photons, const Bounds& bounds) {
  const Vec3 scale = 1023.0f / glm::max(bounds.hi - bounds.lo, Vec3(1e-30f));
  std::vector<std::pair<uint32_t, uint32_t>> order;
  order.reserve(photons.size());
  for (const Photon& p : photons) {
    const Vec3 cell = glm::clamp((p.position - bounds.lo) * scale, Vec3(0), Vec3(1023));
    order.emplace_back(spread(static_cast<uint32_t>(cell.x)) | spread(static_cast<uint32_t>(cell.y)) << 1 |
                           spread(static_cast<uint32_t>(cell.z)) << 2,
                       order.size());
  }
  std::sort(order.begin(), order.end());
  std::vector<Photon> sorted;
  sorted.reserve(photons.size());
  for (const auto& [code, i] : order) sorted.push_back(photons[i]);
  photons = std::move(sorted);
}

}  // namespace

PhotonMap::PhotonMap(const SolveContext& context, int landings, std::size_t photons, uint32_t seed,
                     const Progress& progress) {
  const std::size_t lamps = landings == 0 ? 0 : context.lamps.size();
  const std::size_t each = lamps == 0 ? 0 : std::max<std::size_t>(1, photons / lamps);
  const std::size_t per_lamp = (each + kChunk - 1) / kChunk, chunks = lamps * per_lamp;
  std::vector<std::vector<Photon>> landed(chunks);
  std::atomic<uint64_t> done = 0;
  progress.at("photons", 0, chunks);
  parallel_for(chunks, 1, [&](std::size_t c) {
    progress.check();
    const PhotonTracer tracer(context, landings, static_cast<uint32_t>(c / per_lamp), each, seed);
    const std::size_t first = c % per_lamp * kChunk;
    for (std::size_t i = first; i < std::min(each, first + kChunk); ++i)
      tracer.trace(static_cast<uint32_t>(i), landed[c]);
    progress.at("photons", ++done, chunks);
  });
  std::size_t total = 0;
  for (const auto& chunk : landed) total += chunk.size();
  if (total > 0xfffffffeu) throw Error("--photons", "more than 4 billion landings");
  photons_.reserve(total);
  for (auto& chunk : landed) {
    photons_.insert(photons_.end(), chunk.begin(), chunk.end());
    chunk = {};
  }
  for (std::size_t t = 0; t < context.world.size(); ++t)
    area_ +=
        static_cast<double>(context.world.area(t)) / static_cast<double>(std::max<std::size_t>(1, total));
  sort_along_curve(photons_, context.world.bounds);
  tree_ = std::make_unique<PhotonTree<Photon>>(photons_);
}

void PhotonMap::density(const Query& query, Density& out) const {
  out.radius = out.scale = out.offset = 0;
  const double fair = static_cast<double>(query.count) * area_ / static_cast<double>(kPi);
  const float reach = static_cast<float>(2 * std::sqrt(fair));
  const auto accept = [&](const Photon& p) {
    return p.reflections >= query.least_reflections && p.reflections <= query.most_reflections;
  };
  const float radius =
      tree_->nearest({query.position, query.normal, query.count, reach}, accept, out.nearest);
  out.sparse = out.nearest.size() < query.count / 4;
  if (out.nearest.empty()) return;
  out.radius = radius;
  Vec3 centroid(0);
  for (const auto& [distance2, i] : out.nearest) centroid += photons_[i].position - query.position;
  out.offset = glm::length(centroid) / (out.radius * static_cast<float>(out.nearest.size()));
  out.scale = 1 / (kPi * out.radius * out.radius);
}

}  // namespace sconce
