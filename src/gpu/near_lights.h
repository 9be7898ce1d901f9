// SPDX-License-Identifier: Apache-2.0
// Lamps that are light fields, with shadow maps: on an operator's points, and on what a picture shows
// (deferred shading). Every term is a textured spot at its filter's centre (Granier, Goesele, Heidrich,
// Seidel 2003, eq. 14). Colours are three
// passes with the same maps.
#pragma once

#include <map>
#include <memory>
#include <optional>

#include "gpu/buffer.h"
#include "gpu/geometry.h"
#include "gpu/seen_surfaces.h"
#include "light/near_field.h"

namespace sconce::gpu {

struct NearLightParams {
  int shadow_side = 256;  ///< of a term's map, texels; 0 = no shadows
  /// X of the paper: terms whose maps are there at once and that one pass sums. All: maps are drawn once and
  /// kept. Fewer: they are drawn again for each pass, in their place.
  int terms_per_pass = 0;  ///< 0 = all
  bool srgbe = false;      ///< passes of a picture are summed in 8 bits with a signed shared exponent
  /// Glossy surfaces mirror light fields (picture/glint.h), those of the mix, too; a coat takes nothing from
  /// the light below it, as it mirrors nothing else.
  bool glints = false;
};

class NearLights : public AddedLight {
 public:
  /// @param chosen  number and weight of each; those that are no light fields are left out
  /// @throws Error for more terms than the device has layers
  NearLights(const Context& context, const Geometry& geometry, const Bounds& bounds, const Lamps& lamps,
             std::span<const std::pair<std::size_t, Rgb>> chosen, const NearLightParams& params);
  ~NearLights() override;

  bool empty() const { return lamps_.empty(); }
  /// Moves the i-th of the light fields; its maps are drawn anew.
  void move(std::size_t i, const Vec3& position, const Mat3& frame);
  /// Weights of the light groups, for what is mirrored of light fields that were not chosen: black until
  /// then.
  void set_mix(const std::vector<Rgb>& weights);

  /// Adds albedo x illuminance of each slot's points, their mean, lm/m2.
  void light_cloud(const Buffer& points, uint32_t slots, uint32_t points_per_slot, const Buffer& exitance);
  void add(const SeenSurfaces& seen, const Texture& picture) override;

  /// Draws of the whole scene into maps, and sums over points or pixels, since it was made.
  struct Passes {
    int shadows = 0, lighting = 0;
  };
  const Passes& passes() const { return passes_; }

 private:
  struct Field;
  struct Lamp {
    const Field* field = nullptr;
    Vec3 position{0};
    Mat3 frame{1.0f};
    Rgb scale;
    Id<LightGroup> group;
    Rgb color, shine;  ///< what it lights with, and what is mirrored of it
    std::optional<Texture> depths;
    bool drawn = false;  ///< all maps are there
  };
  void use(const Program& program, const Lamp& lamp, std::size_t channel) const;
  /// Draws what is missing of the maps, and calls sum() for each pass with the uniforms set.
  template <class F>
  void each_pass(Lamp& lamp, const Program& program, const F& sum);
  void draw_maps(const Lamp& lamp, int first, int count);

  const Context* context_;
  const Geometry* geometry_;
  NearLightParams params_;
  float end_;  ///< of shadow maps, m
  std::map<const NearField*, std::unique_ptr<Field>> fields_;
  std::vector<Lamp> lamps_;  ///< first those that were chosen
  std::size_t chosen_ = 0;
  struct Programs;
  std::unique_ptr<Programs> programs_;  ///< null where there are no such lamps
  Passes passes_;
};

}  // namespace sconce::gpu
