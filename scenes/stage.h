// SPDX-License-Identifier: Apache-2.0
// A scene under construction: materials by name, objects by one call.
#pragma once

#include <map>
#include <string>

#include "scene/scene.h"
#include "shapes.h"

namespace sconce::demo {

class Stage {
 public:
  /// Matt material, sRGB colour as hex digits.
  void paint(const std::string& name, const char* srgb, bool double_sided = false);
  /// Textured material; one repetition covers `metres`.
  void texture(const std::string& name, const Image8& image, Vec2 metres, bool double_sided = false);

  void add(const std::string& name, const std::string& material, const MeshBuilder& shape,
           float lightmap_scale = 1);
  /// A one-sided emitter whose luminance is chosen so that it sends out `lumens`.
  /// @param albedo  of the lamp itself, seen when it is off
  /// @param kelvin  its colour: that of a black body against a white of 6504 K
  void add_light(const std::string& name, const MeshBuilder& shape, const char* group, float lumens,
                 double kelvin, float albedo = 0.75f);
  void camera(const std::string& name, Vec3 eye, Vec3 target, float horizontal_degrees);

  Scene scene;

 private:
  std::map<std::string, Id<Material>> materials_;
  std::map<std::string, Vec2> metres_;
};

}  // namespace sconce::demo
