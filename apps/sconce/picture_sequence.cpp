// SPDX-License-Identifier: Apache-2.0
#include "picture_sequence.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "core/error.h"
#include "core/text.h"

namespace fs = std::filesystem;

namespace sconce::app {

namespace {

constexpr int kMostFrames = 100000;

float geometric(float a, float b, double t) {
  return static_cast<float>(std::exp2((1 - t) * std::log2(double{a}) + t * std::log2(double{b})));
}

}  // namespace

void SequenceOptions::declare(Options& options) {
  options.option("--from", &from,
                 "preset that a sequence begins with, FILE or FILE.toml; with --to, --frames");
  options.option("--to", &to,
                 "preset that it ends with: light fades from one to the other, exposure in stops");
  options.option(
      "--frames", &frames,
      "pictures of the sequence; the output has %04d (or %d) for the number, or is NAME.mp4 (needs ffmpeg)");
  options.option(
      "--turntable", &turntable,
      "so many pictures of a camera that turns once around --target, else around the scene, or on the spot "
      "where walls stand in the way; output as for --frames");
  options.option("--fps", &fps, "pictures per second of an MP4 (default: 25)");
}

void SequenceOptions::check(const std::string& output) const {
  const bool film = lower(fs::path(output).extension().string()) == ".mp4";
  if (!given()) {
    if (film)
      throw UsageError("option '--output'", "a film needs pictures in a row", "--frames, --turntable");
  } else if (fades() && turntable != 0) {
    throw UsageError({}, "--turntable and a fade exclude each other");
  } else if (fades() && (from.empty() || to.empty() || frames == 0)) {
    throw UsageError({}, "a sequence needs --from, --to and --frames");
  } else if (const int count = fades() ? frames : turntable; count < 2 || count > kMostFrames) {
    throw UsageError(fades() ? "option '--frames'" : "option '--turntable'", fmt::format("{} frames", count),
                     fmt::format("2 to {}", kMostFrames));
  }
  if (given() && !film) frame_file(output, 1, "option '--output'");
  if (fps == 0) return;
  if (!film) throw UsageError("option '--fps'", "only films have a speed", "-o NAME.mp4");
  if (!(fps >= 1 && fps <= 240)) throw UsageError("option '--fps'", fmt::format("{:g}", fps), "1 to 240");
}

Frames SequenceOptions::open(const std::string& output) const {
  return Frames(output, fps != 0 ? fps : Frames::kPerSecond, "option '--output'");
}

Preset read_named_preset(const std::string& name) {
  return read_preset(fs::exists(name) || !fs::exists(name + ".toml") ? name : name + ".toml");
}

SequenceEnd between(const SequenceEnd& a, const SequenceEnd& b, double t) {
  SequenceEnd out = a;
  const auto share = static_cast<float>(t);
  for (std::size_t i = 0; i < out.linear.data.size(); ++i)
    out.linear.data[i] = (1 - share) * a.linear.data[i] + share * b.linear.data[i];
  out.exposure.scale = geometric(a.exposure.scale, b.exposure.scale, t);
  out.exposure.params.maximum = geometric(a.exposure.params.maximum, b.exposure.params.maximum, t);
  return out;
}

std::vector<std::string> write_frames(Frames& frames, int count,
                                      const std::function<void(int frame, const std::string& file)>& draw,
                                      const Progress& progress) {
  for (int i = 0; i < count; ++i) {
    progress.check();
    progress.at("frames", static_cast<uint64_t>(i), static_cast<uint64_t>(count));
    draw(i, frames.next().string());
  }
  return frames.finish(progress);
}

}  // namespace sconce::app
