// SPDX-License-Identifier: Apache-2.0
// The mix that windows and scripts share, as texts, and its JSON. No sockets.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "mix/preset.h"
#include "package/package.h"

namespace sconce::web {

class SharedMix {
 public:
  /// @throws UsageError where the preset does not fit the groups
  explicit SharedMix(std::vector<GroupInfo> groups, const Preset& start = {});

  /// {"settings": {GROUP: SETTING}, "exposure", "ev100", "tone", "from", "weights": {GROUP: [r, g, b]}}
  std::string json() const;
  /// The same keys but weights; what is left out stays, unknown keys are errors. `exposure` and `ev100`
  /// exclude each other, the newer one wins. Nothing changes where anything is wrong.
  /// @throws UsageError in one line for the sender
  void change(std::string_view json);

 private:
  void check() const;
  std::vector<std::string> assignments() const;

  std::vector<GroupInfo> groups_;
  std::vector<std::string> settings_;  ///< per group
  std::string exposure_ = "auto", ev100_, tone_ = "agx";
  std::string from_;  ///< who changed it last, by its own name
};

}  // namespace sconce::web
