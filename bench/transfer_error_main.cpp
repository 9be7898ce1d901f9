// SPDX-License-Identifier: Apache-2.0
// How far indirect light by transfer is from the path tracer's, for lamps at random places: relative error
// over boxes of SIDE x SIDE pixels (4), of indirect light alone. Usage: transfer_error PACKAGE OPERATOR
// [LAMPS BOXES PATHS SEED SIDE]; paths are per box. The table: bench/results/transfer.md.
#include <chrono>
#include <ctime>

#include "transfer/folded_bounces.h"
#include "transfer_case.h"

using namespace sconce;

namespace {

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// What leaving small coefficients out costs and saves: means over lamps, of F's product alone.
class CullingTable {
 public:
  explicit CullingTable(const ClusterRows& gather) : gather_(gather), culling_(gather) {}

  /// @param light  coefficients, after all bounces
  void add(const std::vector<Rgbx>& light) {
    ++lamps_;
    std::vector<Rgb> whole(gather_.rows), part(gather_.rows);
    whole_ms_ += fastest([] {}, [&] { multiply(gather_, light, whole); });
    double norm = 0;
    for (const Rgb& e : whole) norm += square(e);
    for (Row& row : rows_) {
      std::vector<Rgbx> left;
      Culling::Report report;
      // Finding them is paid for each time.
      row.ms += fastest([&] { left = light; },
                        [&] {
                          report = culling_.apply(row.share, left);
                          multiply(gather_, left, part, Zeros::skip);
                        });
      double squares = 0;
      for (std::size_t i = 0; i < part.size(); ++i) squares += square(part[i] - whole[i]);
      row.kept += 1 - static_cast<double>(report.culled) / static_cast<double>(report.of);
      row.error += std::sqrt(squares / norm), row.bound += report.bound / std::sqrt(norm);
    }
  }
  void print() const {
    fmt::print("F's product, nothing culled: {:.2f} CPU ms\n", whole_ms_ / lamps_);
    for (const Row& row : rows_)
      fmt::print(
          "culled below {:<6}: {:4.1f} % kept, error {:.3f} %, bound {:.1f} %, {:.2f} CPU ms, {:.2f} x\n",
          row.share, 100 * row.kept / lamps_, 100 * row.error / lamps_, 100 * row.bound / lamps_,
          row.ms / lamps_, whole_ms_ / row.ms);
  }

 private:
  struct Row {
    float share;
    double kept = 0, error = 0, bound = 0, ms = 0;
  };
  static double square(const Rgb& e) { return static_cast<double>(e.r * e.r + e.g * e.g + e.b * e.b); }
  /// CPU time of all threads, ms: a busy machine does not lengthen it much. @param first  before each
  template <class First, class F>
  static double fastest(const First& first, const F& f) {
    double least = 1e30;
    for (int repeat = 0; repeat < 30; ++repeat) {
      first();
      const std::clock_t start = std::clock();
      f();
      least = std::min(least, 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    }
    return least;
  }

  const ClusterRows& gather_;
  Culling culling_;
  double whole_ms_ = 0;
  int lamps_ = 0;
  std::array<Row, 4> rows_{{{1e-4f}, {3e-4f}, {1e-3f}, {3e-3f}}};
};

void report(const Words& words) {
  const TransferCase own(words, 2048);
  const auto& [package, view, op, lamps, boxes, truth] = own;
  if (truth.light.empty()) throw UsageError("PATHS", "0", "some");
  const FoldedBounces bounces(op);
  CullingTable culling(op.gather);
  std::vector<Rgb> indirect(op.gather.rows);
  Errors by_kind[2];
  for (std::size_t g = 0; g < lamps.size(); ++g) {
    const MovedLamps moved(view.scene(), view.world(), view.tracer(), {{lamps[g]}}, {});
    const auto start = std::chrono::steady_clock::now();
    std::vector<Rgbx> light = light_cloud(op, moved);
    const double cloud = milliseconds_since(start);
    bounces.apply(light);
    multiply(op.gather, light, indirect);
    culling.add(light);
    const std::vector<double> have = over_boxes(boxes, indirect);
    Errors one;
    one.add(have, truth, g);
    by_kind[g % 2].add(have, truth, g);
    fmt::print("{:6} {:2}: {}, cloud {:.0f} ms\n", g % 2 == 0 ? "point" : "spot", g, one.text(), cloud);
  }
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    double least = 1e30;
    for (int repeat = 0; repeat < 30; ++repeat) {
      std::vector<Rgbx> light(op.slots(), Rgbx{1, 1, 1, 0});
      const auto start = std::chrono::steady_clock::now();
      bounces.apply(light);
      multiply(op.gather, light, indirect);
      least = std::min(least, milliseconds_since(start));
    }
    fmt::print("{} thread(s): light to light {:.2f} ms, the least of 30\n", threads, least);
  }
  culling.print();
  fmt::print("\n{}: {} receivers, {} slots, {:.1f} MB, {:.0f} multiplications per receiver, {} sweeps\n",
             words.name(1), op.gather.rows, op.slots(), static_cast<double>(op.bytes()) / 1e6,
             op.gather.macs_per_row(), op.sweeps);
  for (int kind = 0; kind < 2; ++kind)
    if (by_kind[kind].lamps > 0) fmt::print("{:6} {}\n", kind == 0 ? "point" : "spot", by_kind[kind].text());
}

}  // namespace

int main(int argc, char** argv) {
  return run_with_words(argc, argv, 2,
                        "transfer_error PACKAGE OPERATOR [LAMPS [BOXES [PATHS [SEED [SIDE]]]]]", report);
}
