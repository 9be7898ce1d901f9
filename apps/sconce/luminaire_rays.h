// SPDX-License-Identifier: Apache-2.0
// Rays of a lamp, from a ray file or from the virtual bench, for the verbs that take either.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "photometry/rays.h"

namespace sconce::app {

class LampRays {
 public:
  /// @param file  rays, or a scene (glTF, OBJ) whose lamps are traced out of it
  /// @param count  of rays that a scene's lamps send
  /// @throws Error, NotMyFormat: neither
  LampRays(const std::string& file, uint64_t count, uint32_t seed, const Progress& progress);

  /// Calls f with blocks of rays, always in the same order; flux as the file has it, lm for a scene.
  void each(const std::function<void(std::span<const SourceRay>)>& f) const;
  bool traced() const { return traced_; }
  /// Are fluxes lumens, and not watts? Known once each() has run.
  bool luminous() const { return luminous_; }

 private:
  std::string file_;
  bool traced_ = false;
  mutable bool luminous_ = true;
  mutable Progress once_;        ///< says what is odd about a file the first time only
  std::vector<SourceRay> rays_;  ///< of a scene
};

}  // namespace sconce::app
