// SPDX-License-Identifier: Apache-2.0
#include "solve/photon_map.h"

#include <atomic>
#include <nanoflann.hpp>

#include "core/parallel.h"
#include "core/sobol.h"

namespace sconce {

namespace {

constexpr float kAgree = 0.7f;  // least cosine between the normals of a photon and of the place it counts for
constexpr float kSlab = 0.1f;   // largest distance of a photon from the place's plane, in reaches
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

/// What nanoflann sees of the photons.
struct Points {
  const std::vector<Photon>& photons;

  std::size_t kdtree_get_point_count() const { return photons.size(); }
  float kdtree_get_pt(std::size_t i, std::size_t axis) const {
    return photons[i].position[static_cast<int>(axis)];
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

/// The nearest photons that pass the query's tests, as a heap whose top is the furthest; a result set of
/// nanoflann. Ties go to the lower index.
class Nearest {
 public:
  using DistanceType = float;

  Nearest(const std::vector<Photon>& photons, const PhotonMap::Query& query, float reach,
          std::vector<std::pair<float, uint32_t>>& heap)
      : photons_(photons), query_(query), limit_(reach * reach), slab_(kSlab * reach), heap_(heap) {
    heap_.clear();
  }
  bool full() const { return heap_.size() == query_.count; }
  float worstDist() const { return full() ? heap_.front().first : limit_; }
  bool addPoint(float distance2, uint32_t index) {
    const Photon& p = photons_[index];
    if (p.reflections < query_.least_reflections || p.reflections > query_.most_reflections) return true;
    const Vec3 normal(p.normal[0], p.normal[1], p.normal[2]);
    if (glm::dot(normal, query_.normal) < 127 * kAgree) return true;
    if (std::abs(glm::dot(p.position - query_.position, query_.normal)) > slab_) return true;
    const std::pair<float, uint32_t> entry(distance2, index);
    if (full()) {
      if (!(entry < heap_.front())) return true;
      std::pop_heap(heap_.begin(), heap_.end());
      heap_.back() = entry;
    } else {
      heap_.push_back(entry);
    }
    std::push_heap(heap_.begin(), heap_.end());
    return true;
  }

 private:
  const std::vector<Photon>& photons_;
  const PhotonMap::Query& query_;
  float limit_, slab_;
  std::vector<std::pair<float, uint32_t>>& heap_;
};

}  // namespace

struct PhotonMap::Tree {
  using Index =
      nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Points>, Points, 3, uint32_t>;
  Points points;
  Index index;

  explicit Tree(const std::vector<Photon>& photons) : points{photons}, index(3, points, {16}) {}
};

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
  tree_ = std::make_unique<Tree>(photons_);
}

PhotonMap::~PhotonMap() = default;

void PhotonMap::density(const Query& query, Density& out) const {
  out.radius = out.scale = out.offset = 0;
  const double fair = static_cast<double>(query.count) * area_ / static_cast<double>(kPi);
  const float reach = static_cast<float>(2 * std::sqrt(fair));
  Nearest found(photons_, query, reach, out.nearest);
  if (!photons_.empty()) tree_->index.findNeighbors(found, &query.position.x, {});
  out.sparse = out.nearest.size() < query.count / 4;
  if (out.nearest.empty()) return;
  out.radius = reach;
  if (found.full()) {
    // The k-th only says how large the disk is: counted in, it would make the density too large by k / (k -
    // 1).
    out.radius = std::sqrt(out.nearest.front().first);
    std::pop_heap(out.nearest.begin(), out.nearest.end());
    out.nearest.pop_back();
  }
  Vec3 centroid(0);
  for (const auto& [distance2, i] : out.nearest) centroid += photons_[i].position - query.position;
  out.offset = glm::length(centroid) / (out.radius * static_cast<float>(out.nearest.size()));
  out.scale = 1 / (kPi * out.radius * out.radius);
}

}  // namespace sconce
