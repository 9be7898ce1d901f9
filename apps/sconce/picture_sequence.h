// SPDX-License-Identifier: Apache-2.0
// `render --from A --to B`: two presets cross-faded, as numbered pictures.
#pragma once

#include <string>
#include <vector>

#include "app.h"
#include "image/image.h"
#include "mix/preset.h"
#include "tone/exposure.h"

namespace sconce::app {

struct SequenceOptions {
  std::string from, to;
  int frames = 0;

  void declare(Options& options);
  bool given() const { return !from.empty() || !to.empty() || frames != 0; }
  /// @param output  has a place for the frame's number
  /// @throws UsageError
  void check(const std::string& output) const;
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

/// Writes frame 1 to `frames`, from one end to the other. @return their files
std::vector<std::string> write_sequence(
    const SequenceOptions& sequence, const SequenceEnd& from, const SequenceEnd& to,
    const std::string& output, const std::function<void(const std::string&, const SequenceEnd&)>& write,
    const Progress& progress);

}  // namespace sconce::app
