// SPDX-License-Identifier: Apache-2.0
// What it takes to open an operator of the default size: read into memory, as open_operator() does, beside
// mapped (ADR 44).
#include <benchmark/benchmark.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <numeric>

#include "core/hash.h"
#include "core/test_folder.h"
#include "transfer/folded_bounces.h"
#include "transfer/test_operator.h"

namespace sconce {
namespace {

const std::filesystem::path& file() {
  static const TemporaryFolder folder;
  static const std::filesystem::path path = [] {
    Operator op = made_up_operator({.receivers = 640 * 480});
    op.points_per_slot = 4;
    const std::vector<OperatorPoint> lit(op.points_per_slot * op.slots()), receivers(op.gather.rows);
    std::vector<uint32_t> places(receivers.size());
    std::iota(places.begin(), places.end(), 0u);
    op.lit = lit, op.receivers = receivers, op.places = places;
    write_operator(folder / "op.bin", op);
    return folder / "op.bin";
  }();
  return path;
}

void set_bytes(benchmark::State& state) {
  state.counters["MB"] = static_cast<double>(std::filesystem::file_size(file())) / 1e6;
}

/// @param sum  of all bytes, as a reader that checks its file needs
void map(benchmark::State& state, bool sum) {
  file();
  for (auto _ : state) {
    const int fd = ::open(file().c_str(), O_RDONLY);
    const std::size_t size = std::filesystem::file_size(file());
    void* at = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, fd, 0);
    ::close(fd);
    if (sum) benchmark::DoNotOptimize(hash_hex({static_cast<const char*>(at), size}));
    ::munmap(at, size);
  }
  set_bytes(state);
}

void open_read(benchmark::State& state) {
  file();
  for (auto _ : state) benchmark::DoNotOptimize(open_operator(file()));
  set_bytes(state);
}
BENCHMARK(open_read)->Unit(benchmark::kMillisecond);

void open_read_unchecked(benchmark::State& state) {
  file();
  for (auto _ : state) benchmark::DoNotOptimize(open_operator(file(), false));
  set_bytes(state);
}
BENCHMARK(open_read_unchecked)->Unit(benchmark::kMillisecond);

void map_and_sum(benchmark::State& state) {
  map(state, true);
}
BENCHMARK(map_and_sum)->Unit(benchmark::kMillisecond);

void map_alone(benchmark::State& state) {
  map(state, false);
}
BENCHMARK(map_alone)->Unit(benchmark::kMillisecond);

/// What comes after in any case.
void fold_bounces(benchmark::State& state) {
  const Operator op = open_operator(file());
  for (auto _ : state) benchmark::DoNotOptimize(FoldedBounces(op));
}
BENCHMARK(fold_bounces)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace sconce
