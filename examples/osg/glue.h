// SPDX-License-Identifier: Apache-2.0
// Global illumination for an OpenSceneGraph program that lights by GLSL shaders of its own: all that stands
// between the two (docs/foreign-renderers.md).
#pragma once

#include <map>
#include <osg/Geometry>
#include <osg/Texture2D>
#include <osgViewer/Viewer>

#include "detect/ambient_map.h"

class OsgRadiosity {
 public:
  /// Lets the program's own uniforms make the light that is asked for: its lights, probe, card and eye.
  using SetLights = std::function<void(const sconce::DrawRequest&)>;

  /// Rewrites the vertex shaders below `scene` and gives every corner of a face a vertex of its own, its
  /// place in the ambient map as texture coordinate 1. The viewer shows `root`, single-threaded.
  /// @throws sconce::Error: a shader or a geometry that cannot be taken; the renderer's faults
  OsgRadiosity(osgViewer::Viewer& viewer, osg::Group& root, osg::Node& scene, SetLights set_lights);

  /// Reads the direct light and brings the ambient map up to date.
  sconce::FrameReport update();
  /// Looks at the materials again, after the program changed them. @throws sconce::Error: the old ones stay
  void detect() { map_->detect(); }
  const sconce::Detection& detection() const { return map_->detection(); }
  osg::Texture2D* ambient_map() { return ambient_map_; }

 private:
  /// One geometry of the graph, as it is drawn now.
  struct Part {
    osg::ref_ptr<osg::Vec2Array> places, lightmap;
  };
  struct Target {
    osg::ref_ptr<osg::Camera> camera;
    osg::ref_ptr<osg::Image> image;
    osg::ref_ptr<osg::Drawable> drawn;  ///< tells when all is
  };
  class Collector;

  sconce::Drawing draw(const sconce::DrawRequest& request);
  const Target& target(int width, int height);

  osgViewer::Viewer& viewer_;
  osg::Group& root_;
  osg::Node& scene_node_;
  SetLights set_lights_;
  std::vector<Part> parts_;  ///< per instance of the scene
  std::map<std::pair<int, int>, Target> targets_;
  sconce::Scene scene_;  ///< while it is collected
  std::unique_ptr<sconce::AmbientMap> map_;
  osg::ref_ptr<osg::Texture2D> ambient_map_ = new osg::Texture2D;
};
