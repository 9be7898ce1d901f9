// SPDX-License-Identifier: Apache-2.0
// An operator and what it was made of, so that after things moved only the rows are made again that saw them.
#pragma once

#include <optional>
#include <utility>

#include "relight/operator_start.h"
#include "transfer/training.h"

namespace sconce {

/// How much was made again.
struct FollowReport {
  std::size_t slots = 0, receivers = 0;  ///< whose rays were followed again
  std::size_t clusters = 0;              ///< that were fitted again, of all three matrices
};

class OperatorParts {
 public:
  /// What `traced` and `receivers` refer to must outlive it, but for the scene. @pre check(params)
  OperatorParts(const TracedScene& traced, const RelightReceivers& receivers, const TransferParams& params,
                const std::string& scene, const TransferWork& work);

  /// Once. What only follow() needs is kept where `params.movable`.
  Operator make(const TransferWork& work);
  /// After make(): the lobes of receivers that mirror. They do not follow.
  std::optional<Operator> take_lobes() { return std::exchange(lobes_, std::nullopt); }
  /// After triangles moved in the World, and the Tracer was made anew at its place: the operator in which
  /// rows are as if all had been made again. Slots, and the light that rows are fitted to, stay those of the
  /// start.
  /// @param all  make all rows again, to compare with
  /// @pre made, movable, as many triangles as before. @throws Cancelled: then follow() once more
  Operator follow(const Progress& progress, FollowReport* report = nullptr, bool all = false);

 private:
  using Rows = std::vector<std::vector<SparseEntry>>;
  /// A matrix: the light that it is fitted to, and its finished clusters.
  struct Fitted {
    std::unique_ptr<TrainingLight> light;
    std::vector<std::string> clusters;
  };

  void shoot_slots(const TransferWork& work, Operator& op);
  void fit_bounces(const TransferWork& work, Operator& op);
  void fit_gather(const TransferWork& work, Operator& op);
  void fit_lobes(const TransferWork& work, const Operator& op);
  template <class Changed, class Set>
  void fit(Fitted& fitted, uint32_t rows, uint32_t cluster, int coefficients, const char* stage,
           const TransferWork& work, Operator& op, ClusterRows& out, const Changed& changed, const Set& set);
  void set_albedo(Operator& op);
  /// A row as slots are weighed.
  void weigh(std::vector<SparseEntry>& row) const {
    if (!weights_.empty())
      for (SparseEntry& e : row) e.value /= weights_[e.index];
  }
  Operator finish(const TransferWork& work);
  /// Whether a row's rays may meet what moved.
  template <class Start>
  bool may_meet(const Start& start, uint32_t rays, uint32_t stream) const;

  const World& world_;
  const Tracer& tracer_;
  RelightReceivers receivers_;
  TransferParams params_;
  OperatorStart start_;
  std::vector<std::vector<Rgbx>> lights_;  ///< until all are fitted to
  Rows slot_rows_;
  std::vector<float> weights_;  ///< of slots: by the rays of the first slot_rows_ that end there (ADR 46)
  std::vector<uint8_t> slot_wanders_, receiver_wanders_;  ///< rows whose rays left their line
  std::vector<uint8_t> slots_, receivers_changed_;        ///< to be made (again)
  Fitted first_, bounce_, gather_;
  std::vector<Vec3> positions_;  ///< of the World when the rows were made
  std::vector<Bounds> boxes_;    ///< around what moved
  FollowReport report_;
  std::optional<Operator> lobes_;
};

}  // namespace sconce
