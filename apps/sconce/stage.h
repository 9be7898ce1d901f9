// SPDX-License-Identifier: Apache-2.0
// A package on the device that draws it.
#pragma once

#include <memory>

#include "core/progress.h"
#include "gpu/context.h"
#include "mix/mix.h"
#include "picture/render.h"
#include "scene/lens.h"
#include "tone/exposure.h"

namespace sconce::app {

class Stage {
 public:
  virtual ~Stage() = default;
  virtual std::string device() const = 0;  ///< "cpu", "software", or OpenGL's name of what draws
  virtual const Scene& scene() const = 0;
  virtual const View* view() const { return nullptr; }  ///< of rays; null where OpenGL draws
  /// One at eye height, for a scene without cameras.
  virtual Camera eye_height_camera(const Progress& progress) const = 0;
  /// Draws; what is seen is then told by the functions below.
  /// @param pages  mix_pages() of the same mix; OpenGL mixes by itself
  virtual void draw(const Camera& camera, const MixSpec& mix, const std::vector<Image>& pages,
                    const PictureParams& params, const Progress& progress) = 0;
  virtual Image linear() const = 0;    ///< cd/m2, before exposure @pre not "software"
  virtual Image coverage() const = 0;  ///< share of each pixel that shows an emitter or the sky
  virtual Image8 toned(const Exposure& exposure, const ToneMapper& mapper) const = 0;
};

/// OpenGL's context for a device's name; null for cpu and software, and for auto where there is no graphics
/// device: OpenGL in software is slower than rays. @throws Error when gl is asked for and there is no OpenGL
std::unique_ptr<gpu::Context> open_context(const std::string& device);

/// @param package  must outlive it
/// @param device   cpu, gl, software (picture/fixed_function.h), or auto: OpenGL where there is a graphics
/// device that draws all that is wanted
/// @param tier     of shader/composer.h, for OpenGL; "auto" = the best that the device has
/// @param reflections  are wanted: OpenGL has none, and says so where something mirrors
/// @throws Error when gl is asked for and there is no OpenGL
std::unique_ptr<Stage> make_stage(const Package& package, const std::string& device,
                                  const std::string& tier = "auto", bool reflections = false);

/// What OpenGL says where it leaves them out.
inline constexpr const char* kNoReflections =
    "OpenGL draws no reflections but of light fields: --device cpu does, --no-reflections is silent";
inline constexpr const char* kNoPanes =
    "OpenGL draws glass and blended surfaces as a screen of pixels, without their colour: --device cpu does";

}  // namespace sconce::app
