// SPDX-License-Identifier: Apache-2.0
#include "relight/exact_operator.h"

#include "core/error.h"
#include "gather/rows.h"
#include "relight/plain_rows.h"
#include "relight/row_maker.h"

namespace sconce {

namespace {

/// A sample's row of K as one of slots, which share what their sample receives and sends.
void spread(const SparseRows& rows, std::size_t sample, const CloudSquare& square,
            std::vector<SparseEntry>& out) {
  out.clear();
  for (uint64_t k = rows.first[sample]; k < rows.first[sample + 1]; ++k) {
    const std::span<const uint32_t> slots = square.of(rows.columns[k]);
    float weight = rows.unit * static_cast<float>(rows.counts[k]) / static_cast<float>(slots.size());
    if (!rows.tints.empty()) weight *= (rows.tints[k].r + rows.tints[k].g + rows.tints[k].b) / 3;
    for (const uint32_t slot : slots) out.push_back({slot, weight});
  }
  std::sort(out.begin(), out.end(),
            [](const SparseEntry& a, const SparseEntry& b) { return a.index < b.index; });
}

}  // namespace

MadeOperators make_exact_operator(const TracedScene& traced, const RelightReceivers& receivers,
                                  const TransferParams& params, const std::string& scene,
                                  const TransferWork& work) {
  OperatorStart start(traced, receivers, params, ClusterRows::kLanes, work.progress);
  Operator op = start.op;
  const auto each = static_cast<uint32_t>(params.rays);
  op.scene = scene;
  const auto slots = static_cast<uint32_t>(params.gather);
  const PlainRows all{slots, std::vector<float>(slots, 1.0f), RowValues::floats};

  // K: rows of the solver `radiosity`, whose counts have 16 bits.
  const int kernel_rays = std::min(params.rays, 65535);
  const SparseRows kernel = gather(traced.world, traced.tracer, *start.cloud, kernel_rays, params.seed, {},
                                   work.progress, work.ranks)
                                .rows;
  const auto albedo = std::make_shared<std::vector<Rgbx>>(slots);
  for (uint32_t slot = 0; slot < slots; ++slot) {
    const Rgb& a = start.cloud->albedo(start.square.samples[slot]);
    (*albedo)[slot] = {a.r, a.g, a.b, 0};
  }
  op.albedo = *albedo;
  op.owners.push_back(albedo);
  make_plain_rows(slots, all, "bounces", work, nullptr, op, op.first,
                  [&](std::size_t slot, std::vector<SparseEntry>& row) {
                    spread(kernel, start.square.samples[slot], start.square, row);
                  });
  op.bounce = op.first;
  op.sweeps = enough_sweeps(op.bounce, op.albedo);

  make_plain_rows(static_cast<uint32_t>(start.order.size()), all, "gather rows", work, work.state, op,
                  op.gather, [&](std::size_t i, std::vector<SparseEntry>& row) {
                    const ReceiverRays from(receivers, start.order[i], params.seed);
                    RowMaker maker(traced.world, traced.tracer, *start.cloud, start.square, {});
                    maker.start();
                    for (uint32_t r = 0; r < each; ++r) maker.shoot(from(r), r, from.stream);
                    maker.finish(each, row);
                  });
  const std::vector<uint32_t> glossy = start.glossy(receivers);
  if (glossy.empty()) return {std::move(op), std::nullopt};
  Operator lobes = start.lobes(op, receivers, glossy, params);
  make_plain_rows(static_cast<uint32_t>(glossy.size()), all, "lobes", work, nullptr, lobes, lobes.gather,
                  [&](std::size_t i, std::vector<SparseEntry>& row) {
                    const uint32_t own = glossy[i];
                    const LobeRays rays(*receivers.glossy(own), receivers.places[own], params.seed);
                    RowMaker maker(traced.world, traced.tracer, *start.cloud, start.square, {});
                    maker.start();
                    for (uint32_t r = 0; r < each; ++r) maker.follow(rays(r), r, rays.stream);
                    maker.finish(each, row);
                  });
  return {std::move(op), std::move(lobes)};
}

}  // namespace sconce
