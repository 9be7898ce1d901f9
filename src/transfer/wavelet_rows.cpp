// SPDX-License-Identifier: Apache-2.0
#include "transfer/wavelet_rows.h"

#include "core/ranks.h"
#include "transfer/quantise.h"

namespace sconce {

namespace {

constexpr std::size_t kBlock = WaveletRows::kBlock;

struct Owned {
  std::vector<uint32_t> first{0};
  std::vector<uint16_t> indices;
  std::vector<int8_t> codes;
  std::vector<float> scales, means, values;
};

}  // namespace

float WaveletRows::value(std::size_t block, std::size_t k, std::size_t r) const {
  return values.empty() ? dequantise(codes[kBlock * k + r], scales[kBlock * block + r])
                        : values[kBlock * k + r];
}

WaveletRowsBuilder::WaveletRowsBuilder(uint32_t rows, uint32_t columns, std::size_t coefficients,
                                       std::vector<float> squares, RowValues keep)
    : rows_(rows),
      columns_(columns),
      coefficients_(coefficients),
      squares_(std::move(squares)),
      keep_(keep),
      blocks_((rows + kBlock - 1) / kBlock) {}

void WaveletRowsBuilder::set_block(std::size_t block, std::span<std::vector<SparseEntry>> rows,
                                   Scratch& scratch) {
  Block& out = blocks_[block];
  const std::span transformed(scratch.transformed.data(), rows.size());
  for (std::size_t r = 0; r < rows.size(); ++r) haar_forward(rows[r], columns_, transformed[r]);
  for (const std::vector<SparseEntry>& row : transformed)
    for (const SparseEntry& e : row) scratch.chooser.add(e.index, e.value * e.value);
  // The mean is one of the coefficients asked for.
  const std::span<const uint32_t> chosen = scratch.chooser.choose(coefficients_ > 0 ? coefficients_ - 1 : 0);
  out.indices.assign(chosen.begin(), chosen.end());
  for (std::size_t k = 0; k < chosen.size(); ++k) scratch.place[chosen[k]] = static_cast<uint16_t>(k + 1);
  const bool exact = keep_ == RowValues::floats;
  if (exact)
    out.values.assign(kBlock * chosen.size(), 0);
  else
    out.codes.assign(kBlock * chosen.size(), 0);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    float largest = 0;
    for (const SparseEntry& e : transformed[r]) {
      if (e.index == 0) out.means[r] = e.value;
      if (scratch.place[e.index] != 0) largest = std::max(largest, std::abs(e.value));
    }
    out.scales[r] = exact ? 0 : largest;
    for (const SparseEntry& e : transformed[r]) {
      const std::size_t at = scratch.place[e.index];
      if (at == 0) continue;
      const std::size_t k = (at - 1) * kBlock + r;
      if (exact)
        out.values[k] = e.value;
      else
        out.codes[k] = quantise(e.value, largest);
    }
  }
  for (const uint32_t index : chosen) scratch.place[index] = 0;
}

void WaveletRowsBuilder::set_block(std::size_t block, std::span<const uint32_t> chosen,
                                   std::span<const Sixteen> values) {
  Block& out = blocks_[block];
  out.indices.assign(chosen.begin(), chosen.end());
  out.codes.resize(kBlock * chosen.size());
  out.means = values[0];
  for (const uint32_t k : chosen)
    for (std::size_t r = 0; r < kBlock; ++r) out.scales[r] = std::max(out.scales[r], std::abs(values[k][r]));
  for (std::size_t i = 0; i < chosen.size(); ++i)
    for (std::size_t r = 0; r < kBlock; ++r)
      out.codes[kBlock * i + r] = quantise(values[chosen[i]][r], out.scales[r]);
}

void WaveletRowsBuilder::pack(std::size_t block, std::string& bytes) const {
  const Block& own = blocks_[block];
  put_vector(bytes, own.indices);
  put_vector(bytes, own.codes);
  if (keep_ == RowValues::floats) put_vector(bytes, own.values);
  put_span<float>(bytes, own.scales);
  put_span<float>(bytes, own.means);
}

void WaveletRowsBuilder::unpack(std::size_t block, std::string_view& bytes) {
  Block& own = blocks_[block];
  take_vector(bytes, own.indices);
  take_vector(bytes, own.codes);
  if (keep_ == RowValues::floats) take_vector(bytes, own.values);
  take_span<float>(bytes, own.scales);
  take_span<float>(bytes, own.means);
}

WaveletRowsBuilder::Result WaveletRowsBuilder::finish() {
  auto owned = std::make_shared<Owned>();
  for (Block& block : blocks_) {
    owned->indices.insert(owned->indices.end(), block.indices.begin(), block.indices.end());
    owned->codes.insert(owned->codes.end(), block.codes.begin(), block.codes.end());
    owned->values.insert(owned->values.end(), block.values.begin(), block.values.end());
    owned->scales.insert(owned->scales.end(), block.scales.begin(), block.scales.end());
    owned->means.insert(owned->means.end(), block.means.begin(), block.means.end());
    owned->first.push_back(static_cast<uint32_t>(owned->indices.size()));
    block = {};
  }
  Result result;
  result.rows = {columns_,     rows_,         owned->first, owned->indices,
                 owned->codes, owned->scales, owned->means, owned->values};
  result.owner = std::move(owned);
  return result;
}

}  // namespace sconce
