// SPDX-License-Identifier: Apache-2.0
#include "solve/bake.h"

#include <fmt/format.h>

#include <atomic>
#include <utility>

#include "core/parallel.h"

namespace sconce {

std::string made_with(const BakeParams& params) {
  return fmt::format("samples={} noise={:a}", (params.samples + kBatches - 1) / kBatches * kBatches,
                     params.noise);
}

void bake_tiles(const Solver& solver, const BakeParams& params, const TexelReceivers& receivers,
                std::span<const uint8_t> wanted, std::span<const std::size_t> tiles, BakeState& state,
                const Progress& progress) {
  const std::string with = made_with(params);
  std::atomic<uint64_t> done = 0;
  progress.at("bake", done, tiles.size());
  parallel_for(tiles.size(), 1, [&](std::size_t k) {
    progress.check();
    const std::size_t tile = tiles[k], first = tile * TexelReceivers::kTile, count = state.receivers_of(tile);
    std::vector<GroupValue> values(state.header().layers * count),
        one(wanted.size() * coefficients(params.basis));
    for (std::size_t i = 0; i < count; ++i) {
      if (i % 16 == 0) progress.check();
      solver.solve(receivers.footprint(first + i), one);
      std::size_t at = i;
      for (std::size_t g = 0; g < one.size(); ++g)
        if (wanted[g % wanted.size()] != 0) values[std::exchange(at, at + count)] = one[g];
    }
    state.append(tile, with, values);
    progress.at("bake", ++done, tiles.size());
  });
}

std::vector<std::size_t> missing_tiles(std::span<const BakeState> states, const BakeParams& params,
                                       Shard shard) {
  std::vector<std::size_t> missing;
  const std::string with = made_with(params);
  for (std::size_t tile = shard.index; tile < states.front().tiles(); tile += shard.count) {
    bool found = false;
    for (const BakeState& state : states) found |= state.has(tile) && state.made_with(tile) == with;
    if (!found) missing.push_back(tile);
  }
  return missing;
}

std::vector<GroupValue> collect_values(std::span<const BakeState> states, const BakeParams& params,
                                       uint32_t layer) {
  const std::string with = made_with(params);
  std::vector<GroupValue> all;
  for (std::size_t tile = 0; tile < states.front().tiles(); ++tile) {
    const BakeState* source = nullptr;
    for (const BakeState& state : states)
      if (state.has(tile) && state.made_with(tile) == with) source = &state;
    const std::vector<GroupValue> values = source->read(tile, layer);
    all.insert(all.end(), values.begin(), values.end());
  }
  return all;
}

Layer assemble_layer(std::span<const GroupValue> values, const Atlas& atlas, const TexelReceivers& receivers,
                     std::span<const float> areas, const Seams* seams) {
  Layer layer;
  const std::size_t page_texels =
      static_cast<std::size_t>(atlas.width) * static_cast<std::size_t>(atlas.height);
  std::vector<std::vector<uint8_t>> valid(static_cast<std::size_t>(atlas.pages),
                                          std::vector<uint8_t>(page_texels, 0));
  for (int p = 0; p < atlas.pages; ++p) {
    layer.pages.push_back(Image::rgb(atlas.width, atlas.height));
    layer.noise.push_back(Image(atlas.width, atlas.height, {"noise"}));
  }
  double area_sum = 0, lux_sum = 0, squares = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t page = receivers.texel(i) / page_texels, at = receivers.texel(i) % page_texels;
    const Rgb& e = values[i].illuminance;
    float* pixel = &layer.pages[page].data[3 * at];
    pixel[0] = e.r, pixel[1] = e.g, pixel[2] = e.b;
    valid[page][at] = 1;
    const float lux = luminance(e);
    // Next to nothing by nothing is no number that a package holds.
    layer.noise[page].data[at] = lux > 0 ? std::min(values[i].error / lux, 65504.0f) : 0;
    const double area = static_cast<double>(areas[i]), error = static_cast<double>(values[i].error);
    area_sum += area;
    lux_sum += area * static_cast<double>(lux);
    squares += area * error * error;
  }
  layer.mean_lux = area_sum > 0 ? lux_sum / area_sum : 0;
  layer.relative_noise = layer.mean_lux > 0 ? std::sqrt(squares / area_sum) / layer.mean_lux : 0;
  parallel_for(static_cast<std::size_t>(atlas.pages), 1,
               [&](std::size_t p) { fill_gaps(atlas, static_cast<int>(p), valid[p], layer.pages[p]); });
  if (seams != nullptr) seams->close(layer.pages);
  return layer;
}

}  // namespace sconce
