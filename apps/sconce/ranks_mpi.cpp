// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <fmt/format.h>
#include <mpi.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <thread>

#include "core/error.h"
#include "ranks.h"

namespace sconce::app {

namespace {

bool is_set(const char* variable) {
  return std::getenv(variable) != nullptr;
}

/// Waits without burning the core that a working rank may need.
void wait(MPI_Request request, const std::stop_token& stop) {
  for (int done = 0; MPI_Test(&request, &done, MPI_STATUS_IGNORE), done == 0;) {
    if (stop.stop_requested()) throw Cancelled();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

}  // namespace

RankSession::RankSession() {
  // Without a launcher MPI would start a daemon for this one process.
  if (!is_set("OMPI_COMM_WORLD_SIZE") && !is_set("PMIX_RANK") && !is_set("PMI_RANK")) {
    const char* tasks = std::getenv("SLURM_STEP_NUM_TASKS");
    if (tasks == nullptr || std::string(tasks) == "1") return;
    if (const char* task = std::getenv("SLURM_PROCID"); task != nullptr && std::string(task) != "0")
      std::exit(0);  // one voice is enough
    throw UsageError("srun", fmt::format("started {} tasks that do not know of each other", tasks),
                     "srun --mpi=pmix, mpirun, or one task");
  }
  int provided = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
  joined_ = true;
  MPI_Comm_rank(MPI_COMM_WORLD, &index_);
  MPI_Comm_size(MPI_COMM_WORLD, &count_);
  if (index_ == 0) return;
  errors_ = ::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3);
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(nowhere, STDERR_FILENO);
  ::close(nowhere);
}

RankSession::~RankSession() {
  if (joined_) MPI_Finalize();
  if (errors_ >= 0) ::close(errors_);
}

std::vector<std::string> RankSession::allgather(std::string_view mine) const {
  if (count_ == 1) return {std::string(mine)};
  const auto count = static_cast<std::size_t>(count_);
  std::vector<uint64_t> sizes(count);
  const uint64_t size = mine.size();
  MPI_Request request;
  MPI_Iallgather(&size, 1, MPI_UINT64_T, sizes.data(), 1, MPI_UINT64_T, MPI_COMM_WORLD, &request);
  wait(request, stop_);
  std::vector<std::string> all(count);
  for (std::size_t rank = 0; rank < count; ++rank) {
    std::string& bytes = all[rank];
    if (static_cast<int>(rank) == index_) bytes = mine;
    bytes.resize(sizes[rank]);
    constexpr std::size_t kChunk = 1 << 28;  // MPI counts with int
    for (std::size_t at = 0; at < bytes.size(); at += kChunk) {
      const int part = static_cast<int>(std::min(kChunk, bytes.size() - at));
      MPI_Ibcast(bytes.data() + at, part, MPI_BYTE, static_cast<int>(rank), MPI_COMM_WORLD, &request);
      wait(request, stop_);
    }
  }
  return all;
}

void RankSession::abort(const std::string& line) const {
  if (!line.empty()) ::dprintf(errors_ >= 0 ? errors_ : STDERR_FILENO, "sconce bake: %s\n", line.c_str());
  MPI_Abort(MPI_COMM_WORLD, 1);
  std::_Exit(1);
}

}  // namespace sconce::app
