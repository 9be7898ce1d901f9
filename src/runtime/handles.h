// SPDX-License-Identifier: Apache-2.0
// What stands behind the C interface's handles, and how exceptions become messages.
#pragma once

#include <exception>
#include <memory>

#include "core/c_message.h"
#include "mix/mixer.h"
#include "package/points.h"
#include "runtime/sconce.h"

struct sconce_package {
  sconce::Package package;
  std::unique_ptr<sconce::Mixer> mixer{};             ///< from the first mix on
  const std::vector<sconce::Image>* mixed = nullptr;  ///< of the mixer
  std::optional<sconce::ProbeGrid> probes{};          ///< from when they are first asked for
};

namespace sconce {

/// Runs `work`; where it throws, the line goes to a C caller's buffer. @return 0, or 1
template <class Work>
int guarded(char* message, std::size_t size, const Work& work) {
  try {
    work();
    return 0;
  } catch (const std::exception& e) {
    copy_message(e.what(), message, size);
    return 1;
  }
}

}  // namespace sconce
