// SPDX-License-Identifier: Apache-2.0
// Pictures in a row, as numbered files or as a film.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/progress.h"
#include "core/scratch_folder.h"

namespace sconce {

/// %d or %04d becomes the frame's number. @throws UsageError where there is none
std::string frame_file(const std::string& pattern, int frame, const std::string& what);

/// NAME.%04d.png or .exr: files one after the other. NAME.mp4: PNG files among the temporary ones, then H.264
/// by the program ffmpeg, in Rec. 709 as films have it; an odd last row or column is cut off.
class Frames {
 public:
  static constexpr double kPerSecond = 25;

  /// @param per_second  of a film
  /// @param what        says in errors whose the output is
  /// @throws UsageError: no place for a number; Error: a film, and ffmpeg cannot be started
  Frames(std::string output, double per_second, std::string what);

  bool film() const { return scratch_ != nullptr; }
  /// Where the next picture is to be written, a PNG for a film.
  std::filesystem::path next();
  /// @return what was written: every file, or the film @throws Error: ffmpeg failed; Cancelled
  std::vector<std::string> finish(const Progress& progress = {});

 private:
  std::string output_, what_;
  double per_second_;
  std::unique_ptr<ScratchFolder> scratch_;  ///< of a film
  std::vector<std::string> files_;
};

}  // namespace sconce
