// SPDX-License-Identifier: Apache-2.0
// What `render` is told about its picture: camera, size, exposure, curve; text to values.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "app.h"
#include "scene/lens.h"
#include "tone_options.h"

namespace sconce::app {

struct PictureSize {
  int width = 0, height = 0;  ///< height 0: from the camera's aspect
};
/// `640x360`, or `640` for the width alone. @throws UsageError
PictureSize parse_size(const std::string& text);

/// `X,Y,Z` in metres. @throws UsageError naming `option`
Vec3 parse_point(const std::string& text, const std::string& option);

struct PictureOptions {
  std::string camera, eye, target, size, device = "auto", tier = "auto";
  ToneOptions tone;
  double fov = 0;
  int samples = 16;
  bool no_reflections = false;

  void declare(Options& options);
  /// Values that the command line left open come from the preset. @throws UsageError
  void apply(const Preset& preset);
  /// Everything that can be checked without the package. @throws UsageError
  void check() const;
  /// @param otherwise  gives one where none is asked for and the scene has none
  Camera find_camera(const Scene& scene, const std::function<Camera()>& otherwise) const;
  PictureParams params(const Camera& camera) const;
};

}  // namespace sconce::app
