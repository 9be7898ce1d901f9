// SPDX-License-Identifier: Apache-2.0
#include "core/program.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

namespace sconce {

namespace {

using namespace std::chrono_literals;

/// A file descriptor that is closed again.
struct Descriptor {
  int fd = -1;

  explicit Descriptor(int fd_) : fd(fd_) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  void close() {
    if (fd >= 0) ::close(fd);
    fd = -1;
  }
};

int open_output(const std::filesystem::path& path) {
  const int fd = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (fd < 0) throw Error(path.string(), std::string("cannot be written: ") + std::strerror(errno));
  return fd;
}

/// In the child: only calls that are safe between fork and exec. Does not return.
[[noreturn]] void become(char* const* argv, int in, int out, int err, int report) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);  // when even Ctrl-C twice has ended us
  ::dup2(in, STDIN_FILENO);
  ::dup2(out, STDOUT_FILENO);
  ::dup2(err, STDERR_FILENO);
  ::execvp(argv[0], argv);
  const int reason = errno;
  [[maybe_unused]] const ssize_t written = ::write(report, &reason, sizeof reason);
  ::_exit(127);
}

/// @return whether the process has ended, and then its status
bool ended(pid_t pid, int& status) {
  pid_t result = 0;
  do result = ::waitpid(pid, &status, WNOHANG);
  while (result < 0 && errno == EINTR);
  return result != 0;
}

void end_group(pid_t pid) {
  int status = 0;
  ::kill(-pid, SIGTERM);
  for (int i = 0; i < 100; ++i) {
    if (ended(pid, status)) break;
    std::this_thread::sleep_for(20ms);
  }
  ::kill(-pid, SIGKILL);  // whatever of the group is left
  while (!ended(pid, status)) std::this_thread::sleep_for(5ms);
}

}  // namespace

std::vector<std::string> command_words(const std::string& command) {
  std::error_code ec;
  if (std::filesystem::is_regular_file(command, ec)) return {command};
  std::vector<std::string> words;
  bool inside = false;
  char quote = 0;
  for (std::size_t i = 0; i < command.size(); ++i) {
    const char c = command[i];
    const bool blank = c == ' ' || c == '\t' || c == '\n';
    if (quote == 0 && blank) {
      inside = false;
      continue;
    }
    if (!inside) words.emplace_back();
    inside = true;
    if (quote != '\'' && c == '\\' && i + 1 < command.size()) {
      words.back() += command[++i];
    } else if (quote == 0 && (c == '\'' || c == '"')) {
      quote = c;
    } else if (c == quote) {
      quote = 0;
    } else {
      words.back() += c;
    }
  }
  if (quote != 0) throw UsageError("command '" + command + "'", std::string("has no closing ") + quote);
  if (words.empty() || words.front().empty()) throw UsageError("command", "is empty", "a program");
  return words;
}

int run_program(std::span<const std::string> words, const std::filesystem::path& standard_output,
                const std::filesystem::path& standard_error, const Progress& progress) {
  std::vector<char*> argv;
  for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  const Descriptor in(::open("/dev/null", O_RDONLY | O_CLOEXEC));
  const Descriptor out(open_output(standard_output)), err(open_output(standard_error));
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw Error(words.front(), "cannot be started: no pipe");
  Descriptor report(ends[0]), reporter(ends[1]);

  const pid_t pid = ::fork();
  if (pid < 0) throw Error(words.front(), std::string("cannot be started: ") + std::strerror(errno));
  if (pid == 0) become(argv.data(), in.fd, out.fd, err.fd, reporter.fd);
  ::setpgid(pid, pid);  // here too, whoever comes first: end_group() must find the group
  reporter.close();

  int reason = 0, status = 0;
  ssize_t got = 0;
  do got = ::read(report.fd, &reason, sizeof reason);  // ends at exec, which closes the other end
  while (got < 0 && errno == EINTR);
  if (got == static_cast<ssize_t>(sizeof reason)) {
    while (!ended(pid, status)) std::this_thread::sleep_for(1ms);
    throw Error(words.front(), std::string("cannot be started: ") + std::strerror(reason));
  }
  while (!ended(pid, status)) {
    if (progress.stop.stop_requested()) {
      end_group(pid);
      throw Cancelled();
    }
    std::this_thread::sleep_for(10ms);
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace sconce
