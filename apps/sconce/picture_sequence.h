// SPDX-License-Identifier: Apache-2.0
// `render --from A --to B`: two presets cross-faded; `render --turntable N`: the camera turns. Numbered
// pictures or a film.
#pragma once

#include <string>
#include <vector>

#include "app.h"
#include "image/frames.h"
#include "image/image.h"
#include "mix/preset.h"
#include "tone/exposure.h"

namespace sconce::app {

struct SequenceOptions {
  std::string from, to;
  int frames = 0, turntable = 0;
  double fps = 0;  ///< 0 = Frames::kPerSecond

  void declare(Options& options);
  bool given() const { return fades() || turntable != 0; }
  bool fades() const { return !from.empty() || !to.empty() || frames != 0; }
  /// @throws UsageError
  void check(const std::string& output) const;
  /// What they are written to. @throws as Frames
  Frames open(const std::string& output) const;
};

/// Of NAME or NAME.toml. @throws as read_preset()
Preset read_named_preset(const std::string& name);

/// One end of the fade: a linear picture and its exposure.
struct SequenceEnd {
  Image linear;
  Exposure exposure;
};
/// Light is faded, not codes: (1 - t) a + t b, as the mix of faded weights gives; exposure in stops.
SequenceEnd between(const SequenceEnd& a, const SequenceEnd& b, double t);

/// Writes all frames. @param draw  number 0 to count - 1 into a file @return what was written
std::vector<std::string> write_frames(Frames& frames, int count,
                                      const std::function<void(int frame, const std::string& file)>& draw,
                                      const Progress& progress);

}  // namespace sconce::app
