// SPDX-License-Identifier: Apache-2.0
#include "image/frames.h"

#include <fmt/format.h>

#include <charconv>

#include "core/error.h"
#include "core/files.h"
#include "core/program.h"
#include "core/text.h"

namespace fs = std::filesystem;

namespace sconce {

namespace {

constexpr const char* kNumbered = "%06d.png";

/// Runs ffmpeg. @return what it complained of, or nothing @throws Error: cannot be started
std::string run_ffmpeg(const fs::path& scratch, std::vector<std::string> words, const Progress& progress) {
  words.insert(words.begin(), "ffmpeg");
  const fs::path told = scratch / "told.txt", wrong = scratch / "wrong.txt";
  const int code = run_program(words, told, wrong, progress);
  if (code == 0) return {};
  const std::string text = read_file(wrong);
  return text.empty() ? fmt::format("exit code {}", code) : trim(text.substr(0, text.find('\n')));
}

}  // namespace

std::string frame_file(const std::string& pattern, int frame, const std::string& what) {
  for (std::size_t at = pattern.find('%'); at != std::string::npos; at = pattern.find('%', at + 1)) {
    const std::size_t end = pattern.find_first_not_of("0123456789", at + 1);
    if (end == std::string::npos || pattern[end] != 'd') continue;
    int width = 0;
    std::from_chars(pattern.data() + at + 1, pattern.data() + end, width);
    return pattern.substr(0, at) + fmt::format("{:0{}}", frame, std::min(width, 20)) +
           pattern.substr(end + 1);
  }
  throw UsageError(what, "'" + pattern + "' has no place for the frame's number", "a name with %04d");
}

Frames::Frames(std::string output, double per_second, std::string what)
    : output_(std::move(output)), what_(std::move(what)), per_second_(per_second) {
  if (lower(fs::path(output_).extension().string()) != ".mp4") {
    frame_file(output_, 1, what_);
    return;
  }
  scratch_ = std::make_unique<ScratchFolder>();
  try {
    run_ffmpeg(scratch_->path(), {"-version"}, {});
  } catch (const Error&) {
    throw Error(output_, "a film is made by the program ffmpeg, which is not installed",
                fs::path(output_).replace_extension(".%04d.png").string());
  }
}

fs::path Frames::next() {
  const int number = static_cast<int>(files_.size()) + 1;
  files_.push_back(film() ? (scratch_->path() / frame_file(kNumbered, number, what_)).string()
                          : frame_file(output_, number, what_));
  return files_.back();
}

std::vector<std::string> Frames::finish(const Progress& progress) {
  if (!film()) return files_;
  Beside film(output_);
  const std::string problem =
      run_ffmpeg(scratch_->path(),
                 {"-nostdin",
                  "-y",
                  "-v",
                  "error",
                  "-framerate",
                  fmt::format("{:g}", per_second_),
                  "-i",
                  (scratch_->path() / kNumbered).string(),
                  "-vf",
                  "crop=trunc(iw/2)*2:trunc(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv,format=yuv420p",
                  "-colorspace",
                  "bt709",
                  "-color_primaries",
                  "bt709",
                  "-color_trc",
                  "bt709",
                  "-c:v",
                  "libx264",
                  "-crf",
                  "16",
                  "-movflags",
                  "+faststart",
                  "-f",
                  "mp4",
                  film.path().string()},
                 progress);
  if (!problem.empty()) throw Error(output_, "ffmpeg failed: " + problem);
  film.commit();
  return {output_};
}

}  // namespace sconce
