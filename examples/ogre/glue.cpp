// SPDX-License-Identifier: Apache-2.0
#include "glue.h"

#include <OgreShaderFFPRenderState.h>
#include <OgreShaderFunction.h>
#include <OgreShaderProgram.h>
#include <OgreShaderProgramSet.h>
#include <OgreShaderRenderState.h>
#include <OgreShaderSubRenderState.h>

#include "core/error.h"

using namespace sconce;
namespace shader = Ogre::RTShader;

namespace {

const Ogre::String kScheme = "sconce_faces", kGroup = Ogre::RGN_DEFAULT;
constexpr unsigned short kLight = 1, kPlace = 2;  // texture coordinates

/// The end of every vertex shader of the scheme: the position is the face's place.
class PlaceState : public shader::SubRenderState {
 public:
  inline static const Ogre::String kType = "sconce_place";
  const Ogre::String& getType() const override { return kType; }
  int getExecutionOrder() const override { return shader::FFP_POST_PROCESS + 100; }
  void copyFrom(const shader::SubRenderState&) override {}
  bool createCpuSubPrograms(shader::ProgramSet* programs) override {
    shader::Function* main = programs->getCpuProgram(Ogre::GPT_VERTEX_PROGRAM)->getMain();
    const auto place =
        main->resolveInputParameter(shader::Parameter::SPC_TEXTURE_COORDINATE2, Ogre::GCT_FLOAT2);
    const auto position = main->resolveOutputParameter(shader::Parameter::SPC_POSITION_PROJECTIVE_SPACE);
    const auto end = main->getStage(shader::FFP_VS_POST_PROCESS + 100);
    end.assign(shader::In(shader::ParameterFactory::createConstParam(Ogre::Vector4(0, 0, 0, 1))),
               shader::Out(position));
    shader::Out xy(position);
    xy.xy();
    end.assign(shader::In(place), xy);
    return true;
  }
};

class PlaceFactory : public shader::SubRenderStateFactory {
 public:
  const Ogre::String& getType() const override { return PlaceState::kType; }

 protected:
  shader::SubRenderState* createInstanceImpl() override { return OGRE_NEW PlaceState; }
};

/// f(the bytes of a buffer).
template <class F>
void read_buffer(Ogre::HardwareBuffer& buffer, F&& f) {
  Ogre::HardwareBufferLockGuard lock(&buffer, Ogre::HardwareBuffer::HBL_READ_ONLY);
  f(static_cast<const unsigned char*>(lock.pData));
}

std::vector<Vec3> vectors(const Ogre::VertexData& data, Ogre::VertexElementSemantic semantic) {
  std::vector<Vec3> values;
  const Ogre::VertexElement* element = data.vertexDeclaration->findElementBySemantic(semantic);
  if (element == nullptr || element->getType() != Ogre::VET_FLOAT3) return values;
  const auto buffer = data.vertexBufferBinding->getBuffer(element->getSource());
  read_buffer(*buffer, [&](const unsigned char* bytes) {
    for (std::size_t v = data.vertexStart; v < data.vertexStart + data.vertexCount; ++v) {
      Vec3 value;
      std::memcpy(&value, bytes + v * buffer->getVertexSize() + element->getOffset(), sizeof value);
      values.push_back(value);
    }
  });
  return values;
}

std::vector<uint32_t> triangle_corners(const Ogre::SubMesh& mesh, std::size_t vertices) {
  std::vector<uint32_t> corners;
  const Ogre::IndexData& data = *mesh.indexData;
  if (data.indexCount == 0)
    for (uint32_t v = 0; v < vertices; ++v) corners.push_back(v);
  else
    read_buffer(*data.indexBuffer, [&](const unsigned char* bytes) {
      const bool wide = data.indexBuffer->getType() == Ogre::HardwareIndexBuffer::IT_32BIT;
      for (std::size_t i = data.indexStart; i < data.indexStart + data.indexCount; ++i)
        corners.push_back(wide ? reinterpret_cast<const uint32_t*>(bytes)[i]
                               : reinterpret_cast<const uint16_t*>(bytes)[i]);
    });
  return corners;
}

/// The same vertices, one for each corner, with two more pairs of coordinates.
std::array<Ogre::HardwareVertexBufferSharedPtr, 2> expand(Ogre::SubMesh& mesh, const Ogre::VertexData& from,
                                                          const std::vector<uint32_t>& corners) {
  auto& manager = Ogre::HardwareBufferManager::getSingleton();
  auto* data = OGRE_NEW Ogre::VertexData;
  data->vertexCount = corners.size();
  unsigned short next = 0;
  for (const Ogre::VertexElement& e : from.vertexDeclaration->getElements()) {
    data->vertexDeclaration->addElement(e.getSource(), e.getOffset(), e.getType(), e.getSemantic(),
                                        e.getIndex());
    next = std::max<unsigned short>(next, e.getSource() + 1);
  }
  for (const auto& [source, buffer] : from.vertexBufferBinding->getBindings()) {
    const std::size_t size = buffer->getVertexSize();
    std::vector<unsigned char> bytes(corners.size() * size);
    read_buffer(*buffer, [&](const unsigned char* old) {
      for (std::size_t i = 0; i < corners.size(); ++i)
        std::memcpy(&bytes[i * size], old + (from.vertexStart + corners[i]) * size, size);
    });
    const auto expanded = manager.createVertexBuffer(size, corners.size(), Ogre::HardwareBuffer::HBU_STATIC);
    expanded->writeData(0, bytes.size(), bytes.data(), true);
    data->vertexBufferBinding->setBinding(source, expanded);
  }
  std::array<Ogre::HardwareVertexBufferSharedPtr, 2> added;
  for (const unsigned short set : {kLight, kPlace}) {
    auto& buffer = added[set - kLight];
    buffer = manager.createVertexBuffer(sizeof(Vec2), corners.size(), Ogre::HardwareBuffer::HBU_DYNAMIC);
    data->vertexDeclaration->addElement(next, 0, Ogre::VET_FLOAT2, Ogre::VES_TEXTURE_COORDINATES, set);
    data->vertexBufferBinding->setBinding(next++, buffer);
  }
  mesh.useSharedVertices = false;
  mesh.vertexData = data;
  mesh.indexData->indexCount = 0;  // drawn without indices
  return added;
}

}  // namespace

OgreRadiosity::OgreRadiosity(Ogre::SceneManager& scene, const std::string& scheme)
    : scene_(scene), listener_(kScheme), map_(collect(), 12) {
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
  all_ = scene.createCamera("sconce_all");
  root->createChildSceneNode(Ogre::Vector3(0, 0, 5e4f))->attachObject(all_);
  all_->setProjectionType(Ogre::PT_ORTHOGRAPHIC);
  all_->setOrthoWindow(1e5f, 1e5f);
  all_->setFarClipDistance(1e5f);
  eye_->setCullingFrustum(all_);
  probe_ = scene.createLight("sconce_probe");
  probe_->setType(Ogre::Light::LT_DIRECTIONAL);
  probe_->setVisible(false);
  root->createChildSceneNode()->attachObject(probe_);

  const TextureSpace& space = map_.space();
  light_ = Ogre::TextureManager::getSingleton().createManual(
      "sconce_light", kGroup, Ogre::TEX_TYPE_2D, static_cast<unsigned>(space.width),
      static_cast<unsigned>(space.height), 0, Ogre::PF_FLOAT32_RGB, Ogre::TU_DYNAMIC_WRITE_ONLY);
  std::vector<std::vector<Vec2>> coordinates;
  for (const Part& part : parts_) coordinates.emplace_back(part.places.size());
  const auto corners = map_.coordinates();
  for (std::size_t t = 0; t < corners.size(); ++t)
    std::copy_n(corners[t].begin(), 3,
                &coordinates[map_.world().instances[t].value][3 * map_.world().source_triangles[t]]);
  for (std::size_t p = 0; p < parts_.size(); ++p)
    parts_[p].map_buffer->writeData(0, coordinates[p].size() * sizeof(Vec2), coordinates[p].data(), true);

  TransferParams params;
  params.gather = 4096, params.rays = 256, params.lights = 128;
  map_.start({[this](const DrawRequest& request) { return draw(request); }}, params);
  show(false);
  for (const auto& [name, id] : materials_) {  // after the copies that faces are drawn with were made
    const Ogre::MaterialPtr material = Ogre::MaterialManager::getSingleton().getByName(name);
    Ogre::TextureUnitState* unit = material->getTechnique(0)->getPass(0)->createTextureUnitState();
    unit->setTexture(light_);
    unit->setTextureCoordSet(kLight);
    unit->setTextureAddressingMode(Ogre::TextureUnitState::TAM_CLAMP);
    unit->setTextureFiltering(Ogre::TFO_BILINEAR);
    unit->setColourOperation(Ogre::LBO_ADD);
    generator.invalidateMaterial(scheme, material->getName(), material->getGroup());
  }
}

Scene OgreRadiosity::collect() {
  Scene scene;
  white_ = Ogre::MaterialManager::getSingleton().create("sconce_white", kGroup);
  white_->setDiffuse(1, 1, 1, 1);
  white_->setAmbient(0, 0, 0);
  white_->setCullingMode(Ogre::CULL_NONE);
  white_->setDepthCheckEnabled(false);
  for (const auto& [name, object] : scene_.getMovableObjects("Entity"))
    if (object->isInScene()) take(static_cast<Ogre::Entity&>(*object), scene);
  if (parts_.empty()) throw Error("scene", "has no entities");
  return scene;
}

void OgreRadiosity::take(Ogre::Entity& entity, Scene& out) {
  if (!meshes_.insert(entity.getMesh().get()).second)
    throw Error(entity.getName(), "shares its mesh with another entity", "a mesh for each place");
  const Ogre::Affine3& place = entity.getParentSceneNode()->_getFullTransform();
  const Ogre::Matrix3 turned = place.linear().Inverse().Transpose();
  for (std::size_t s = 0; s < entity.getNumSubEntities(); ++s) {
    Part part;
    part.entity = entity.getSubEntity(s);
    Ogre::SubMesh& sub = *part.entity->getSubMesh();
    const Ogre::VertexData& data =
        sub.useSharedVertices ? *entity.getMesh()->sharedVertexData : *sub.vertexData;
    const std::vector<Vec3> positions = vectors(data, Ogre::VES_POSITION),
                            normals = vectors(data, Ogre::VES_NORMAL);
    if (sub.operationType != Ogre::RenderOperation::OT_TRIANGLE_LIST || normals.empty() ||
        data.vertexDeclaration->findElementBySemantic(Ogre::VES_TEXTURE_COORDINATES, kLight) != nullptr)
      throw Error(entity.getName(), "cannot be taken",
                  "triangle lists with normals and at most one pair of coordinates");
    part.own = part.entity->getMaterial();
    const auto [it, added] = materials_.try_emplace(part.own->getName(), out.materials.size());
    const Ogre::String bare = "sconce_" + part.own->getName();
    if (added) {
      out.materials.emplace_back().name = part.own->getName();
      const Ogre::MaterialPtr copy = part.own->clone(bare);
      copy->setCullingMode(Ogre::CULL_NONE);
      copy->setDepthCheckEnabled(false);
    }
    part.bare = Ogre::MaterialManager::getSingleton().getByName(bare);
    Mesh mesh;
    mesh.material = it->second;
    for (std::size_t v = 0; v < positions.size(); ++v) {
      const Ogre::Vector3 p = place * Ogre::Vector3(&positions[v].x);
      const Ogre::Vector3 n = (turned * Ogre::Vector3(&normals[v].x)).normalisedCopy();
      mesh.positions.emplace_back(p.x, p.y, p.z);
      mesh.normals.emplace_back(n.x, n.y, n.z);
    }
    const std::vector<uint32_t> corners = triangle_corners(sub, positions.size());
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
      mesh.triangles.push_back({{corners[i], corners[i + 1], corners[i + 2]}});
    const auto buffers = expand(sub, data, corners);
    part.map_buffer = buffers[0], part.place_buffer = buffers[1];
    part.places.resize(corners.size());
    Instance instance;
    instance.mesh = Id<Mesh>(out.meshes.size());
    out.meshes.push_back(std::move(mesh));
    out.instances.push_back(instance);
    parts_.push_back(std::move(part));
  }
}

FrameReport OgreRadiosity::update() {
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
const Ogre::TexturePtr& OgreRadiosity::target(int width, int height) {
  Ogre::TexturePtr& texture = targets_[{width, height}];
  if (texture) return texture;
  texture = Ogre::TextureManager::getSingleton().createManual(
      "sconce_" + std::to_string(width) + "x" + std::to_string(height), kGroup, Ogre::TEX_TYPE_2D,
      static_cast<unsigned>(width), static_cast<unsigned>(height), 0, Ogre::PF_FLOAT32_RGBA,
      Ogre::TU_RENDERTARGET);
  Ogre::RenderTexture* render = texture->getBuffer()->getRenderTarget();
  render->setAutoUpdated(false);
  Ogre::Viewport* viewport = render->addViewport(eye_);
  viewport->setMaterialScheme(kScheme);
  viewport->setOverlaysEnabled(false);
  viewport->setSkiesEnabled(false);
  return texture;
}

Drawing OgreRadiosity::draw(const DrawRequest& request) {
  for (Part& part : parts_) std::fill(part.places.begin(), part.places.end(), Vec2(2));  // nowhere
  const Vec2 whole(request.width, request.height);
  for (std::size_t i = 0; i < request.triangles.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      const uint32_t t = request.triangles[i];
      parts_[map_.world().instances[t].value].places[3 * map_.world().source_triangles[t] + c] =
          2.0f * request.corners[i][c] / whole - 1.0f;
    }
  for (Part& part : parts_) {
    part.place_buffer->writeData(0, part.places.size() * sizeof(Vec2), part.places.data(), true);
    part.entity->setMaterial(request.white_card ? white_ : part.bare);
  }
  std::vector<std::pair<Ogre::MovableObject*, bool>> lights;
  for (const auto& [name, light] : scene_.getMovableObjects("Light")) {
    lights.emplace_back(light, light->getVisible());
    if (request.lights != DrawRequest::Lights::all) light->setVisible(false);
  }
  const Ogre::ColourValue ambient = scene_.getAmbientLight();
  scene_.setAmbientLight(Ogre::ColourValue::Black);
  const Vec3& to = request.probe.to_light;
  probe_->setVisible(request.lights == DrawRequest::Lights::probe);
  probe_->setDiffuseColour(Ogre::ColourValue::White * request.probe.intensity);
  probe_->setSpecularColour(Ogre::ColourValue::White * request.probe.intensity);
  probe_->getParentSceneNode()->setDirection(-to.x, -to.y, -to.z, Ogre::Node::TS_WORLD);
  eye_->getParentSceneNode()->setPosition(request.eye.x, request.eye.y, request.eye.z);

  const Ogre::TexturePtr& texture = target(request.width, request.height);
  Ogre::RenderTexture* render = texture->getBuffer()->getRenderTarget();
  render->getViewport(0)->setBackgroundColour(Ogre::ColourValue::White * request.background);
  render->update();
  Drawing drawing;
  drawing.width = request.width, drawing.height = request.height;
  drawing.values.resize(3 * static_cast<std::size_t>(request.width) *
                        static_cast<std::size_t>(request.height));
  const Ogre::PixelBox box(texture->getWidth(), texture->getHeight(), 1, Ogre::PF_FLOAT32_RGB,
                           drawing.values.data());
  texture->getBuffer()->blitToMemory(box);

  scene_.setAmbientLight(ambient);
  for (const auto& [light, visible] : lights) light->setVisible(visible);
  probe_->setVisible(false);
  for (Part& part : parts_) part.entity->setMaterial(part.own);
  return drawing;
}
