// SPDX-License-Identifier: Apache-2.0
// `sconce mix` of other renderers' pictures: one, or the frames of a sequence.
#pragma once

#include <string>
#include <vector>

#include "mix_options.h"
#include "tone_options.h"

namespace sconce::app {

struct PictureMix {
  std::string input, output;  ///< with %d or %04d where there are frames; output "-": standard output
  std::string frames;         ///< "A-B" or "N"; empty = one picture
  std::string groups_from;    ///< see find_groups()
  std::string colorspace;     ///< of OpenEXR: rec709, acescg; empty = the file's own
};

struct MixedPictures {
  std::vector<std::string> files;
  int width = 0, height = 0;      ///< of the data window
  std::vector<GroupInfo> groups;  ///< of the first frame
  MixSpec mix;
};

/// Writes linear OpenEXR, or PNG by exposure and tone curve, both metered on the first frame.
/// @param settings, preset  of the groups
/// @throws UsageError, Error; frames before the one that fails stay written
MixedPictures mix_pictures(const PictureMix& job, const MixOptions& settings, const Preset& preset,
                           const ToneOptions& tone, const Progress& progress);

}  // namespace sconce::app
