// SPDX-License-Identifier: Apache-2.0
// Moved lamps and their indirect light, on the device that computes them.
#pragma once

#include <memory>

#include "gpu/lamp_shader.h"
#include "relight/relight.h"

namespace sconce::app {

/// What is moved. Package, view, operator and lamps must outlive the stage.
struct RelightJob {
  const Package& package;
  const View& view;
  const Operator& op;
  const MovedLamps& lamps;
  std::vector<gpu::LampShader> shaders;          ///< these need OpenGL
  std::shared_ptr<const FoldedBounces> bounces;  ///< of the operator; made where null and needed
  float cull = 0;                                ///< of Relighter: on the processor
  const Operator* lobes = nullptr;               ///< find_lobes(): on the processor
};

/// For OpenGL.
struct RelightDevice {
  std::string name = "auto";  ///< auto, cpu, gl
  int patches = 16;           ///< that a lamp with an area is drawn as
  int shadow_side = 1024;     ///< of a shadow map, texels; patches and terms of light fields: a quarter
  int terms_per_pass = 0;     ///< gpu::NearLightParams
  bool srgbe = false;
  bool reflections = false;  ///< wanted: auto is no OpenGL where something mirrors

  /// @throws UsageError
  void check() const;
};

class RelightStage {
 public:
  virtual ~RelightStage() = default;
  virtual std::string device() const = 0;  ///< "cpu", or OpenGL's name of what computes
  virtual Relighter::Seconds seconds() const = 0;
  /// Its bound is a share of indirect light, both as the root of the sum of squares over receivers.
  virtual Culling::Report culled() const { return {}; }
  /// Relighter::add_to
  virtual void add_to(std::vector<Image>& pages) const = 0;
  /// The picture, linear, cd/m2.
  /// @param pages       of the whole lightmap
  /// @param components  of its layers, for normal maps; or none
  virtual Image draw(const Camera& camera, const MixSpec& mix, const std::vector<Image>& pages,
                     const std::vector<Image>& components, const PictureParams& params,
                     const Progress& progress) = 0;
};

/// Lights the cloud and sends its light to all receivers. `auto` is OpenGL where there is a graphics device
/// that knows all lamps and nothing is culled, and for shaders in any case.
/// Warns of lamps that stand inside something.
/// @throws Error when OpenGL is wanted and there is none, or it does not know a lamp; UsageError
std::unique_ptr<RelightStage> make_relight_stage(const RelightJob& job, const RelightDevice& device,
                                                 const Progress& progress);

}  // namespace sconce::app
