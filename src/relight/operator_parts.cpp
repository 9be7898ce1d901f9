// SPDX-License-Identifier: Apache-2.0
#include "relight/operator_parts.h"

#include <map>

#include "core/error.h"
#include "core/sobol.h"
#include "relight/row_maker.h"
#include "relight/training_lights.h"
#include "trace/box.h"

namespace sconce {

namespace {

// Slots that share a basis: for direct light, which differs from one to the next, and for what was reflected
// and is even. The latter's number of bases is the order of FoldedBounces' matrix.
constexpr uint32_t kFirstCluster = 256, kBounceCluster = 2048;
constexpr uint32_t kBounceStream = 0x626f756eu;
constexpr uint32_t kSlotRays = 32;
constexpr std::size_t kRowBlock = 256;

/// Transforms of one channel of each light, in turn for a point and a spot: what luminance holds to be dark,
/// such as a red wall, is bright in light of its colour.
std::vector<std::vector<float>> transformed_channels(std::span<const std::vector<Rgbx>> lights) {
  std::vector<std::vector<float>> out(lights.size());
  parallel_for(lights.size(), 1, [&](std::size_t t) {
    for (const Rgbx& l : lights[t]) out[t].push_back(l[t / 2 % 3]);
    haar_forward(out[t]);
  });
  return out;
}

/// Clusters that ranks made, to all of them.
void share(ClusterRowsBuilder& builder, const Ranks& ranks) {
  ranks.share(
      builder.clusters(), [&](std::size_t c, std::string& bytes) { builder.pack(c, bytes); },
      [&](std::size_t c, std::string_view& bytes) { builder.unpack(c, bytes); });
}

bool any(std::span<const uint8_t> flags, std::size_t first, std::size_t count) {
  const auto begin = flags.begin() + static_cast<std::ptrdiff_t>(first);
  return std::any_of(begin, begin + static_cast<std::ptrdiff_t>(std::min(count, flags.size() - first)),
                     [](uint8_t f) { return f != 0; });
}

bool equal(const std::vector<SparseEntry>& a, const std::vector<SparseEntry>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const SparseEntry& x, const SparseEntry& y) {
    return x.index == y.index && x.value == y.value;
  });
}

/// A box around what moved of each instance, before and one after.
std::vector<Bounds> moved_boxes(const World& world, std::span<const Vec3> before) {
  std::map<uint32_t, std::pair<Bounds, Bounds>> of;
  for (std::size_t t = 0; t < world.size(); ++t) {
    const auto& v = world.triangles[t].v;
    if (std::none_of(std::begin(v), std::end(v), [&](uint32_t k) { return world.positions[k] != before[k]; }))
      continue;
    auto& [old, now] = of[world.instances[t].value];
    for (const uint32_t k : v) old.add(before[k]), now.add(world.positions[k]);
  }
  std::vector<Bounds> boxes;
  for (const auto& [instance, both] : of) boxes.push_back(both.first), boxes.push_back(both.second);
  return boxes;
}

}  // namespace

OperatorParts::OperatorParts(const TracedScene& traced, const RelightReceivers& receivers,
                             const TransferParams& params, const std::string& scene, const TransferWork& work)
    : world_(traced.world),
      tracer_(traced.tracer),
      receivers_(receivers),
      params_(params),
      start_(traced, receivers, params, static_cast<std::size_t>(params.cluster), work.progress),
      slot_rows_(params.gather),
      slot_wanders_(params.gather),
      receiver_wanders_(start_.order.size()),
      slots_(params.gather, 1),
      receivers_changed_(start_.order.size(), 1) {
  start_.op.scene = scene;
  lights_ = training_lights(traced, receivers, start_.middles, start_.op, params.lights, params.seed,
                            work.progress);
  if (params.movable) positions_ = world_.positions;
}

template <class Start>
bool OperatorParts::may_meet(const Start& start, uint32_t rays, uint32_t stream) const {
  for (uint32_t r = 0; r < rays; ++r) {
    const auto ray = row_ray(start(r), r, 0, stream);
    if (!ray) continue;
    float nearest = 1e30f;
    for (const Bounds& box : boxes_) nearest = std::min(nearest, entry(box, *ray).value_or(1e30f));
    if (nearest == 1e30f) continue;
    // What it meets before that has stayed where it was.
    const Hit hit = tracer_.closest(*ray);
    if (!hit || !(hit.distance < 0.999f * nearest) || tracer_.has_panes() || !params_.transmission.empty())
      return true;
  }
  return false;
}

namespace {

/// How much of the rays end on each slot, the most 1; rows that are divided by it are smoother (ADR 46).
std::vector<float> weights_by_rays(std::span<const std::vector<SparseEntry>> rows) {
  constexpr float kLeast = 0.02f, kMost = 50;  // of the mean
  std::vector<float> weights(rows.size(), 0.0f);
  double mean = 0;
  for (const std::vector<SparseEntry>& row : rows)
    for (const SparseEntry& e : row) weights[e.index] += e.value, mean += static_cast<double>(e.value);
  mean /= static_cast<double>(rows.size());
  if (!(mean > 0)) return {};
  for (float& w : weights) w = std::clamp(w / static_cast<float>(mean), kLeast, kMost) / kMost;
  return weights;
}

}  // namespace

void OperatorParts::set_albedo(Operator& op) {
  // With rows' sums kept even light must be even to the rows, too.
  if (weights_.empty() && !params_.keep_sums) weights_ = weights_by_rays(slot_rows_);
  const auto albedo = std::make_shared<std::vector<Rgbx>>(params_.gather);
  for (uint32_t slot = 0; slot < params_.gather; ++slot) {
    const float weight = weights_.empty() ? 0 : weights_[slot];
    const Rgb a = (weight > 0 ? weight : 1) * start_.cloud->albedo(start_.square.samples[slot]);
    (*albedo)[slot] = {a.r, a.g, a.b, weight};
  }
  op.albedo = *albedo;
  op.owners.push_back(albedo);
}

/// Rows of K that are to be made; `slots_` then tells which of them differ from before.
void OperatorParts::shoot_slots(const TransferWork& work, Operator& op) {
  const std::size_t slots = slot_rows_.size(), blocks = (slots + kRowBlock - 1) / kRowBlock;
  std::atomic<std::size_t> shot = 0;
  for_blocks(blocks, "bounce rows", work, [&](std::size_t block) {
    RowMaker rows(world_, tracer_, *start_.cloud, start_.square, params_.transmission);
    std::vector<SparseEntry> row;
    for (std::size_t slot = kRowBlock * block; slot < std::min(slots, kRowBlock * (block + 1)); ++slot) {
      const uint32_t stream = mix32(mix32(params_.seed, kBounceStream), static_cast<uint32_t>(slot)),
                     sample = start_.square.samples[slot];
      const Footprint footprint = start_.cloud->footprint(sample);
      const auto from = [&](uint32_t r) {
        return start_.cloud->point(sample, footprint, sobol_pair(r, 0, stream));
      };
      if (slots_[slot] == 0 && slot_wanders_[slot] == 0 && !may_meet(from, kSlotRays, stream)) continue;
      ++shot;
      rows.start();
      for (uint32_t r = 0; r < kSlotRays; ++r) rows.shoot(from(r), r, stream);
      rows.finish(kSlotRays, row);
      slots_[slot] = equal(row, slot_rows_[slot]) ? 0 : 1;
      slot_wanders_[slot] = rows.wandered() ? 1 : 0;
      slot_rows_[slot] = row;
    }
  });
  report_.slots = shot;
  const auto rows_of = [&](std::size_t block) {
    return std::span(slot_rows_).subspan(kRowBlock * block, std::min(kRowBlock, slots - kRowBlock * block));
  };
  work.ranks.share(
      blocks,
      [&](std::size_t block, std::string& bytes) {
        for (const std::vector<SparseEntry>& row : rows_of(block)) put_vector(bytes, row);
      },
      [&](std::size_t block, std::string_view& bytes) {
        for (std::vector<SparseEntry>& row : rows_of(block)) take_vector(bytes, row);
      });
  set_albedo(op);
}

template <class Changed, class Set>
void OperatorParts::fit(Fitted& fitted, uint32_t rows, uint32_t cluster, int coefficients, const char* stage,
                        const TransferWork& work, Operator& op, ClusterRows& out, const Changed& changed,
                        const Set& set) {
  ClusterRowsBuilder builder(rows, *fitted.light,
                             {cluster, static_cast<std::size_t>(coefficients), params_.keep_sums});
  fitted.clusters.resize(builder.clusters());
  std::atomic<std::size_t> again = 0;
  for_blocks(builder.clusters(), stage, work, [&](std::size_t c) {
    std::string& kept = fitted.clusters[c];
    if (!kept.empty() && !changed(c)) {
      std::string_view bytes = kept;
      return builder.unpack(c, bytes);
    }
    set(c, builder);
    ++again;
    if (!params_.movable) return;
    kept.clear();
    builder.pack(c, kept);
  });
  report_.clusters += again;
  share(builder, work.ranks);
  auto made = builder.finish();
  out = made.rows;
  op.owners.push_back(made.owner);
}

/// The same rows twice: for direct light, whose edges are sharp, and for what was reflected and is even.
void OperatorParts::fit_bounces(const TransferWork& work, Operator& op) {
  const auto slots = static_cast<uint32_t>(params_.gather);
  const auto both = [&](Fitted& fitted, uint32_t cluster, int coefficients, ClusterRows& out) {
    fit(
        fitted, slots, cluster, coefficients, "bounces", work, op, out,
        [&](std::size_t c) { return any(slots_, cluster * c, cluster); },
        [&](std::size_t c, ClusterRowsBuilder& builder) {
          const auto own = std::span(slot_rows_)
                               .subspan(cluster * c)
                               .first(std::min<std::size_t>(cluster, slots - cluster * c));
          Rows rows(own.begin(), own.end());
          for (std::vector<SparseEntry>& row : rows) weigh(row);
          builder.set_cluster(c, rows);
        });
    if (!params_.movable) fitted.light.reset();
  };
  if (first_.light == nullptr) {
    std::vector<std::vector<Rgbx>> weighed = lights_;
    for (std::vector<Rgbx>& light : weighed) sconce::weigh(op, light);
    first_.light = std::make_unique<TrainingLight>(transformed_channels(weighed));
  }
  both(first_, kFirstCluster, params_.coefficients, op.first);
  if (bounce_.light == nullptr) {
    std::vector<std::vector<Rgbx>> once(lights_.size());
    parallel_for(lights_.size(), 1, [&](std::size_t t) { once[t] = first_bounce(op, lights_[t]); });
    bounce_.light = std::make_unique<TrainingLight>(transformed_channels(once));
  }
  both(bounce_, kBounceCluster, params_.bounce_coefficients, op.bounce);
  op.sweeps = enough_sweeps(op.bounce, op.albedo);
  if (!params_.movable) slot_rows_ = {};
}

/// F, fitted to the lights after all bounces.
void OperatorParts::fit_gather(const TransferWork& work, Operator& op) {
  work.progress.check();
  if (gather_.light == nullptr) {
    parallel_for(lights_.size(), 1, [&](std::size_t t) {
      bounce_light(op, lights_[t]);
      haar_inverse(lights_[t]);
    });
    gather_.light = std::make_unique<TrainingLight>(transformed_channels(lights_));
    lights_ = {};
  }
  const auto rays = static_cast<uint32_t>(params_.rays);
  const auto cluster = static_cast<std::size_t>(params_.cluster);
  const std::size_t count = start_.order.size();
  const auto rays_of = [&](std::size_t i) { return ReceiverRays(receivers_, start_.order[i], params_.seed); };
  const auto changed = [&](std::size_t c) {
    for (std::size_t i = cluster * c; i < std::min(count, cluster * (c + 1)); ++i) {
      if (receivers_changed_[i] != 0 || receiver_wanders_[i] != 0) return true;
      const ReceiverRays from = rays_of(i);
      if (may_meet(from, rays, from.stream)) return true;
    }
    return false;
  };
  std::atomic<std::size_t> shot = 0;
  fit(gather_, static_cast<uint32_t>(count), static_cast<uint32_t>(cluster), params_.coefficients,
      "gather rows", work, op, op.gather, changed, [&](std::size_t c, ClusterRowsBuilder& builder) {
        if (work.state != nullptr)
          if (std::string_view bytes = work.state->find(c); !bytes.empty()) return builder.unpack(c, bytes);
        RowMaker maker(world_, tracer_, *start_.cloud, start_.square, params_.transmission);
        Rows rows(std::min(cluster, count - cluster * c));
        for (std::size_t k = 0; k < rows.size(); ++k) {
          if (k % 64 == 0) work.progress.check();
          const ReceiverRays from = rays_of(cluster * c + k);
          maker.start();
          for (uint32_t r = 0; r < rays; ++r) maker.shoot(from(r), r, from.stream);
          maker.finish(rays, rows[k]);
          weigh(rows[k]);
          receiver_wanders_[cluster * c + k] = maker.wandered() ? 1 : 0;
        }
        shot += rows.size();
        builder.set_cluster(c, rows);
        if (work.state == nullptr) return;
        std::string bytes;
        builder.pack(c, bytes);
        work.state->put(c, bytes);
      });
  report_.receivers = shot;
  if (!params_.movable) fit_lobes(work, op);
  if (!params_.movable) gather_.light.reset();
}

/// Lobes are narrow, so that fewer pixels mirror alike.
void OperatorParts::fit_lobes(const TransferWork& work, const Operator& op) {
  constexpr uint32_t kLobeCluster = 64;
  const std::vector<uint32_t> glossy = start_.glossy(receivers_);
  if (glossy.empty()) return;
  lobes_ = start_.lobes(op, receivers_, glossy, params_);
  const auto rays = static_cast<uint32_t>(params_.rays);
  Fitted fitted{std::move(gather_.light), {}};
  fit(
      fitted, static_cast<uint32_t>(glossy.size()), kLobeCluster, params_.coefficients, "lobes", work,
      *lobes_, lobes_->gather, [](std::size_t) { return true; },
      [&](std::size_t c, ClusterRowsBuilder& builder) {
        const std::size_t kept = op.gather.clusters() + c;  // in the state, behind F's
        if (work.state != nullptr)
          if (std::string_view bytes = work.state->find(kept); !bytes.empty())
            return builder.unpack(c, bytes);
        RowMaker maker(world_, tracer_, *start_.cloud, start_.square, params_.transmission);
        Rows rows(std::min<std::size_t>(kLobeCluster, glossy.size() - kLobeCluster * c));
        for (std::size_t k = 0; k < rows.size(); ++k) {
          const uint32_t own = glossy[kLobeCluster * c + k];
          const LobeRays lobe(*receivers_.glossy(own), receivers_.places[own], params_.seed);
          maker.start();
          for (uint32_t r = 0; r < rays; ++r) maker.follow(lobe(r), r, lobe.stream);
          maker.finish(rays, rows[k]);
          weigh(rows[k]);
        }
        builder.set_cluster(c, rows);
        if (work.state == nullptr) return;
        std::string bytes;
        builder.pack(c, bytes);
        work.state->put(kept, bytes);
      });
}

Operator OperatorParts::finish(const TransferWork& work) {
  Operator op = start_.op;
  report_ = {};
  shoot_slots(work, op);
  fit_bounces(work, op);
  fit_gather(work, op);
  std::fill(slots_.begin(), slots_.end(), uint8_t{0});
  std::fill(receivers_changed_.begin(), receivers_changed_.end(), uint8_t{0});
  return op;
}

Operator OperatorParts::make(const TransferWork& work) {
  return finish(work);
}

Operator OperatorParts::follow(const Progress& progress, FollowReport* report, bool all) {
  if (!params_.movable || positions_.size() != world_.positions.size())
    throw UsageError("an operator that follows", "one that was not made movable, or has other vertices now",
                     "TransferParams::movable, and the same triangles at other places");
  // Boxes stay until all has been made, so that an interrupted step is gone through again.
  const std::vector<Bounds> moved = moved_boxes(world_, positions_);
  boxes_.insert(boxes_.end(), moved.begin(), moved.end());
  positions_ = world_.positions;
  const std::vector<uint8_t> changed = start_.cloud->follow(tracer_, boxes_);
  start_.place(receivers_, params_);
  for (std::size_t slot = 0; slot < slots_.size(); ++slot)
    if (all || changed[start_.square.samples[slot]] != 0) slots_[slot] = 1;
  if (all) std::fill(receivers_changed_.begin(), receivers_changed_.end(), uint8_t{1});
  Operator op = finish({progress, nullptr});
  boxes_.clear();
  if (report != nullptr) *report = report_;
  return op;
}

}  // namespace sconce
