// SPDX-License-Identifier: Apache-2.0
// Rays of a lamp, from a ray file or from the virtual bench, for the verbs that take either.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "app.h"
#include "photometry/rays.h"

namespace sconce::app {

class LampRays {
 public:
  /// @param file  rays, or a scene (glTF, OBJ, L3D) whose lamps are traced out of it
  /// @param count  of rays that a scene's lamps send
  LampRays(const std::string& file, double count, int seed, const Progress& progress);
  ~LampRays();

  /// Calls f with blocks of rays, always in the same order; flux as the file has it, lm for a scene.
  /// @throws Error, NotMyFormat: neither
  void each(const std::function<void(std::span<const SourceRay>)>& f) const;
  /// Traces a scene once and holds its rays, 40 bytes each, where each() would trace it anew.
  void keep();
  bool traced() const { return model_ != nullptr; }
  /// Are fluxes lumens, and not watts? Known once each() has run.
  bool luminous() const { return luminous_; }

 private:
  struct Model;

  std::string file_;
  std::unique_ptr<const Model> model_;  ///< of a scene
  mutable bool luminous_ = true;
  mutable Progress once_;  ///< says what is odd about a file the first time only
  std::vector<SourceRay> kept_;
};

/// --rays and --seed of a scene's rays.
void add_bench(Options& options, double& count, int& seed);

}  // namespace sconce::app
