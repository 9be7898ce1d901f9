// SPDX-License-Identifier: Apache-2.0
// Blender's files, by Blender itself: it runs sconce_blender.py, and what that writes is read.
#include <cstdlib>
#include <fstream>
#include <system_error>

#include "core/error.h"
#include "core/files.h"
#include "core/program.h"
#include "core/scratch_folder.h"
#include "core/text.h"
#include "import/import.h"

namespace fs = std::filesystem;

namespace sconce {

namespace {

constexpr const char* kScript =
#include "import/sconce_blender.py.h"
    ;

/// Blender's lines that are ours ("sconce: ...") are warnings.
void pass_on_warnings(const fs::path& output, const std::string& where, const Progress& progress) {
  std::ifstream lines(output);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("sconce: ")) progress.warn(where + ": " + line.substr(8));
}

/// What Python or Blender said at last.
std::string last_line(const fs::path& file) {
  std::ifstream lines(file);
  std::string last;
  for (std::string line; std::getline(lines, line);)
    if (line.find("Error: ") != std::string::npos && !line.starts_with("Error: script")) last = line;
  return last;
}

}  // namespace

Scene import_blend(const fs::path& path, const Progress& progress) {
  if (lower(path.extension().string()) != ".blend") throw NotMyFormat(path.string(), "is no Blender file");
  const std::string where = path.string();
  if (std::error_code ec; !fs::is_regular_file(path, ec)) throw Error(where, "no such file");
  const char* given = std::getenv("BLENDER");
  const ScratchFolder scratch;
  const fs::path& folder = scratch.path();
  const fs::path script = folder / "sconce_blender.py", scene = folder / "scene.glb", out = folder / "out",
                 errors = folder / "errors";
  write_file(script, kScript);
  std::vector<std::string> words = command_words(given != nullptr ? given : "blender");
  words.insert(words.end(), {"-b", "--factory-startup", fs::absolute(path).string(), "--python-exit-code",
                             "1", "-P", script.string(), "--", scene.string()});
  int code = 127;
  try {
    code = run_program(words, out, errors, progress);
  } catch (const Cancelled&) {
    throw;
  } catch (const Error&) {
  }
  if (code == 127)
    throw Error(where, "is read by Blender, and '" + words[0] + "' is not there",
                "install blender, or name it by BLENDER=...");
  if (code != 0 || !fs::exists(scene)) {
    const std::string why = last_line(errors) + last_line(out);
    throw Error(where, "Blender cannot export it" + (why.empty() ? std::string() : ": " + why));
  }
  pass_on_warnings(out, where, progress);
  Scene read = import_gltf(scene, progress);
  fs::path side = scene;
  side.replace_extension(".toml");
  if (fs::exists(side)) apply_side_file(side, read, progress);
  return read;
}

}  // namespace sconce
