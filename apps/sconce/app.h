// SPDX-License-Identifier: Apache-2.0
// What every verb shares. One file per verb; main.cpp holds the table; options.cpp is the only file that
// includes CLI11.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/progress.h"

namespace sconce::app {

enum ExitCode { kDone = 0, kFailed = 1, kUsage = 2, kDiffers = 3 };

/// What --help ends with: two commands to paste and one that usually follows, in which {NAME}s stand for
/// files.
struct Guide {
  const char *first = "", *second = "", *next = "";
};

/// Declares a verb's options once: command line, --config / side-file key, --help, provenance. A value is
/// read from the command line, else from the [options] table of --config or of the scene's side file, else it
/// stays the default.
class Options {
 public:
  explicit Options(std::string verb, std::string summary, Guide guide = {});
  ~Options();

  void positional(const std::string& name, std::string* value, const std::string& doc, bool required = true);
  void positionals(const std::string& name, std::vector<std::string>* values, const std::string& doc,
                   bool required = false);
  void option(const std::string& names, std::string* value, const std::string& doc);
  void option(const std::string& names, std::vector<std::string>* values, const std::string& doc);
  void option(const std::string& names, int* value, const std::string& doc);
  void option(const std::string& names, double* value, const std::string& doc);  ///< accepts 2% as 0.02
  void duration(const std::string& names, double* seconds,
                const std::string& doc);  ///< 90s, 10m, 1h; bare = seconds
  void flag(const std::string& names, bool* value, const std::string& doc);

  /// Common to all: --json, --quiet, --threads N, --config FILE, --help. `argv` starts after the verb.
  /// @return exit code when nothing is left to do (help, usage error), else nullopt
  std::optional<int> parse(int argc, const char* const* argv);
  /// Applies `[options]` of a TOML file where the command line and files applied before said nothing
  /// (--config is applied by parse()). A file that does not exist or has no such table applies nothing.
  /// @param source_name  what provenance calls the file
  /// @throws UsageError (file:line, key, allowed)
  void apply_file(const std::string& path, const std::string& source_name);

  struct Value {
    std::string value, source;  ///< source: "default", "command line", "FILE:LINE"
  };
  std::map<std::string, Value> provenance() const;

  /// The last line of success: the guide's next step with these files in the places of its {NAME}s. Nothing
  /// where --quiet or --json asks for none.
  void next(const std::vector<std::string>& files) const;

  bool json = false, quiet = false;
  int threads = 0;
  std::string config;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Progress with ETA on a terminal (stderr), warnings on stderr, Ctrl-C as a stop request.
Progress make_progress(const Options& options);

/// One line on standard error, in colour on a terminal.
void print_error(std::string_view verb, const std::string& what);
void print_warning(const std::string& what);

/// `argv` of a verb starts after its name. A verb returns an ExitCode and throws Error; main() prints.
struct Verb {
  const char* name;
  const char* summary;
  int (*run)(int argc, const char* const* argv);
  std::span<const Verb> actions = {};  ///< of a verb that has no options of its own
};

/// What `sconce`, `sconce --help`, `sconce --version` and `sconce help --markdown` print.
std::string first_words();
std::string verbs_text(std::span<const Verb> verbs);
std::string version_text();
/// docs/cli.md, out of every verb's --help. It is printed as it comes.
void print_reference(std::span<const Verb> verbs);

int run_info(int argc, const char* const* argv);
int run_bake(int argc, const char* const* argv);
int run_merge(int argc, const char* const* argv);
int run_mix(int argc, const char* const* argv);
int run_render(int argc, const char* const* argv);
int run_shader(int argc, const char* const* argv);
int run_export(int argc, const char* const* argv);
int run_serve(int argc, const char* const* argv);
int run_luminaire(int argc, const char* const* argv);
int run_transfer(int argc, const char* const* argv);
int run_relight(int argc, const char* const* argv);
int run_init(int argc, const char* const* argv);
int run_probe(int argc, const char* const* argv);
int run_fit(int argc, const char* const* argv);
int run_view(int argc, const char* const* argv);
int run_diff(int argc, const char* const* argv);

}  // namespace sconce::app
