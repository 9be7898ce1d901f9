// SPDX-License-Identifier: Apache-2.0
#include "picture_sequence.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "core/error.h"
#include "mix_picture.h"

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
  options.option("--frames", &frames, "pictures of the sequence; the output has %04d (or %d) for the number");
}

void SequenceOptions::check(const std::string& output) const {
  if (from.empty() || to.empty() || frames == 0)
    throw UsageError({}, "a sequence needs --from, --to and --frames");
  if (frames < 2 || frames > kMostFrames)
    throw UsageError("option '--frames'", fmt::format("{} frames", frames),
                     fmt::format("2 to {}", kMostFrames));
  frame_file(output, 1, "option '--output'");
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

std::vector<std::string> write_sequence(
    const SequenceOptions& sequence, const SequenceEnd& from, const SequenceEnd& to,
    const std::string& output, const std::function<void(const std::string&, const SequenceEnd&)>& write,
    const Progress& progress) {
  std::vector<std::string> files;
  for (int i = 0; i < sequence.frames; ++i) {
    progress.check();
    progress.at("frames", static_cast<uint64_t>(i), static_cast<uint64_t>(sequence.frames));
    files.push_back(frame_file(output, i + 1, "option '--output'"));
    write(files.back(), between(from, to, static_cast<double>(i) / (sequence.frames - 1)));
  }
  return files;
}

}  // namespace sconce::app
