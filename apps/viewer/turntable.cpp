// SPDX-License-Identifier: Apache-2.0
// The camera turns once, and every picture that has come to rest is kept: `sconce render --turntable` by the
// window.
#include <fmt/chrono.h>

#include <ctime>

#include "core/error.h"
#include "session/turntable.h"
#include "viewer/viewer.h"

namespace fs = std::filesystem;

namespace sconce::viewer {

void Viewer::begin_turn(const std::string& output, int count) {
  stop_turn();
  auto frames = std::make_shared<Frames>(output, Frames::kPerSecond, "turntable");
  turning_.emplace(Turning{.start = state_.camera,
                           .axis = turntable_axis(state_.opened->rays, state_.camera),
                           .count = count,
                           .frames = std::move(frames)});
}

void Viewer::begin_turn() {
  constexpr int kCount = 120;
  const std::string name =
      fmt::format("sconce-turntable-{:%Y%m%d-%H%M%S}", fmt::localtime(std::time(nullptr)));
  try {
    begin_turn(name + ".mp4", kCount);
  } catch (const Error& error) {
    note(error.what());
    fs::create_directory(name);
    begin_turn(name + "/%04d.png", kCount);
  }
}

void Viewer::stop_turn() {
  if (!turning_) return;
  state_.camera = turning_->start;
  drawing_more_ = true;
  turning_.reset();
}

void Viewer::turn() {
  if (const auto written = filming_.take()) note("turntable written: " + *written);
  if (!turning_) return;
  Turning& t = *turning_;
  // Rays hand over their last picture in the frame after they have ended.
  const bool rests = !drawing_more_ && !mirroring_.running();
  if (!std::exchange(t.rested, rests) || !rests) return;
  try {
    write_picture(t.frames->next());
  } catch (const Error&) {
    stop_turn();
    throw;
  }
  t.rested = false;
  if (++t.at < t.count) {
    state_.camera = turned(t.start, t.axis, t.at, t.count);
    return;
  }
  filming_.start([frames = t.frames](const Progress& progress, const auto& publish) {
    const std::vector<std::string> files = frames->finish(progress);
    publish(files.size() > 1 ? files.front() + " ... " + files.back() : files.front());
  });
  stop_turn();
}

}  // namespace sconce::viewer
