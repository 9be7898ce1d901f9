// SPDX-License-Identifier: Apache-2.0
// Global illumination for an OGRE program whose materials go through the shader generator (RTSS): all that
// stands between the two (docs/foreign-renderers.md). The program's materials and lights are its own.
#pragma once

#include <Ogre.h>

#include <map>

#include "detect/ambient_map.h"

class OgreRadiosity {
 public:
  /// Takes the scene's entities in: every corner of a face gets a vertex of its own, with its place in the
  /// ambient map as texture coordinate 1; every material a texture unit that adds the light.
  /// @param scheme  of the shader generator that the program draws by; its render state is taken over
  /// @throws sconce::Error: an entity that cannot be taken; the renderer's faults
  OgreRadiosity(Ogre::SceneManager& scene, const std::string& scheme);

  /// Reads the direct light and brings the ambient map up to date. Materials whose colours the program has
  /// changed are looked at again. @throws sconce::Error: they cannot be, and stay as they were found
  sconce::FrameReport update();
  /// Whether the materials add it.
  void show(bool on);
  const sconce::Detection& detection() const { return map_.detection(); }

 private:
  /// What is kept of one of the program's materials.
  struct Paint {
    sconce::Id<sconce::Material> id;
    Ogre::MaterialPtr bare;  ///< a copy of the program's material, for drawing faces
  };
  using Paints = std::map<Ogre::MaterialPtr, Paint>;
  /// A sub-entity, as it is drawn now: three vertices per face.
  struct Part {
    Ogre::SubEntity* entity;
    const Paints::value_type* paint;
    Ogre::HardwareVertexBufferSharedPtr coordinates, places;  ///< in the ambient map, in the drawing
  };

  void follow_materials();
  sconce::Scene collect();
  void take(Ogre::Entity& entity, sconce::Scene& out);
  sconce::Drawing draw(const sconce::DrawRequest& request);
  void set_target(unsigned width, unsigned height);

  Ogre::SceneManager& scene_;
  std::vector<Part> parts_;  ///< per instance of the map's scene
  Paints paints_;
  Ogre::MaterialPtr white_;
  sconce::AmbientMap map_;
  Ogre::Camera* eye_;
  Ogre::Light* probe_;
  Ogre::TexturePtr target_, light_;
};
