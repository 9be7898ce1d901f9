// SPDX-License-Identifier: Apache-2.0
// What benchmarks of an operator begin with.
#pragma once

#include "transfer_truth.h"
#include "words.h"

namespace sconce {

/// Members refer to each other, so it stays where it is.
struct TransferCase {
  Package package;
  View view;
  Operator op;
  std::vector<Light> lamps;
  Boxes boxes;
  Truth truth;  ///< empty without paths

  /// @param words  PACKAGE OPERATOR [LAMPS BOXES PATHS SEED SIDE]
  /// @param paths  where none are said; 0: no truth
  TransferCase(const Words& words, int paths)
      : package(Package::open(words.name(1))),
        view(package),
        op(open_operator(words.name(2))),
        lamps(random_lamps(view, op, words.number(3, 20), static_cast<uint32_t>(words.number(6, 1)))),
        boxes(make_boxes(op, static_cast<std::size_t>(words.number(4, 200)),
                         static_cast<uint32_t>(words.number(7, 4)))) {
    if (const int asked = words.number(5, paths); asked > 0)
      truth = trace_truth(view, op, lamps, boxes, asked);
  }
  TransferCase(const TransferCase&) = delete;
  TransferCase& operator=(const TransferCase&) = delete;
};

}  // namespace sconce
