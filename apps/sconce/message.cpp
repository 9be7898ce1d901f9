// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "app.h"

namespace sconce::app {

namespace {

/// In colour where a terminal shows it and nobody asks for none (NO_COLOR, no-color.org).
std::string colored(const std::string& text, const char* code) {
  const auto variable = [](const char* name) {
    const char* value = std::getenv(name);
    return std::string_view(value == nullptr ? "" : value);
  };
  if (!variable("NO_COLOR").empty() || variable("TERM") == "dumb" || isatty(STDERR_FILENO) == 0) return text;
  return std::string("\033[") + code + "m" + text + "\033[0m";
}

/// fputs: where even stderr is lost, fmt would throw out of the handler.
void print_line(const std::string& head, const char* color, std::string text) {
  for (char& c : text)
    if (c == '\n' || c == '\r') c = ' ';  // one line, whatever a library put into it
  std::fputs((colored(head, color) + " " + text + "\n").c_str(), stderr);
}

}  // namespace

void print_error(std::string_view verb, const std::string& what) {
  print_line(fmt::format("sconce{}{}:", verb.empty() ? "" : " ", verb), "1;31", what);
}

void print_warning(const std::string& what) {
  print_line("warning:", "33", what);
}

}  // namespace sconce::app
