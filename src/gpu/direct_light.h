// SPDX-License-Identifier: Apache-2.0
// Light of moved lamps, with shadow maps: on an operator's points, and on what a picture shows (deferred
// shading).
#pragma once

#include <memory>

#include "gpu/buffer.h"
#include "gpu/lamp_program.h"
#include "gpu/seen_surfaces.h"
#include "gpu/shadow_map.h"
#include "transfer/operator.h"

namespace sconce::gpu {

/// What a lamp's shader answered that is no number; its neighbours paint it over.
struct Mishap {
  uint64_t count = 0;
  uint32_t first = 0;  ///< the lowest number of a point, or of a pixel: y * width + x
};

class DirectLight : public AddedLight {
 public:
  /// Compiles, and draws the shadow maps.
  /// @throws Error for shaders that do not compile and shadow maps too large, UsageError for their uniforms
  DirectLight(const Context& context, const Geometry& geometry, const Bounds& bounds,
              std::vector<LampShader> lamps);
  ~DirectLight() override;

  /// b_d: albedo x illuminance of each slot's points, their mean, lm/m2. Twin of light_cloud().
  void light_cloud(const Buffer& points, uint32_t slots, uint32_t points_per_slot, const Buffer& exitance);
  void add(const SeenSurfaces& seen, const Texture& picture) override;

  struct Report {
    std::string file;
    Mishap cloud, pixels;
  };
  /// Of lamps with mishaps; pixels over all passes.
  std::vector<Report> mishaps() const;

 private:
  struct Lamp;
  void start_count() const;
  void count(Mishap* mishap) const;

  const Context* context_;
  std::map<std::string, std::unique_ptr<LampProgram>> programs_;  ///< by text
  std::vector<std::unique_ptr<Lamp>> lamps_;
  Buffer mishaps_;
};

}  // namespace sconce::gpu
