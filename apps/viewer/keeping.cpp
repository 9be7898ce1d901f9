// SPDX-License-Identifier: Apache-2.0
// What is kept in files: pictures, presets, packages, scenes.
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>

#include "core/error.h"
#include "core/files.h"
#include "core/text.h"
#include "image/io.h"
#include "package/manifest.h"
#include "session/to_scene.h"
#include "viewer/viewer.h"

namespace fs = std::filesystem;

namespace sconce::viewer {

void Viewer::name_shown() {
  if (state_.file == state_.coming) return;
  state_.file = state_.coming;
  remembered_.opened(state_.file);
  window_.set_title(state_.file.filename().string() + " - sconce");
}

void Viewer::screenshot() {
  const std::string name = fmt::format("sconce-{:%Y%m%d-%H%M%S}{}", fmt::localtime(std::time(nullptr)),
                                       ImGui::GetIO().KeyShift ? ".exr" : ".png");
  write_picture(name);
  note("picture written: " + fs::absolute(name).string());
}

void Viewer::write_picture(const fs::path& file) const {
  if (lower(file.extension().string()) == ".exr")
    write_exr(file, state_.screen().linear(), PixelType::full);
  else
    write_png(file, state_.screen().read());
}

void Viewer::save_package(fs::path target) {
  if (target.empty()) target = fs::path(state_.file).replace_extension(".sconce");
  if (fs::exists(target) && !is_package(target))
    throw Error(target.string(), "exists and is no package, so it is left alone");
  Beside beside(target);
  fs::copy(state_.package, beside.path(), fs::copy_options::recursive);
  beside.commit();
  note("package written: " + target.string());
}

void Viewer::save_scene(fs::path target) {
  if (target.empty()) target = state_.file.parent_path() / (state_.file.stem().string() + "-relit.glb");
  const std::vector<StandingLamp> lamps = state_.movers().standing();
  for (const StandingLamp& one : lamps)
    if (!one.itself && !one.other) note(shader_left_out(state_.lamps.mover->movable().names[one.lamp]));
  const SceneFiles written = write_scene(
      target, relit_scene(standing_scene(rays().scene(), rays().world(), lamps), state_.session->mix()),
      state_.opened->package.manifest().generator);
  for (const std::string& warning : written.warnings) note(warning);
  note("scene written: " + target.string());
}

}  // namespace sconce::viewer
