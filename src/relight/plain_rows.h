// SPDX-License-Identifier: Apache-2.0
// Rows that share nothing but, sixteen at a time, the choice of their coefficients.
#pragma once

#include "relight/operator_start.h"

namespace sconce {

/// How they are kept.
struct PlainRows {
  std::size_t coefficients;    ///< of a row, the mean included
  std::vector<float> squares;  ///< per slot: CoefficientChooser
  RowValues values;
};

/// A rank makes so many at a time.
inline constexpr std::size_t kRowsAtATime = 256;

/// @param state  keeps finished groups of rows; may be null
/// @param make   fills row i, a sparse one; thread-safe
template <class Make>
void make_plain_rows(uint32_t count, const PlainRows& kept, const char* stage, const TransferWork& work,
                     TransferState* state, Operator& op, ClusterRows& out, const Make& make) {
  constexpr std::size_t kBlock = WaveletRows::kBlock, kGroup = kRowsAtATime / kBlock;
  const auto columns = static_cast<uint32_t>(kept.squares.size());
  const std::size_t filled = (count + kBlock - 1) / kBlock * kBlock;
  WaveletRowsBuilder builder(static_cast<uint32_t>(filled), columns, kept.coefficients, kept.squares,
                             kept.values);
  const auto blocks_of = [&](std::size_t group, const auto& f) {
    for (std::size_t b = kGroup * group; b < std::min(builder.blocks(), kGroup * (group + 1)); ++b) f(b);
  };
  const auto pack = [&](std::size_t group, std::string& bytes) {
    blocks_of(group, [&](std::size_t b) { builder.pack(b, bytes); });
  };
  const auto unpack = [&](std::size_t group, std::string_view& bytes) {
    blocks_of(group, [&](std::size_t b) { builder.unpack(b, bytes); });
  };
  const std::size_t groups = (builder.blocks() + kGroup - 1) / kGroup;
  for_blocks(groups, stage, work, [&](std::size_t group) {
    if (state != nullptr)
      if (std::string_view bytes = state->find(group); !bytes.empty()) return unpack(group, bytes);
    WaveletRowsBuilder::Scratch scratch(builder);
    std::vector<std::vector<SparseEntry>> rows;
    blocks_of(group, [&](std::size_t b) {
      work.progress.check();
      rows.resize(std::min<std::size_t>(kBlock, count - kBlock * b));
      for (std::size_t r = 0; r < rows.size(); ++r) make(kBlock * b + r, rows[r]);
      builder.set_block(b, rows, scratch);
    });
    if (state == nullptr) return;
    std::string bytes;
    pack(group, bytes);
    state->put(group, bytes);
  });
  work.ranks.share(groups, pack, unpack);
  auto made = builder.finish();
  out = {count, kBlock, made.rows, {}, {}};
  op.owners.push_back(made.owner);
}

}  // namespace sconce
