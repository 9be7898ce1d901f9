// SPDX-License-Identifier: Apache-2.0
#include "core/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <thread>

namespace sconce {

ThreadLimit::ThreadLimit(int threads)
    : control_(new tbb::global_control(
          tbb::global_control::max_allowed_parallelism,
          threads > 0 ? static_cast<std::size_t>(threads)
                      : std::max<std::size_t>(1, std::thread::hardware_concurrency()))) {}

ThreadLimit::~ThreadLimit() {
  delete static_cast<tbb::global_control*>(control_);
}

int ThreadLimit::current() {
  return static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

void parallel_for(std::size_t n, std::size_t grain, const std::function<void(std::size_t)>& f) {
  // The caller's rounding and subnormals; else TBB's are those of its first use, which is inside Embree, and
  // Embree lets subnormals be 0.
  tbb::task_group_context context(tbb::task_group_context::bound, tbb::task_group_context::default_traits |
                                                                      tbb::task_group_context::fp_settings);
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, n, std::max<std::size_t>(1, grain)),
      [&](const tbb::blocked_range<std::size_t>& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) f(i);
      },
      tbb::simple_partitioner(), context);
}

}  // namespace sconce
