// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fstream>

#include "core/files.h"
#include "photometry/rays.h"

namespace sconce {

/// Writes IES TM-25 (2013) ray by ray: place in millimetres, direction, flux. What read_rays() gave comes
/// back; its light goes along +z of the file again.
class RayWriter {
 public:
  /// @param luminous  are fluxes lumens, else watts
  /// @param colored  tristimulus values, too. @pre luminous then
  RayWriter(const std::filesystem::path& path, bool luminous, bool colored = false);

  void add(std::span<const SourceRay> rays);
  /// Number and flux go into the header; the file takes its name. @throws Error
  void finish();

 private:
  std::filesystem::path path_;
  Beside beside_;
  std::ofstream out_;
  bool luminous_, colored_;
  uint64_t rays_ = 0;
  double flux_ = 0;
};

}  // namespace sconce
