// SPDX-License-Identifier: Apache-2.0
#include "limited_run.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>

#include "core/files.h"
#include "core/program.h"
#include "core/scratch_folder.h"
#include "core/text.h"

namespace fs = std::filesystem;

namespace sconce::robustness {

namespace {

std::vector<std::string> command(const Program& program, std::vector<std::string> words) {
  const std::string seconds = std::to_string(kSeconds);
  std::vector<std::string> out = {"prlimit", "--cpu=" + seconds};
  // The shadow of the address sanitizer is address space, but no memory.
  const std::string asan = "ASAN_OPTIONS=detect_stack_use_after_return=1:hard_rss_limit_mb=";
  if (program.sanitized)
    out.insert(out.end(), {"env", asan + std::to_string(kGigabytes << 10)});
  else
    out.push_back("--as=" + std::to_string(int64_t{kGigabytes} << 30));
  const std::string asleep = std::to_string(kAsleep);
  out.insert(out.end(), {"timeout", "--signal=KILL", asleep, program.path});
  out.insert(out.end(), words.begin(), words.end());
  return out;
}

/// Of all programs that have ended.
struct Usage {
  double seconds, megabytes;  ///< computing; the most of any
};

Usage children() {
  rusage usage{};
  ::getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return {seconds(usage.ru_utime) + seconds(usage.ru_stime), static_cast<double>(usage.ru_maxrss) / 1024};
}

Run judge(int code, const std::string& said, const std::string& verb, const fs::path& file) {
  const auto has = [&](std::string_view text) { return said.find(text) != std::string::npos; };
  const std::string head = "sconce " + verb + ": ";
  std::vector<std::string> lines = split(said, '\n');
  std::erase_if(lines, [&](const std::string& line) { return !line.starts_with(head); });
  const std::string line = lines.empty() ? std::string() : lines.front().substr(head.size());
  if (has("Sanitizer") || has("runtime error: ")) return {End::finding, "sanitizer: " + trim(said)};
  if (code == 137)
    return {End::finding, fmt::format("did not end in {} s of computing, {} s in all", kSeconds, kAsleep)};
  if (code == 0) return {End::done, {}};
  if (code != 1 && code != 2) return {End::finding, "ended with code " + std::to_string(code)};
  if (has("out of memory")) return {End::finding, line};
  if (lines.size() != 1 || has("unexpected failure") || line.find(file.stem().string()) == std::string::npos)
    return {End::finding, "no clear line: " + trim(said)};
  return {End::refused, line};
}

}  // namespace

Program program_at(const std::string& path) {
  return {path, read_file(path).find("__asan_init") != std::string::npos};
}

Run run_limited(const Program& program, std::vector<std::string> words, const fs::path& file) {
  const ScratchFolder folder;
  const std::string verb = words.front();
  words.insert(words.end(), {"--quiet", "--threads", "1"});
  const double start = children().seconds;
  const int code =
      run_program(command(program, std::move(words)), folder.path() / "out", folder.path() / "err", {});
  Run run = judge(code, read_file(folder.path() / "err"), verb, file);
  run.seconds = children().seconds - start;
  return run;
}

double most_megabytes() {
  return children().megabytes;
}

}  // namespace sconce::robustness
