// SPDX-License-Identifier: Apache-2.0
// Makes a direct-to-indirect operator: cloud, rows of the final gather F and of the cloud's own kernel K by
// cosine-distributed rays that end on the cloud (methods.md 2.4), both fitted to
// the light of lamps at many places. To compare with: as system C's chapter does (chapter_operator.h); all of
// these rays without compression (exact_operator.h).
#pragma once

#include "relight/receivers.h"
#include "relight/transfer_state.h"

namespace sconce {

enum class TransferMethod : uint8_t { fitted, chapter, exact };

struct TransferParams {
  TransferMethod method = TransferMethod::fitted;
  std::size_t gather = 65536;               ///< slots of the cloud's square: a power of four, 256 to 65,536
  int rays = 512;                           ///< per receiver
  int cluster = 256;                        ///< receivers that share a basis, a multiple of 16
  int coefficients = 1024;                  ///< of a basis
  int bounce_coefficients = 512;            ///< of a basis, for light that was reflected
  int points = 4;                           ///< per slot, where direct light is asked for
  int lights = 256;                         ///< that rows are fitted to
  bool keep_sums = false;                   ///< of rows: even light is exact, lamps less so (ADR 29)
  Weighting choice = Weighting::root_area;  ///< of coefficients; this and what follows: of the chapter
  int photons = 1'000'000;                  ///< that the cloud sends
  int nearest = 1000;                       ///< of these, looked at from each slot
  /// Per Scene material: share of light that goes straight on behind it, whatever its own adds. Empty: none.
  std::vector<float> transmission;
  bool movable = false;  ///< things may move later (operator_parts.h): what is hidden has slots, too
  uint32_t seed = 1;
};

/// @throws UsageError naming the option
void check(const TransferParams& params);

/// How the work is done; nothing of it changes the result.
struct TransferWork {
  Progress progress;
  TransferState* state = nullptr;  ///< keeps finished rows of F, to go on after an interruption; may be null
  Ranks ranks{};                   ///< share the rows; all get the operator
};

/// An operator, and for pixels the lobes of those that mirror, if there are any, by the same cloud.
struct MadeOperators {
  Operator op;
  std::optional<Operator> lobes;
};

/// Rows stream through compression cluster by cluster; F is never held whole. The same bits at any number of
/// threads and ranks.
/// @param scene  hash that ties the file to its package: operator_scene()
/// @throws UsageError naming the option; Cancelled
MadeOperators make_operators(const TracedScene& traced, const RelightReceivers& receivers,
                             const TransferParams& params, const std::string& scene,
                             const TransferWork& work = {});
/// The first of them.
Operator make_operator(const TracedScene& traced, const RelightReceivers& receivers,
                       const TransferParams& params, const std::string& scene, const TransferWork& work = {});

/// Identity of what an operator depends on in a package: geometry, materials, texels.
std::string operator_scene(const Package& package);

}  // namespace sconce
