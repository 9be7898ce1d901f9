// SPDX-License-Identifier: Apache-2.0
#include "gpu/transfer.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "transfer/folded_bounces.h"

namespace sconce::gpu {

namespace {

constexpr std::string_view kHaar =
#include "gpu/haar.glsl.h"
    ;
constexpr std::string_view kBasisProduct =
#include "gpu/basis_product.glsl.h"
    ;
constexpr std::string_view kDenseProduct =
#include "gpu/dense_product.glsl.h"
    ;
constexpr std::string_view kRowProduct =
#include "gpu/row_product.glsl.h"
    ;
constexpr uint32_t kSquare = 1024;      // of haar.glsl
constexpr std::size_t kRowPairs = 128;  // of row_product.glsl
constexpr std::size_t kLight = sizeof(Rgbx);

}  // namespace

Transfer::Rows::Rows(const Context& context, const ClusterRows& r, const std::string& what)
    : rows(r.rows),
      cluster(r.cluster),
      blocks(static_cast<uint32_t>(r.basis.blocks())),
      plain(r.plain()),
      bytes(r.bytes()),
      first(context, r.basis.first, what),
      indices(context, r.basis.indices, what),
      codes(context, r.basis.codes, what),
      basis_scales(context, r.basis.scales, what),
      means(context, r.basis.means, what),
      weights(context, r.weights, what),
      scales(context, r.scales, what),
      sums(context, ClusterRows::kRank * blocks * kLight, nullptr, what) {
  if (!r.basis.values.empty()) throw Error(what, "are not quantised: only the processor reads them");
}

namespace {

/// Three matrices, one after the other.
Buffer fold(const Context& context, const Operator& op) {
  const FoldedBounces bounces(op);
  std::vector<float> all;
  for (std::size_t c = 0; c < 3; ++c)
    all.insert(all.end(), bounces.matrix(c).begin(), bounces.matrix(c).end());
  return {context, std::span<const float>(all), "the operator's bounces"};
}

}  // namespace

Transfer::Bounces::Bounces(const Context& context, const Operator& op)
    : nodes(op.bounce.rows),
      first(context, op.first, "the operator's first bounce"),
      all(context, op.bounce, "the operator's bounces"),
      folded(fold(context, op)),
      answers(context, all.sums.bytes(), nullptr, "the operator's bounces"),
      albedo(context, op.albedo, "the cloud's albedo"),
      coefficients(context, nodes * kLight, nullptr, "light on the cloud"),
      light(context, nodes * kLight, nullptr, "light on the cloud"),
      sum(context, nodes * kLight, nullptr, "light on the cloud") {}

Transfer::Transfer(const Context& context, const Operator& op)
    : context_(&context),
      slots_(op.slots()),
      gather_(context, op.gather, "the operator's rows"),
      haar_("haar", kHaar),
      basis_product_("basis product", kBasisProduct),
      dense_product_("dense product", kDenseProduct),
      row_product_("row product", kRowProduct),
      exitance_(context, slots_ * kLight, nullptr, "light on the cloud"),
      coefficients_(context, slots_ * kLight, nullptr, "light on the cloud"),
      averages_(context, slots_ / kSquare * kLight, nullptr, "light on the cloud"),
      illuminance_(context, std::size_t{gather_.rows} * kLight, nullptr, "light on receivers") {
  if (op.sweeps > 0) bounces_.emplace(context, op);
  context.check("uploading the operator");
}

void Transfer::transform(const Buffer& from, uint32_t size, const Buffer& to, float factor, bool more,
                         const Buffer* weights) const {
  const Buffer* left = &from;
  haar_.use();
  haar_.set("factor", factor);
  haar_.set("more", more ? 1 : 0);
  for (uint32_t n = size;; n /= kSquare) {
    haar_.set("size", n);
    left->bind(0);
    to.bind(1);
    averages_.bind(2);
    haar_.set("weighed", weights != nullptr ? 1 : 0);
    if (weights != nullptr) weights->bind(3);
    weights = nullptr;  // averages have theirs
    glDispatchCompute(std::max(1u, n / kSquare), 1, 1);
    buffers_written();
    left = &averages_;
    if (n <= kSquare) break;
  }
}

void Transfer::answer(const Rows& rows, const Buffer& light) const {
  basis_product_.use();
  basis_product_.set("blocks", rows.blocks);
  GLuint binding = 0;
  for (const Buffer* buffer :
       {&rows.first, &rows.indices, &rows.codes, &rows.basis_scales, &rows.means, &light, &rows.sums})
    buffer->bind(binding++);
  dispatch(rows.blocks);
  buffers_written();
}

void Transfer::combine(const Rows& rows, const Buffer& answers, const Buffer& out,
                       const Bounces* reflected) const {
  row_product_.use();
  row_product_.set("rows", rows.rows);
  row_product_.set("cluster", rows.cluster);
  row_product_.set("plain", rows.plain ? 1 : 0);
  row_product_.set("reflects", reflected != nullptr ? 1 : 0);
  GLuint binding = 0;
  for (const Buffer* buffer : {&rows.weights, &rows.scales, &answers, &out}) buffer->bind(binding++);
  if (reflected != nullptr) reflected->albedo.bind(4), reflected->sum.bind(5);
  dispatch((rows.rows + 2 * kRowPairs - 1) / (2 * kRowPairs));
  buffers_written();
}

// FoldedBounces::apply
void Transfer::bounce(const Bounces& b) const {
  b.sum.clear();
  answer(b.first, coefficients_);
  combine(b.first, b.first.sums, b.light, &b);
  if (b.folded.bytes() > 0) {
    transform(b.light, b.nodes, b.coefficients);
    answer(b.all, b.coefficients);
    dense_product_.use();
    const uint32_t rank = ClusterRows::kRank * b.all.blocks;
    dense_product_.set("rank", rank);
    GLuint binding = 0;
    for (const Buffer* buffer : {&b.folded, &b.all.sums, &b.answers}) buffer->bind(binding++);
    dispatch(rank);
    buffers_written();
    combine(b.all, b.answers, b.light, &b);
  }
  // The transform of a square whose blocks are all even: that of the blocks, times their side.
  transform(b.sum, b.nodes, coefficients_, std::sqrt(static_cast<float>(slots_ / b.nodes)), true);
}

void Transfer::apply() const {
  const bool weighed = bounces_ && bounces_->nodes == slots_;
  transform(exitance_, slots_, coefficients_, 1, false, weighed ? &bounces_->albedo : nullptr);
  if (bounces_) bounce(*bounces_);
  answer(gather_, coefficients_);
  combine(gather_, gather_.sums, illuminance_, nullptr);
  context_->check("sending light through the operator");
}

std::vector<Rgb> Transfer::read() const {
  std::vector<Rgbx> all(gather_.rows);
  illuminance_.read(all.size() * kLight, all.data());
  context_->check("reading indirect light");
  std::vector<Rgb> out;
  out.reserve(all.size());
  for (const Rgbx& e : all) out.emplace_back(e[0], e[1], e[2]);
  return out;
}

std::size_t Transfer::bytes_moved() const {
  const auto product = [](const Rows& rows, std::size_t columns) {
    return rows.bytes + kLight * (columns + 2 * ClusterRows::kRank * rows.blocks + rows.rows);
  };
  // A transform reads all and writes all; averages, a thousandth of it, apart.
  std::size_t bytes = 2 * kLight * slots_ + product(gather_, slots_);
  if (bounces_) {
    const std::size_t nodes = bounces_->nodes * kLight, sums = bounces_->answers.bytes();
    // Light that is reflected reads albedo and its sum and writes the sum; sums are cleared, and added at
    // last.
    bytes += product(bounces_->first, slots_) + product(bounces_->all, bounces_->nodes) +
             bounces_->folded.bytes() + 2 * sums + 2 * 3 * nodes + nodes + 2 * nodes + 3 * nodes;
  }
  return bytes;
}

}  // namespace sconce::gpu
