// SPDX-License-Identifier: Apache-2.0
// A small OpenSceneGraph program with shaders and lights of its own, that knows nothing of bounces; then the
// same with them. Run it with OUT, a prefix of files: pictures without and with, before and after its light
// model changed. It needs a display: xvfb-run osg_radiosity OUT.
#include <fmt/format.h>

#include <osg/Program>

#include "core/error.h"
#include "glue.h"
#include "room/report.h"

using namespace sconce;

namespace {

const char* kVertex = R"(#version 120
uniform mat4 osg_ViewMatrixInverse;
varying vec3 at, normal;
void main() {
  at = (osg_ViewMatrixInverse * (gl_ModelViewMatrix * gl_Vertex)).xyz;
  normal = mat3(osg_ViewMatrixInverse) * (gl_NormalMatrix * gl_Normal);
  gl_TexCoord[1] = gl_MultiTexCoord1;
  gl_Position = ftransform();
})";

const char* kFragment = R"(#version 120
varying vec3 at, normal;
uniform vec3 color, emission, lamp, lamp_strength, sun, sun_strength, eye;
uniform float falloff, shine, white_card, ambient_on;
uniform sampler2D ambient_map;
vec3 lit(vec3 to, vec3 strength, vec3 rho, vec3 n) {
  float mirrored = max(dot(reflect(-to, n), normalize(eye - at)), 0.0);
  return strength * (rho * max(dot(n, to), 0.0) + (1.0 - white_card) * shine * pow(mirrored, 30.0));
}
void main() {
  vec3 n = normalize(normal), rho = mix(color, vec3(1.0), white_card), to = lamp - at;
  float distance2 = dot(to, to);
  vec3 shown = lit(to / sqrt(distance2), lamp_strength / mix(1.0, 0.25 * distance2, falloff), rho, n) +
               lit(sun, sun_strength, rho, n) + emission * (1.0 - white_card);
  shown += rho * ambient_on * texture2D(ambient_map, gl_TexCoord[1].xy).rgb;
  gl_FragColor = vec4(shown, 1.0);
})";

osg::Vec3 vec(const room::Triple& t) {
  return {t[0], t[1], t[2]};
}

/// The program: its scene, lights and screen.
class Program {
 public:
  Program(int argc, char** argv) : file_(argv[1]) {
    shine_ = argc > 2 && std::string(argv[2]) == "--shiny" ? 0.3f : 0.0f;
    build();
    osg::ref_ptr<osg::GraphicsContext::Traits> traits = new osg::GraphicsContext::Traits;
    traits->width = room::kWidth, traits->height = room::kHeight;
    traits->pbuffer = true;
    traits->readDISPLAY();
    osg::ref_ptr<osg::GraphicsContext> context = osg::GraphicsContext::createGraphicsContext(traits);
    if (!context) throw Error({}, "there is no display", "xvfb-run osg_radiosity OUT");
    screen_->allocateImage(room::kWidth, room::kHeight, 1, GL_RGBA, GL_FLOAT);
    screen_->setInternalTextureFormat(GL_RGBA32F_ARB);
    osg::Camera* camera = viewer_.getCamera();
    camera->setGraphicsContext(context);
    camera->setViewport(0, 0, room::kWidth, room::kHeight);
    camera->setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
    camera->attach(osg::Camera::COLOR_BUFFER, screen_);
    camera->setClearColor(osg::Vec4(0, 0, 0, 1));
    camera->setProjectionMatrixAsPerspective(static_cast<double>(room::kFieldOfView),
                                             static_cast<double>(room::kWidth) / room::kHeight, 0.05, 50);
    camera->setViewMatrixAsLookAt(vec(room::kEye), vec(room::kTarget), osg::Vec3(0, 1, 0));
    viewer_.setThreadingModel(osgViewer::Viewer::SingleThreaded);
    viewer_.setSceneData(root_);
    viewer_.realize();
  }

  void run() {
    show_lamp();
    picture("without", false);
    OsgRadiosity radiosity(viewer_, *root_, *scene_, [this](const DrawRequest& request) { light(request); });
    scene_->getOrCreateStateSet()->setTextureAttributeAndModes(1, radiosity.ambient_map());
    room::print(radiosity.detection());
    room::print(radiosity.update());
    picture("with", true);
    picture("direct", false);
    // The program changes its light model while it runs. Nothing is made again.
    lamp_.falloff = 1;
    room::print(radiosity.update());
    picture("changed", true);
    picture("changed-direct", false);
    // And has its walls painted.
    scene_->getChild(room::kRepainted)->getStateSet()->getUniform("color")->set(vec(room::kNewColor));
    radiosity.detect();
    room::print(radiosity.update());
    picture("painted", true);
    picture("painted-direct", false);
  }

 private:
  void build() {
    osg::ref_ptr<osg::Program> program = new osg::Program;
    osg::ref_ptr<osg::Shader> vertex = new osg::Shader(osg::Shader::VERTEX, kVertex);
    vertex->setName("room.vert");
    program->addShader(vertex);
    program->addShader(new osg::Shader(osg::Shader::FRAGMENT, kFragment));
    osg::StateSet* state = scene_->getOrCreateStateSet();
    state->setAttributeAndModes(program);
    state->addUniform(new osg::Uniform("ambient_map", 1));
    for (const char* name : {"lamp", "lamp_strength", "sun", "sun_strength", "eye"})
      state->getOrCreateUniform(name, osg::Uniform::FLOAT_VEC3)->set(osg::Vec3(0, 1, 0));
    for (const char* name : {"falloff", "white_card", "ambient_on", "shine"})
      state->getOrCreateUniform(name, osg::Uniform::FLOAT)->set(0.0f);
    std::vector<osg::ref_ptr<osg::Geode>> paints;
    for (const room::Paint& paint : room::kPaints) {
      paints.emplace_back(new osg::Geode);
      osg::StateSet* own = paints.back()->getOrCreateStateSet();
      own->setName(paint.name);
      own->addUniform(new osg::Uniform("color", vec(paint.color)));
      own->addUniform(new osg::Uniform("emission", vec(paint.emission)));
      if (std::string(paint.name) == "lacquer") own->addUniform(new osg::Uniform("shine", shine_));
      scene_->addChild(paints.back());
    }
    for (const room::Wall& wall : room::walls())
      paints[wall.paint]->addDrawable(
          osg::createTexturedQuadGeometry(vec(wall.corner), vec(wall.a), vec(wall.b)));
    root_->addChild(scene_);
  }

  void set(const char* uniform, const osg::Vec3& v) { scene_->getStateSet()->getUniform(uniform)->set(v); }
  void set(const char* uniform, float v) { scene_->getStateSet()->getUniform(uniform)->set(v); }

  void show_lamp() {
    set("lamp", vec(lamp_.position)), set("lamp_strength", vec(lamp_.strength)),
        set("falloff", lamp_.falloff);
    set("sun_strength", osg::Vec3()), set("white_card", 0.0f), set("eye", vec(room::kEye));
  }

  /// What the glue asks for.
  void light(const DrawRequest& request) {
    show_lamp();
    set("ambient_on", 0.0f);
    if (request.lights == DrawRequest::Lights::all) return;
    set("lamp_strength", osg::Vec3());
    const Vec3& to = request.probe.to_light;
    const float strength = request.lights == DrawRequest::Lights::probe ? request.probe.intensity : 0.0f;
    set("sun", osg::Vec3(to.x, to.y, to.z)), set("sun_strength", osg::Vec3(strength, strength, strength));
    set("eye", osg::Vec3(request.eye.x, request.eye.y, request.eye.z));
    set("white_card", request.white_card ? 1.0f : 0.0f);
  }

  void picture(const std::string& name, bool ambient) {
    show_lamp();
    set("ambient_on", ambient ? 1.0f : 0.0f);
    viewer_.frame();
    room::write(file_ + "-" + name, reinterpret_cast<const float*>(screen_->data()), true);
  }

  std::string file_;
  room::Lamp lamp_;
  float shine_ = 0;
  osgViewer::Viewer viewer_;
  osg::ref_ptr<osg::Group> root_ = new osg::Group, scene_ = new osg::Group;
  osg::ref_ptr<osg::Image> screen_ = new osg::Image;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "osg_radiosity OUT [--shiny]\n");
    return 2;
  }
  try {
    Program(argc, argv).run();
  } catch (const std::exception& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 1;
  }
  return 0;
}
