// SPDX-License-Identifier: Apache-2.0
#include "mix_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>

#include "core/error.h"
#include "core/files.h"
#include "core/text.h"
#include "image/frames.h"
#include "image/io.h"
#include "image/primaries.h"
#include "mix/layered_image.h"
#include "tone/apply.h"

namespace fs = std::filesystem;

namespace sconce::app {

namespace {

constexpr int kMostFrames = 1000000;

std::vector<int> parse_frames(const std::string& text) {
  const auto number = [&](std::string_view part) {
    int value = -1;
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
    if (error != std::errc() || end != part.data() + part.size() || value < 0)
      throw UsageError("option '--frames'", "'" + text + "' is no range", "FIRST-LAST or N");
    return value;
  };
  const std::size_t dash = text.find('-');
  const int first = number(text.substr(0, dash)),
            last = dash == std::string::npos ? first : number(text.substr(dash + 1));
  if (last < first || last - first >= kMostFrames)
    throw UsageError("option '--frames'", "'" + text + "' is no range", "FIRST-LAST or N");
  std::vector<int> frames;
  for (int frame = first; frame <= last; ++frame) frames.push_back(frame);
  return frames;
}

/// Told before the first frame is mixed: what is missing, and what would lose its light groups.
void check_files(const std::vector<std::string>& inputs, const std::vector<std::string>& outputs) {
  const auto there = [](const std::string& file) { return fs::exists(file); };
  if (const auto gap = std::find_if_not(inputs.begin(), inputs.end(), there); gap != inputs.end()) {
    const auto missing = std::count_if(gap, inputs.end(), std::not_fn(there));
    throw Error(*gap, "no such file" + (missing > 1 ? fmt::format(", nor {} more of the frames", missing - 1)
                                                    : std::string()));
  }
  std::set<fs::path> read;
  for (const std::string& input : inputs) read.insert(fs::weakly_canonical(input));
  for (const std::string& output : outputs)
    if (output != "-" && read.contains(fs::weakly_canonical(output)))
      throw UsageError("option '--output'",
                       "'" + output + "' is a picture that is read; its light groups would be lost");
}

class PictureMixer {
 public:
  PictureMixer(const PictureMix& job, const MixOptions& settings, const Preset& preset,
               const ToneOptions& tone, const Progress& progress)
      : job_(job), settings_(settings), preset_(preset), tone_(tone), progress_(progress) {}

  void mix(const std::string& input, const std::string& output) {
    const LayeredImage layered = read_layered(input, job_.groups_from);
    // What is to be said is said of the first frame.
    const bool first = out_.files.empty();
    if (!first) compare(layered, input);
    const MixSpec mix = weights(layered, input, first);
    Image mixed = mix_layers(layered, mix);
    if (first) {
      warn(layered, input);
      out_.width = mixed.width, out_.height = mixed.height;
      out_.groups = layered.groups, out_.mix = mix;
    }
    const bool toned = lower(fs::path(output).extension().string()) == ".png";
    if (!job_.colorspace.empty()) to_rec709(mixed);
    if (job_.colorspace == "acescg") to_acescg(mixed);
    toned ? write_png(output, tone(shown(layered, mixed))) : write_linear(output, with_mixed(layered, mixed));
    out_.files.push_back(output);
  }
  MixedPictures take() { return std::move(out_); }

 private:
  static LayeredImage read_layered(const std::string& input, const std::string& expression) {
    try {
      return find_layers(read_exr_parts(input), input, expression);
    } catch (const NotMyFormat&) {
      throw Error(input, "is neither a package nor an OpenEXR picture");
    }
  }
  MixSpec weights(const LayeredImage& layered, const std::string& input, bool first) const {
    if (first) return settings_.make(preset_, layered.groups, progress_);
    try {
      return settings_.make(preset_, layered.groups, {});
    } catch (const UsageError& e) {  // the settings fit the first frame
      throw Error(input, e.what());
    }
  }
  /// Says once where frames are not alike.
  void compare(const LayeredImage& layered, const std::string& input) {
    const auto names = [](const std::vector<GroupInfo>& groups) {
      std::vector<std::string> list;
      for (const GroupInfo& group : groups) list.push_back(group.name);
      return join(list, ", ");
    };
    const Image& image = layered.picture.image;
    if (const std::string now = names(layered.groups), then = names(out_.groups);
        !told_groups_ && now != then) {
      progress_.warn(fmt::format("{}: has the groups {}; the first frame has {}", input, now, then));
      told_groups_ = true;
    }
    if (!told_size_ && (image.width != out_.width || image.height != out_.height)) {
      progress_.warn(fmt::format("{}: is {} x {}, the first frame {} x {}", input, image.width, image.height,
                                 out_.width, out_.height));
      told_size_ = true;
    }
  }
  void warn(const LayeredImage& layered, const std::string& input) const {
    for (const std::string& name : layered.picture.left_out)
      progress_.warn(input + ": '" + name + "' is left out: only flat, full channels are kept");
    if (const Rest rest = measure_rest(layered); rest.negative > 0)
      progress_.warn(
          fmt::format("{}: the groups add up to more than the whole picture in {:.3g} % of the pixels; "
                      "'{}' is negative there",
                      input, 100 * rest.negative, layered.groups.back().name));
  }
  Image8 tone(const Image& picture) {
    if (!exposure_) exposure_ = tone_.exposure_choice().resolve(meter_picture(picture));
    return tone_map(picture, *exposure_, tone_.mapper());
  }
  static void write_linear(const std::string& output, const ExrParts& picture) {
    if (output != "-") return write_exr_parts(output, picture);
    const Beside file(fs::temp_directory_path() / "sconce-mix.exr");
    write_exr_parts(file.path(), picture);
    write_stdout(read_file(file.path()));
  }

  const PictureMix& job_;
  const MixOptions& settings_;
  const Preset& preset_;
  const ToneOptions& tone_;
  const Progress& progress_;
  std::optional<Exposure> exposure_;
  bool told_groups_ = false, told_size_ = false;
  MixedPictures out_;
};

}  // namespace

MixedPictures mix_pictures(const PictureMix& job, const MixOptions& settings, const Preset& preset,
                           const ToneOptions& tone, const Progress& progress) {
  if (settings.raw) throw UsageError("option '--raw'", job.input + " is a picture", "a package");
  PictureMixer mixer(job, settings, preset, tone, progress);
  std::vector<std::string> inputs{job.input}, outputs{job.output};
  if (!job.frames.empty()) {
    inputs.clear(), outputs.clear();
    for (const int frame : parse_frames(job.frames)) {
      inputs.push_back(frame_file(job.input, frame, "the picture"));
      outputs.push_back(frame_file(job.output, frame, "option '--output'"));
    }
  }
  check_files(inputs, outputs);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    progress.check();
    if (inputs.size() > 1) progress.at("mix", i, inputs.size());
    mixer.mix(inputs[i], outputs[i]);
  }
  return mixer.take();
}

}  // namespace sconce::app
