// SPDX-License-Identifier: Apache-2.0
// The operator without compression: rows by the same rays as the default's, all wavelet coefficients of all
// rows as floats. What it gives is what radiosity on the cloud gives, to float rounding (exact_test.cpp), so
// that others can be held against it. Gigabytes at full size.
#pragma once

#include "relight/precompute.h"

namespace sconce {

/// As make_operators(). @pre check(params); no transmission
MadeOperators make_exact_operator(const TracedScene& traced, const RelightReceivers& receivers,
                                  const TransferParams& params, const std::string& scene,
                                  const TransferWork& work = {});

}  // namespace sconce
