// SPDX-License-Identifier: Apache-2.0
// What tables of growing cost are made of.
#pragma once

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <ctime>
#include <utility>
#include <vector>

#include "core/error.h"

namespace sconce {

/// Of all threads.
inline double cpu_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// Runs f in a child, which must be forked before this process starts any thread.
/// @return its answer and its peak memory, MB. @throws Error when it fails
template <class T, class F>
std::pair<T, double> in_own_process(const F& f) {
  int ends[2];
  if (pipe(ends) != 0) throw Error("growth", "no pipe");
  std::fflush(stdout);  // a child would print it again
  const pid_t child = fork();
  if (child < 0) throw Error("growth", "no process");
  if (child == 0) {
    try {
      const T answer = f();
      _exit(write(ends[1], &answer, sizeof answer) == sizeof answer ? 0 : 1);
    } catch (const std::exception& error) {
      fmt::print(stderr, "{}\n", error.what());
      _exit(1);
    }
  }
  close(ends[1]);
  T answer;
  const bool whole = read(ends[0], &answer, sizeof answer) == sizeof answer;
  close(ends[0]);
  int status = 0;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  if (!whole || status != 0) throw Error("growth", "a row failed");
  return {answer, static_cast<double>(usage.ru_maxrss) / 1024};
}

/// Slope of log y over log x.
inline double exponent(const std::vector<double>& x, const std::vector<double>& y) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  const auto n = static_cast<double>(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double a = std::log(x[i]), b = std::log(std::max(y[i], 1e-9));
    sx += a, sy += b, sxx += a * a, sxy += a * b;
  }
  const double spread = n * sxx - sx * sx;
  return spread > 0 ? (n * sxy - sx * sy) / spread : 0;
}

}  // namespace sconce
