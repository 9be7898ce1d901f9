// SPDX-License-Identifier: Apache-2.0
// A small OGRE program with materials and lights of its own, that knows nothing of bounces; then the same
// with them. Run it with OUT, a prefix of files: pictures without and with, before and after its lamp
// changed. With SHADERS, a folder, its generated shaders are kept there. It needs a display.
#include <OgreShaderGenerator.h>
#include <OgreShaderRenderState.h>

#include "core/error.h"
#include "glue.h"
#include "room/report.h"

using namespace sconce;
namespace shader = Ogre::RTShader;

namespace {

/// The shader generator's light ends at 1, so the program's 1 is a quarter of the room's.
constexpr float kUnit = 0.25f;

Ogre::Vector3 vec(const room::Triple& t) {
  return {t[0], t[1], t[2]};
}
Ogre::ColourValue colour(const room::Triple& t, float times = 1) {
  return Ogre::ColourValue(t[0] * times, t[1] * times, t[2] * times);
}

/// While it lives, the shader generator makes the techniques of a scheme that materials lack when first
/// drawn.
class GeneratedTechniques : public Ogre::MaterialManager::Listener {
 public:
  explicit GeneratedTechniques(Ogre::String scheme) : scheme_(std::move(scheme)) {
    Ogre::MaterialManager::getSingleton().addListener(this, scheme_);
  }
  ~GeneratedTechniques() override { Ogre::MaterialManager::getSingleton().removeListener(this, scheme_); }
  GeneratedTechniques(const GeneratedTechniques&) = delete;
  GeneratedTechniques& operator=(const GeneratedTechniques&) = delete;

  Ogre::Technique* handleSchemeNotFound(unsigned short, const Ogre::String& scheme, Ogre::Material* material,
                                        unsigned short, const Ogre::Renderable*) override {
    auto& generator = shader::ShaderGenerator::getSingleton();
    if (!generator.createShaderBasedTechnique(*material, Ogre::MaterialManager::DEFAULT_SCHEME_NAME, scheme))
      return nullptr;
    generator.validateMaterial(scheme, material->getName(), material->getGroup());
    for (Ogre::Technique* technique : material->getTechniques())
      if (technique->getSchemeName() == scheme) return technique;
    return nullptr;
  }

 private:
  Ogre::String scheme_;
};

class Program {
 public:
  /// @param shaders  a folder for what the shader generator writes, or ""
  Program(const std::string& file, bool shiny, const std::string& shaders)
      : file_(file), silent_(log_.createLog("", true, false, true)), root_("", "", "") {
    root_.loadPlugin(OGRE_PLUGINS "/RenderSystem_GL3Plus");
    root_.setRenderSystem(root_.getAvailableRenderers().front());
    root_.initialise(false);
    root_.createRenderWindow("room", room::kWidth, room::kHeight, false);
    auto& resources = Ogre::ResourceGroupManager::getSingleton();
    resources.addResourceLocation(OGRE_SHADERS "/GLSL", "FileSystem");
    resources.addResourceLocation(OGRE_SHADERS "/../ShadowVolume", "FileSystem", Ogre::RGN_INTERNAL);
    shader::ShaderGenerator::initialize();
    auto& generator = shader::ShaderGenerator::getSingleton();
    generator.setShaderCachePath(shaders);
    resources.initialiseAllResourceGroups();
    scene_ = root_.createSceneManager();
    generator.addSceneManager(scene_);
    generator.createOrRetrieveRenderState(shader::ShaderGenerator::DEFAULT_SCHEME_NAME)
        .first->addTemplateSubRenderState(generator.createSubRenderState("SGX_PerPixelLighting"));
    generated_ = std::make_unique<GeneratedTechniques>(shader::ShaderGenerator::DEFAULT_SCHEME_NAME);
    build(shiny);
  }
  ~Program() {
    generated_.reset();
    shader::ShaderGenerator::destroy();
  }

  void run() {
    picture("without");
    OgreRadiosity radiosity(*scene_, shader::ShaderGenerator::DEFAULT_SCHEME_NAME);
    room::print(radiosity.detection());
    picture("direct");
    room::print(radiosity.update());
    picture("with");
    // The program changes its lamp while it runs. Nothing is made again.
    lamp_->setAttenuation(100, 0, 0, 0.25f);
    radiosity.show(false);
    picture("changed-direct");
    room::print(radiosity.update());
    picture("changed");
    // And has its walls painted.
    Ogre::MaterialManager::getSingleton()
        .getByName(room::kPaints[room::kRepainted].name)
        ->setDiffuse(colour(room::kNewColor));
    radiosity.show(false);
    picture("painted-direct");
    room::print(radiosity.update());
    picture("painted");
  }

 private:
  void build(bool shiny) {
    for (const room::Paint& paint : room::kPaints) {
      const Ogre::MaterialPtr material =
          Ogre::MaterialManager::getSingleton().create(paint.name, Ogre::RGN_DEFAULT);
      material->setDiffuse(colour(paint.color));
      material->setAmbient(0, 0, 0);
      material->setSelfIllumination(colour(paint.emission, kUnit));
      if (shiny && std::string(paint.name) == "lacquer") {
        material->setSpecular(0.3f, 0.3f, 0.3f, 1);
        material->setShininess(30);
      }
    }
    int number = 0;
    for (const room::Wall& wall : room::walls()) {
      const std::string name = "wall " + std::to_string(number++);
      Ogre::ManualObject* quad = scene_->createManualObject();
      quad->begin(room::kPaints[wall.paint].name, Ogre::RenderOperation::OT_TRIANGLE_LIST);
      const Ogre::Vector3 corner = vec(wall.corner), a = vec(wall.a), b = vec(wall.b);
      for (const Ogre::Vector3& at : {corner, corner + a, corner + a + b, corner + b}) {
        quad->position(at);
        quad->normal(a.crossProduct(b).normalisedCopy());
      }
      quad->quad(0, 1, 2, 3);
      quad->end();
      quad->convertToMesh(name);
      scene_->destroyManualObject(quad);
      scene_->getRootSceneNode()->createChildSceneNode()->attachObject(scene_->createEntity(name));
    }
    scene_->setAmbientLight(Ogre::ColourValue::Black);
    lamp_ = scene_->createLight();
    const room::Lamp lamp;
    lamp_->setDiffuseColour(colour(lamp.strength, kUnit));
    lamp_->setSpecularColour(colour(lamp.strength, kUnit));
    lamp_->setAttenuation(100, 1, 0, 0);
    scene_->getRootSceneNode()->createChildSceneNode(vec(lamp.position))->attachObject(lamp_);

    Ogre::Camera* camera = scene_->createCamera("eye");
    Ogre::SceneNode* node = scene_->getRootSceneNode()->createChildSceneNode(vec(room::kEye));
    node->attachObject(camera);
    node->lookAt(vec(room::kTarget), Ogre::Node::TS_WORLD);
    camera->setFOVy(Ogre::Degree(room::kFieldOfView));
    camera->setAspectRatio(static_cast<float>(room::kWidth) / room::kHeight);
    camera->setNearClipDistance(0.05f);
    screen_ = Ogre::TextureManager::getSingleton().createManual(
        "screen", Ogre::RGN_DEFAULT, Ogre::TEX_TYPE_2D, room::kWidth, room::kHeight, 0, Ogre::PF_FLOAT32_RGBA,
        Ogre::TU_RENDERTARGET);
    Ogre::Viewport* viewport = screen_->getBuffer()->getRenderTarget()->addViewport(camera);
    viewport->setMaterialScheme(shader::ShaderGenerator::DEFAULT_SCHEME_NAME);
  }

  void picture(const std::string& name) {
    screen_->getBuffer()->getRenderTarget()->update();
    std::vector<float> rgba(4 * room::kWidth * room::kHeight);
    screen_->getBuffer()->blitToMemory(
        Ogre::PixelBox(room::kWidth, room::kHeight, 1, Ogre::PF_FLOAT32_RGBA, rgba.data()));
    room::write(file_ + "-" + name, rgba.data(), false, kUnit);
  }

  std::string file_;
  Ogre::LogManager log_;
  Ogre::Log* silent_;
  Ogre::Root root_;
  std::unique_ptr<GeneratedTechniques> generated_;
  Ogre::SceneManager* scene_ = nullptr;
  Ogre::Light* lamp_ = nullptr;
  Ogre::TexturePtr screen_;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "ogre_radiosity OUT [--shiny [SHADERS]]\n");
    return 2;
  }
  try {
    Program(argv[1], argc > 2 && std::string(argv[2]) == "--shiny", argc > 3 ? argv[3] : "").run();
  } catch (const std::exception& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 1;
  }
  return 0;
}
