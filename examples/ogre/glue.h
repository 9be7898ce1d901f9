// SPDX-License-Identifier: Apache-2.0
// Global illumination for an OGRE program whose materials go through the shader generator (RTSS): all that
// stands between the two (docs/foreign-renderers.md). The program's materials and lights are its own.
#pragma once

#include <map>
#include <set>

#include "detect/ambient_map.h"
#include "generated.h"

class OgreRadiosity {
 public:
  /// Takes the scene's entities in: every corner of a face gets a vertex of its own, with its place in the
  /// ambient map as texture coordinate 1; every material a texture unit that adds the light.
  /// @param scheme  of the shader generator that the program draws by; its render state is taken over
  /// @throws sconce::Error: an entity that cannot be taken; the renderer's faults
  OgreRadiosity(Ogre::SceneManager& scene, const std::string& scheme);

  /// Reads the direct light and brings the ambient map up to date.
  sconce::FrameReport update();
  /// Whether the materials add it.
  void show(bool on);
  const sconce::Detection& detection() const { return map_.detection(); }

 private:
  /// A sub-entity, as it is drawn now: three vertices per face.
  struct Part {
    Ogre::SubEntity* entity;
    Ogre::MaterialPtr own, bare;  ///< the program's, and a copy for drawing faces
    std::vector<sconce::Vec2> places;
    Ogre::HardwareVertexBufferSharedPtr place_buffer, map_buffer;
  };

  sconce::Scene collect();
  void take(Ogre::Entity& entity, sconce::Scene& out);
  sconce::Drawing draw(const sconce::DrawRequest& request);
  const Ogre::TexturePtr& target(int width, int height);

  Ogre::SceneManager& scene_;
  GeneratedTechniques listener_;
  std::vector<Part> parts_;  ///< per instance of the map's scene
  std::map<std::string, sconce::Id<sconce::Material>> materials_;
  std::set<Ogre::Mesh*> meshes_;
  Ogre::MaterialPtr white_;
  sconce::AmbientMap map_;
  Ogre::Camera* eye_;
  Ogre::Camera* all_;  ///< sees all, so that nothing is culled
  Ogre::Light* probe_;
  std::map<std::pair<int, int>, Ogre::TexturePtr> targets_;
  Ogre::TexturePtr light_;
};
