// SPDX-License-Identifier: Apache-2.0
// What the program says of itself, beside the verbs' own --help.
#include <fmt/format.h>

#include <cstdio>

#include "app.h"
#include "core/text.h"
#include "encode/encoding.h"
#include "import/import.h"
#include "solve/solver.h"
#include "tone/tone.h"
#include "trace/tracer.h"

namespace sconce::app {

namespace {

template <class Row>
std::string names_of(std::span<const Row> table) {
  std::string names;
  for (const Row& row : table) names += (names.empty() ? "" : " ") + std::string(row.name);
  return names;
}

/// A verb's --help under a heading of its own; a verb of verbs also has theirs.
void print_chapter(const std::string& name, const Verb& verb, const char* heading) {
  fmt::print("\n{} {}\n\n```text\n", heading, name);
  std::fflush(stdout);
  const char* help[] = {"--help"};
  verb.run(1, help);
  fmt::print("```\n");
  for (const Verb& action : verb.actions) print_chapter(name + " " + action.name, action, "###");
}

}  // namespace

std::string first_words() {
  return "sconce bakes a scene's light once, a lightmap per group of lamps; afterwards you decide which "
         "lamps\n"
         "are on, how bright and of what colour. A scene (glTF, OBJ, FBX, ...) becomes a package, "
         "NAME.sconce;\n"
         "everything else reads packages. Illuminance is in lux, lamps in lumens, lengths in metres.\n"
         "'sconce --help' lists the verbs, 'sconce VERB --help' explains one, with examples.\n"
         "The same is in docs/cli.md. Begin with one of these:\n"
         "\n"
         "  sconce bake kitchen.glb --quality draft\n"
         "  sconce render kitchen.sconce window=off ceiling=2700K,50% -o evening.png\n"
         "  sconce init --room 8x6x2.8 --luminaire lamp.ldt --count 3x4 -o office.glb\n";
}

std::string verbs_text(std::span<const Verb> verbs) {
  std::string text;
  for (const Verb& verb : verbs) text += fmt::format("  {:<10}{}\n", verb.name, verb.summary);
  return text;
}

std::string version_text() {
  std::string text = "sconce " SCONCE_VERSION "\n";
  const auto line = [&](const char* what, const std::string& names) {
    text += fmt::format("{:<16}{}\n", what, names);
  };
  line("solvers", names_of(solvers()));
  line("encodings", names_of(encodings()));
  line("tone curves", names_of(tone_mappers()));
  line("scenes", join(std::vector<std::string>(scene_endings().begin(), scene_endings().end()), " "));
  line("instructions", isa());
  line("many processes", SCONCE_HAS_MPI ? "MPI" : "none: built without MPI");
  line("libraries", SCONCE_LIBRARIES);
  return text;
}

void print_reference(std::span<const Verb> verbs) {
  fmt::print(
      "# The command line\n\nWritten by `make docs` out of what every verb says of itself (`sconce help "
      "--markdown`); a "
      "test compares the two.\n\n```text\n{}```\n",
      verbs_text(verbs));
  for (const Verb& verb : verbs) print_chapter(verb.name, verb, "##");
}

}  // namespace sconce::app
