// SPDX-License-Identifier: Apache-2.0
#include "glue.h"

#include <GL/gl.h>
#include <OgreRTShaderSystem.h>
#include <OgreShaderFFPRenderState.h>
#include <OgreShaderProgram.h>

#include <glm/gtc/type_ptr.hpp>
#include <numeric>

#include "core/error.h"
#include "core/stopwatch.h"
#include "detect/vertex_buffer.h"

using namespace sconce;
namespace shader = Ogre::RTShader;

namespace {

const Ogre::String kScheme = "sconce_faces", kGroup = Ogre::RGN_DEFAULT;
constexpr unsigned short kLight = 1, kPlace = 2;  // texture coordinates

/// The end of every vertex shader of the scheme: the position is the face's place, (x, y, 0, 1).
class PlaceState : public shader::SubRenderState {
 public:
  inline static const Ogre::String kType = "sconce_place";
  const Ogre::String& getType() const override { return kType; }
  int getExecutionOrder() const override { return shader::FFP_POST_PROCESS + 100; }
  void copyFrom(const shader::SubRenderState&) override {}
  bool createCpuSubPrograms(shader::ProgramSet* programs) override {
    shader::Function* main = programs->getCpuProgram(Ogre::GPT_VERTEX_PROGRAM)->getMain();
    main->getStage(shader::FFP_VS_POST_PROCESS + 100)
        .assign(main->resolveInputParameter(shader::Parameter::SPC_TEXTURE_COORDINATE2, Ogre::GCT_FLOAT4),
                main->resolveOutputParameter(shader::Parameter::SPC_POSITION_PROJECTIVE_SPACE));
    return true;
  }
};

class PlaceFactory : public shader::SubRenderStateFactory {
 public:
  const Ogre::String& getType() const override { return PlaceState::kType; }

 protected:
  shader::SubRenderState* createInstanceImpl() override { return OGRE_NEW PlaceState; }
};

BufferBytes bytes_of(Ogre::HardwareBuffer& buffer) {
  BufferBytes bytes(buffer.getSizeInBytes());
  buffer.readData(0, bytes.size(), bytes.data());
  return bytes;
}

/// Per vertex; empty where there are none of three floats.
std::vector<Vec3> vectors(const Ogre::VertexData& data, Ogre::VertexElementSemantic semantic) {
  const Ogre::VertexElement* element = data.vertexDeclaration->findElementBySemantic(semantic);
  if (element == nullptr || element->getType() != Ogre::VET_FLOAT3) return {};
  const auto buffer = data.vertexBufferBinding->getBuffer(element->getSource());
  return read_vectors(bytes_of(*buffer), buffer->getVertexSize(), element->getOffset());
}

/// Vertices of the buffers, one for each corner.
std::vector<uint32_t> triangle_corners(const Ogre::IndexData& data, const Ogre::VertexData& vertices) {
  std::vector<uint32_t> corners(vertices.vertexCount);
  std::iota(corners.begin(), corners.end(), 0u);
  if (data.indexCount > 0) {
    const auto all = read_indices(bytes_of(*data.indexBuffer), data.indexBuffer->getIndexSize());
    const auto first = all.begin() + static_cast<std::ptrdiff_t>(data.indexStart);
    corners.assign(first, first + static_cast<std::ptrdiff_t>(data.indexCount));
  }
  for (uint32_t& corner : corners) corner += static_cast<uint32_t>(vertices.vertexStart);
  return corners;
}

/// The same vertices, one for each corner.
Ogre::VertexData& expand(Ogre::SubMesh& mesh, const Ogre::VertexData& from) {
  const std::vector<uint32_t> corners = triangle_corners(*mesh.indexData, from);
  Ogre::VertexData* data = from.clone(false);
  data->vertexStart = 0, data->vertexCount = corners.size();
  for (const auto& [source, buffer] : from.vertexBufferBinding->getBindings()) {
    const BufferBytes bytes = vertex_per_index(bytes_of(*buffer), buffer->getVertexSize(), corners);
    const auto expanded = Ogre::HardwareBufferManager::getSingleton().createVertexBuffer(
        buffer->getVertexSize(), corners.size(), Ogre::HardwareBuffer::HBU_STATIC);
    expanded->writeData(0, bytes.size(), bytes.data(), true);
    data->vertexBufferBinding->setBinding(source, expanded);
  }
  mesh.useSharedVertices = false;
  mesh.vertexData = data;
  mesh.indexData->indexCount = 0;  // drawn without indices
  return *data;
}

/// One more pair of texture coordinates.
Ogre::HardwareVertexBufferSharedPtr add_coordinates(Ogre::VertexData& data, unsigned short set) {
  const auto added = Ogre::HardwareBufferManager::getSingleton().createVertexBuffer(
      sizeof(Vec2), data.vertexCount, Ogre::HardwareBuffer::HBU_DYNAMIC);
  const unsigned short next = data.vertexDeclaration->getMaxSource() + 1;
  data.vertexDeclaration->addElement(next, 0, Ogre::VET_FLOAT2, Ogre::VES_TEXTURE_COORDINATES, set);
  data.vertexBufferBinding->setBinding(next, added);
  return added;
}

void write(Ogre::HardwareVertexBuffer& buffer, const std::vector<Vec2>& values) {
  buffer.writeData(0, values.size() * sizeof(Vec2), values.data(), true);
}

/// A material to draw faces with.
Ogre::MaterialPtr for_faces(const Ogre::MaterialPtr& material) {
  material->setCullingMode(Ogre::CULL_NONE);
  material->setDepthCheckEnabled(false);
  shader::ShaderGenerator::getSingleton().createShaderBasedTechnique(
      *material, Ogre::MaterialManager::DEFAULT_SCHEME_NAME, kScheme);
  return material;
}

auto colours(const Ogre::Pass& pass) {
  return std::tuple(pass.getDiffuse(), pass.getSpecular(), pass.getShininess(), pass.getSelfIllumination());
}

template <class F>
struct AtEnd {
  F f;
  ~AtEnd() { f(); }
};

}  // namespace

OgreRadiosity::OgreRadiosity(Ogre::SceneManager& scene, const std::string& scheme)
    : scene_(scene), map_(collect(), 12) {
  auto& generator = shader::ShaderGenerator::getSingleton();
  generator.addSubRenderStateFactory(OGRE_NEW PlaceFactory);
  shader::RenderState* state = generator.createOrRetrieveRenderState(kScheme).first;
  for (const shader::SubRenderState* s :
       generator.createOrRetrieveRenderState(scheme).first->getSubRenderStates())
    state->addTemplateSubRenderState(generator.createSubRenderState(s->getType()));
  state->addTemplateSubRenderState(generator.createSubRenderState(PlaceState::kType));

  Ogre::SceneNode* root = scene.getRootSceneNode();
  eye_ = scene.createCamera("sconce_eye");
  root->createChildSceneNode()->attachObject(eye_);
  Ogre::Camera* all = scene.createCamera("sconce_all");  // sees all, so that nothing is culled
  root->createChildSceneNode(Ogre::Vector3(0, 0, 5e4f))->attachObject(all);
  all->setProjectionType(Ogre::PT_ORTHOGRAPHIC);
  all->setOrthoWindow(1e5f, 1e5f);
  all->setFarClipDistance(1e5f);
  eye_->setCullingFrustum(all);
  probe_ = scene.createLight("sconce_probe");
  probe_->setType(Ogre::Light::LT_DIRECTIONAL);
  probe_->setVisible(false);
  root->createChildSceneNode()->attachObject(probe_);

  const TextureSpace& space = map_.space();
  light_ = Ogre::TextureManager::getSingleton().createManual(
      "sconce_light", kGroup, Ogre::TEX_TYPE_2D, static_cast<unsigned>(space.width),
      static_cast<unsigned>(space.height), 0, Ogre::PF_FLOAT32_RGB, Ogre::TU_DYNAMIC_WRITE_ONLY);
  const PartCorners coordinates = map_.coordinates();
  for (std::size_t p = 0; p < parts_.size(); ++p) write(*parts_[p].coordinates, coordinates[p]);
  map_.start({[this](const DrawRequest& request) { return draw(request); }});
  show(false);
  for (const auto& [own, paint] : paints_) {  // after the copies that faces are drawn with were made
    Ogre::TextureUnitState* unit =
        own->getTechnique(0)->getPass(0)->createTextureUnitState(light_->getName(), kLight);
    unit->setTextureAddressingMode(Ogre::TextureUnitState::TAM_CLAMP);
    unit->setTextureFiltering(Ogre::TFO_BILINEAR);
    unit->setColourOperation(Ogre::LBO_ADD);
    generator.invalidateMaterial(scheme, own->getName(), own->getGroup());
  }
}

Scene OgreRadiosity::collect() {
  Scene scene;
  white_ = for_faces(Ogre::MaterialManager::getSingleton().create("sconce_white", kGroup));
  white_->setDiffuse(1, 1, 1, 1);
  white_->setAmbient(0, 0, 0);
  for (const auto& [name, object] : scene_.getMovableObjects("Entity"))
    if (object->isInScene()) take(static_cast<Ogre::Entity&>(*object), scene);
  if (parts_.empty()) throw Error("scene", "has no entities");
  return scene;
}

void OgreRadiosity::take(Ogre::Entity& entity, Scene& out) {
  const Ogre::Matrix4 place(entity.getParentSceneNode()->_getFullTransform());
  for (std::size_t s = 0; s < entity.getNumSubEntities(); ++s) {
    Part part{entity.getSubEntity(s), nullptr, {}, {}};
    Ogre::SubMesh& sub = *part.entity->getSubMesh();
    const Ogre::VertexData& own =
        sub.useSharedVertices ? *entity.getMesh()->sharedVertexData : *sub.vertexData;
    if (sub.operationType != Ogre::RenderOperation::OT_TRIANGLE_LIST ||
        vectors(own, Ogre::VES_NORMAL).empty() ||
        own.vertexDeclaration->findElementBySemantic(Ogre::VES_TEXTURE_COORDINATES, kLight) != nullptr)
      throw Error(entity.getName(), "cannot be taken",
                  "triangle lists with normals, at most one pair of coordinates and a mesh for each entity");
    Ogre::VertexData& data = expand(sub, own);
    part.coordinates = add_coordinates(data, kLight), part.places = add_coordinates(data, kPlace);
    const auto [it, added] =
        paints_.try_emplace(part.entity->getMaterial(), Paint{Id<Material>(out.materials.size()), nullptr});
    if (added) {
      const Ogre::String& name = out.materials.emplace_back().name = part.entity->getMaterialName();
      it->second.bare = for_faces(it->first->clone("sconce_" + name));
    }
    part.paint = &*it;
    add_part(out, it->second.id, vectors(data, Ogre::VES_POSITION), vectors(data, Ogre::VES_NORMAL),
             glm::transpose(glm::make_mat4(place[0])));
    parts_.push_back(std::move(part));
  }
}

void OgreRadiosity::follow_materials() {
  bool changed = false;
  for (const auto& [own, paint] : paints_) {
    const Ogre::Pass& is = *own->getTechnique(0)->getPass(0);
    if (colours(is) == colours(*paint.bare->getTechnique(0)->getPass(0))) continue;
    changed = true;
    paint.bare->setDiffuse(is.getDiffuse());
    paint.bare->setSpecular(is.getSpecular());
    paint.bare->setShininess(is.getShininess());
    paint.bare->setSelfIllumination(is.getSelfIllumination());
    shader::ShaderGenerator::getSingleton().invalidateMaterial(kScheme, paint.bare->getName(), kGroup);
  }
  if (changed) map_.detect();
}

FrameReport OgreRadiosity::update() {
  follow_materials();
  FrameReport report = map_.update();
  show(true);
  return report;
}

void OgreRadiosity::show(bool on) {
  std::vector<Rgb> texels(map_.space().pixels());
  if (on) texels = map_.reflected();
  light_->getBuffer()->blitFromMemory(
      Ogre::PixelBox(light_->getWidth(), light_->getHeight(), 1, Ogre::PF_FLOAT32_RGB, &texels[0].r));
}

/// A float texture of that size that the scheme draws into.
void OgreRadiosity::set_target(unsigned width, unsigned height) {
  if (target_ && target_->getWidth() == width && target_->getHeight() == height) return;
  auto& textures = Ogre::TextureManager::getSingleton();
  if (target_) textures.remove(target_);
  target_ = textures.createManual("sconce_target", kGroup, Ogre::TEX_TYPE_2D, width, height, 0,
                                  Ogre::PF_FLOAT32_RGBA, Ogre::TU_RENDERTARGET);
  Ogre::RenderTexture* render = target_->getBuffer()->getRenderTarget();
  render->setAutoUpdated(false);
  Ogre::Viewport* viewport = render->addViewport(eye_);
  viewport->setMaterialScheme(kScheme);
  viewport->setOverlaysEnabled(false);
  viewport->setSkiesEnabled(false);
}

Drawing OgreRadiosity::draw(const DrawRequest& request) {
  std::vector<std::pair<Ogre::MovableObject*, bool>> lights;
  for (const auto& [name, light] : scene_.getMovableObjects("Light"))
    lights.emplace_back(light, light->getVisible());
  const Ogre::ColourValue ambient = scene_.getAmbientLight();
  const AtEnd restore{[&] {
    scene_.setAmbientLight(ambient);
    for (const auto& [light, visible] : lights) light->setVisible(visible);
    for (Part& part : parts_) part.entity->setMaterial(part.paint->first);
  }};
  scene_.setAmbientLight(Ogre::ColourValue::Black);
  if (request.lights != DrawRequest::Lights::all)
    for (const auto& [light, visible] : lights) light->setVisible(false);
  probe_->setVisible(request.lights == DrawRequest::Lights::probe);
  const PartCorners places = map_.clip_places(request);
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    write(*parts_[p].places, places[p]);
    parts_[p].entity->setMaterial(request.white_card ? white_ : parts_[p].paint->second.bare);
  }
  const Vec3& to = request.probe.to_light;
  probe_->setDiffuseColour(Ogre::ColourValue::White * request.probe.intensity);
  probe_->setSpecularColour(Ogre::ColourValue::White * request.probe.intensity);
  probe_->getParentSceneNode()->setDirection(-to.x, -to.y, -to.z, Ogre::Node::TS_WORLD);
  eye_->getParentSceneNode()->setPosition(request.eye.x, request.eye.y, request.eye.z);

  set_target(static_cast<unsigned>(request.width), static_cast<unsigned>(request.height));
  Ogre::RenderTexture* render = target_->getBuffer()->getRenderTarget();
  render->getViewport(0)->setBackgroundColour(Ogre::ColourValue::White * request.background);
  render->update();
  glFinish();  // what comes now is reading back
  const Stopwatch reading;
  Drawing drawing{request.width, request.height, std::vector<float>(3 * request.pixels()), {}};
  target_->getBuffer()->blitToMemory(
      {target_->getWidth(), target_->getHeight(), 1, Ogre::PF_FLOAT32_RGB, drawing.values.data()});
  drawing.read_milliseconds = reading.milliseconds();
  return drawing;
}
