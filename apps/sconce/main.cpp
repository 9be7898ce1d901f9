// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <new>
#include <optional>
#include <span>

#include "app.h"
#include "core/error.h"
#include "core/text.h"
#include "luminaire.h"

namespace {

using namespace sconce;
using namespace sconce::app;

const Verb kVerbs[] = {
    {"info", "what is in a scene or a package: counts, groups with lumens, cameras, layers", run_info},
    {"init", "a commented side file for a scene, or a room with luminaires", run_init},
    {"bake", "a scene to a package with one lightmap per light group", run_bake},
    {"merge", "shards of one bake to a package", run_merge},
    {"mix", "a package (or a picture with light groups) and settings to one lightmap (or picture)", run_mix},
    {"render", "a package and group settings to a picture", run_render},
    {"export", "a package as a web page with faders, for any web server", run_export},
    {"serve", "that page from this machine, its faders shared between windows and scripts", run_serve},
    {"shader", "the shader that mixes a package's layers, for another renderer", run_shader},
    {"luminaire", "measured lamps: info, check, convert", run_luminaire, luminaire_actions()},
    {"transfer", "a package to an operator that carries moved lamps' light through all bounces",
     run_transfer},
    {"relight", "a package, its operator and moved lamps to a picture", run_relight},
    {"probe", "lux at points or on a plane, per light group: table, page, picture", run_probe},
    {"fit", "faders that come nearest to a picture or to lux at points, as a preset", run_fit},
    {"view", "a window with faders, on a package or on a scene that is baked while you look", run_view},
    {"diff", "how far two images differ", run_diff},
};

std::string usage() {
  return "usage: sconce VERB [arguments]\n\nLight-group lightmaps: bake once, re-mix the lights "
         "afterwards.\n\n" +
         verbs_text(kVerbs) +
         "\n'sconce VERB --help' lists a verb's options; 'sconce --version' what is built in.\n";
}

int complain(std::string_view verb, const std::string& what, int code) {
  print_error(verb, what);
  return code;
}

/// A report that did not reach its reader (full disk) is a failure too.
int finish(const char* verb, int code) {
  const bool lost = std::fflush(stdout) != 0 || std::ferror(stdout) != 0;
  return lost && code == kDone
             ? complain(verb, std::string("standard output: ") + std::strerror(errno), kFailed)
             : code;
}

int run(const Verb& verb, int argc, const char* const* argv) {
  try {
    return finish(verb.name, verb.run(argc, argv));
  } catch (const UsageError& error) {
    return complain(verb.name, error.what(), kUsage);
  } catch (const Error& error) {
    return complain(verb.name, error.what(), kFailed);
  } catch (const std::bad_alloc&) {
    return complain(verb.name, "out of memory", kFailed);
  } catch (const std::exception& error) {
    return complain(verb.name, std::string("unexpected failure: ") + error.what(), kFailed);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::string name = argc > 1 ? argv[1] : "";
  if (name == "help" && argc > 2 && std::string_view(argv[2]) == "--markdown") {
    print_reference(kVerbs);
    return finish("", kDone);
  }
  if (name == "--help" || name == "-h" || name == "help") {
    std::fputs(usage().c_str(), stdout);
    return finish("", kDone);
  }
  if (name == "--version") {
    std::fputs(version_text().c_str(), stdout);
    return finish("", kDone);
  }
  std::vector<std::string> names;
  for (const Verb& verb : kVerbs) {
    if (name == verb.name) return run(verb, argc - 2, argv + 2);
    names.emplace_back(verb.name);
  }
  if (name.empty()) {
    std::fputs(first_words().c_str(), stderr);
    return kUsage;
  }
  return complain("",
                  fmt::format("unknown {} '{}'{} (allowed: {})", name.starts_with('-') ? "option" : "verb",
                              name, did_you_mean(name, names), join(names, ", ")),
                  kUsage);
}
