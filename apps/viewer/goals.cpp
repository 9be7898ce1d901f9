// SPDX-License-Identifier: Apache-2.0
// Faders that go where wishes are met.
#include <fmt/format.h>

#include "core/files.h"
#include "core/text.h"
#include "image/io.h"
#include "viewer/viewer.h"

namespace fs = std::filesystem;

namespace sconce::viewer {

void Viewer::add_goal(const Vec3& position, const Vec3& normal, double target, std::vector<Rgb> lux) {
  state_.goals.push_back({position, normal, target, lux, lux});
  if (state_.away()) measure();
}

void Viewer::seek() {
  Session& session = *state_.session;
  if (state_.goals.empty()) return note("no goal yet: Ctrl-click a surface in the picture");
  const std::vector<Rgb> unit = unit_weights(session.groups(), session.mood().faders);
  Wishes wishes(unit.size());
  for (const Goal& goal : state_.goals) wish_lux(wishes, goal.lux, unit, goal.target);
  std::vector<double> power;
  for (const GroupInfo& group : session.groups()) power.push_back(group.lumens);
  const Fit found = fit(wishes, power, 1e-4);
  Mood mood = session.mood();
  mood.faders = with_gains(mood.faders, found.gains);
  session.fade_to(mood, state_.fade_seconds);
  state_.sought_faders = mood.faders;
  double now = 0, all = 0;
  for (std::size_t g = 0; g < power.size(); ++g) now += power[g] * found.gains[g], all += power[g];
  state_.sought = fmt::format("residual {:.1f} % of the goals", 100 * found.residual);
  if (all > 0) state_.sought += fmt::format(", {:.0f} lm (as baked {:.0f})", now, all);
}

void Viewer::seek_picture(const fs::path& file) {
  Session& session = *state_.session;
  const MixSpec mix = session.mix();
  const std::string ending = lower(file.extension().string());
  const bool linear = ending == ".exr" || ending == ".hdr";
  Image target = linear ? read_image(file) : Image();
  if (!linear) {
    const std::string bytes = read_file(file);
    target = from_display(
        decode_image8({reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()}, file.string()),
        0.18f / session.exposure(state_.screen().metering()).scale);
  }
  const std::vector<Rgb> unit = unit_weights(session.groups(), session.mood().faders);
  Wishes wishes(unit.size());
  if (state_.sheet)
    wish_picture(wishes, state_.sheet->opened(), unit, target);
  else
    wish_picture(wishes, rays(), moved_light(state_.movers(), layers_of(state_.opened)), state_.camera, unit,
                 target);
  const Fit found = fit(wishes);
  Mood mood = session.mood();
  mood.faders = with_gains(mood.faders, found.gains);
  session.fade_to(mood, state_.fade_seconds);
  state_.sought_faders = mood.faders;
  state_.sought = fmt::format("{}: residual {:.1f} %", file.filename().string(), 100 * found.residual);
  note("faders moved to look like " + file.filename().string());
}

}  // namespace sconce::viewer
