// SPDX-License-Identifier: Apache-2.0
// Runs the program as its users do, and keeps what it said.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "core/test_folder.h"
#include "core/text.h"

namespace sconce::test {

struct Outcome {
  int code = -1;  ///< exit code, or 128 + signal
  std::string out, err;
};

/// `PROGRAM ARGS...`. @param prefix  shell text before it, e.g. "ulimit -f 10;"
inline Outcome run_program(const std::string& program, const std::vector<std::string>& args,
                           const std::string& prefix = {}) {
  const TemporaryFolder folder;
  std::string command = prefix + " " + shell_word(program);
  for (const std::string& arg : args) command += " " + shell_word(arg);
  command += " >" + shell_word((folder / "out").string()) + " 2>" + shell_word((folder / "err").string());
  const int status = std::system(command.c_str());
  Outcome outcome;
  outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  outcome.out = read_file(folder / "out");
  outcome.err = read_file(folder / "err");
  return outcome;
}

/// The prefix that gives a program a display of its own. @param size  e.g. "900x560"
inline std::string with_display(const std::string& size, int seconds) {
  return shell_word(SCONCE_SOURCE_DIR "/tests/with_display.sh") + " " + size + " timeout " +
         std::to_string(seconds);
}

/// Whether the distribution's headless browser can be driven (web/test).
inline bool can_browse() {
  const bool browser = std::getenv("CHROMIUM") != nullptr || std::filesystem::exists("/usr/bin/chromium");
  return browser && std::system("command -v node >/dev/null") == 0 &&
         std::filesystem::exists(SCONCE_SOURCE_DIR "/web/node_modules/playwright-core");
}

inline Outcome run_sconce(const std::vector<std::string>& args, const std::string& prefix = {}) {
  return run_program(SCONCE_PROGRAM, args, prefix);
}

/// `sconce ARGS...` in the background. @return its process
inline pid_t start_sconce(std::vector<std::string> args) {
  args.insert(args.begin(), SCONCE_PROGRAM);
  const pid_t pid = ::fork();
  if (pid == 0) {
    std::vector<char*> argv;
    for (std::string& word : args) argv.push_back(word.data());
    argv.push_back(nullptr);
    ::execv(argv[0], argv.data());
    ::_exit(127);
  }
  return pid;
}

}  // namespace sconce::test
