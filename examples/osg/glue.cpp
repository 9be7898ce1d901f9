// SPDX-License-Identifier: Apache-2.0
#include "glue.h"

#include <glm/gtc/type_ptr.hpp>
#include <osg/Program>
#include <osg/Shader>
#include <osg/TriangleIndexFunctor>
#include <set>

#include "core/error.h"
#include "core/stopwatch.h"
#include "shader/vertex_override.h"

using namespace sconce;

namespace {

constexpr unsigned kPlace = 7;              // vertex attribute that compatibility profiles leave free
constexpr unsigned kScene = 1, kFaces = 2;  // node masks: what the screen shows, what textures show

Vec3 vec(const osg::Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

struct Triples {
  std::vector<unsigned> indices;
  void operator()(unsigned a, unsigned b, unsigned c) { indices.insert(indices.end(), {a, b, c}); }
};

/// A vertex for each index. Null where the array is of another type.
template <class Array>
osg::ref_ptr<osg::Array> expanded(const osg::Array* from, const std::vector<unsigned>& indices) {
  const auto* values = dynamic_cast<const Array*>(from);
  if (values == nullptr) return nullptr;
  osg::ref_ptr<Array> out = new Array(osg::Array::BIND_PER_VERTEX);
  for (const unsigned i : indices) out->push_back((*values)[i]);
  return out;
}

osg::ref_ptr<osg::Array> expanded_any(osg::Array* from, const std::vector<unsigned>& indices) {
  if (from == nullptr || from->getBinding() != osg::Array::BIND_PER_VERTEX) return from;
  for (const auto make : {expanded<osg::Vec2Array>, expanded<osg::Vec3Array>, expanded<osg::Vec4Array>,
                          expanded<osg::Vec4ubArray>})
    if (auto out = make(from, indices)) return out;
  throw Error("geometry", std::string("has vertex data of type ") + from->className(),
              "Vec2Array, Vec3Array, Vec4Array, Vec4ubArray");
}

/// The last that is drawn: what comes after it is reading back.
class Drawn : public osg::Drawable {
 public:
  Drawn() { setCullingActive(false), getOrCreateStateSet()->setRenderBinDetails(1000, "RenderBin"); }
  void drawImplementation(osg::RenderInfo&) const override { glFinish(), since = {}; }
  mutable Stopwatch since;
};

void set(osg::Vec2Array& array, const std::vector<Vec2>& values) {
  for (std::size_t i = 0; i < values.size(); ++i) array[i].set(values[i].x, values[i].y);
  array.dirty();
}

}  // namespace

/// Takes the graph in: shaders are rewritten, geometries become a Scene.
class OsgRadiosity::Collector : public osg::NodeVisitor {
 public:
  explicit Collector(OsgRadiosity& out) : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), out_(out) {}
  bool found_shader() const { return !shaders_.empty(); }

  void apply(osg::Node& node) override {
    rewrite(node.getStateSet());
    traverse(node);
  }
  void apply(osg::Geometry& geometry) override {
    rewrite(geometry.getStateSet());
    if (!geometries_.insert(&geometry).second)
      throw Error(geometry.getName(), "is in the graph twice", "a geometry for each place");
    const auto* positions = dynamic_cast<const osg::Vec3Array*>(geometry.getVertexArray());
    const auto* normals = dynamic_cast<const osg::Vec3Array*>(geometry.getNormalArray());
    if (positions == nullptr || normals == nullptr || normals->empty())
      throw Error(geometry.getName(), "has no Vec3Array of vertices and of normals");
    std::vector<Vec3> corners, corner_normals;
    osg::TriangleIndexFunctor<Triples> triples;
    geometry.accept(triples);
    for (const unsigned v : triples.indices) {
      corners.push_back(vec((*positions)[v]));
      corner_normals.push_back(vec((*normals)[std::min(v, static_cast<unsigned>(normals->size()) - 1)]));
    }
    const osg::Matrixf world(osg::computeLocalToWorld(getNodePath()));
    add_part(out_.scene_, material(), std::move(corners), std::move(corner_normals),
             glm::make_mat4(world.ptr()));
    expand(geometry, triples.indices);
  }

 private:
  void rewrite(osg::StateSet* state) {
    auto* program = state == nullptr
                        ? nullptr
                        : dynamic_cast<osg::Program*>(state->getAttribute(osg::StateAttribute::PROGRAM));
    if (program == nullptr || !programs_.insert(program).second) return;
    program->addBindAttribLocation("sconce_place", kPlace);
    for (unsigned i = 0; i < program->getNumShaders(); ++i)
      if (osg::Shader* shader = program->getShader(i);
          shader->getType() == osg::Shader::VERTEX && shaders_.insert(shader).second)
        shader->setShaderSource(override_vertex_position(shader->getShaderSource(), shader->getName()));
  }

  /// Geometries under the same state are of one material.
  Id<Material> material() {
    const osg::StateSet* state = nullptr;
    for (const osg::Node* node : getNodePath())
      if (node->getStateSet() != nullptr) state = node->getStateSet();
    const auto [it, added] = materials_.try_emplace(state, out_.scene_.materials.size());
    if (added) {
      Material material;
      material.name = state != nullptr && !state->getName().empty() ? state->getName()
                                                                    : "state " + std::to_string(it->second);
      out_.scene_.materials.push_back(material);
    }
    return Id<Material>(it->second);
  }

  void expand(osg::Geometry& g, const std::vector<unsigned>& indices) {
    g.setVertexArray(expanded_any(g.getVertexArray(), indices));
    g.setNormalArray(expanded_any(g.getNormalArray(), indices));
    g.setColorArray(expanded_any(g.getColorArray(), indices));
    for (unsigned i = 0; i < g.getNumTexCoordArrays(); ++i)
      g.setTexCoordArray(i, expanded_any(g.getTexCoordArray(i), indices));
    for (unsigned i = 0; i < g.getNumVertexAttribArrays(); ++i)
      g.setVertexAttribArray(i, expanded_any(g.getVertexAttribArray(i), indices));
    g.removePrimitiveSet(0, g.getNumPrimitiveSets());
    g.addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 0, static_cast<int>(indices.size())));
    Part part;
    part.places = new osg::Vec2Array(osg::Array::BIND_PER_VERTEX, static_cast<unsigned>(indices.size()));
    part.lightmap = new osg::Vec2Array(osg::Array::BIND_PER_VERTEX, static_cast<unsigned>(indices.size()));
    g.setVertexAttribArray(kPlace, part.places);
    g.setTexCoordArray(1, part.lightmap);
    g.setUseDisplayList(false);
    g.setUseVertexBufferObjects(true);
    out_.parts_.push_back(part);
  }

  OsgRadiosity& out_;
  std::set<const osg::Geometry*> geometries_;
  std::set<const osg::Program*> programs_;
  std::set<const osg::Shader*> shaders_;
  std::map<const osg::StateSet*, std::size_t> materials_;
};

OsgRadiosity::OsgRadiosity(osgViewer::Viewer& viewer, osg::Group& root, osg::Node& scene,
                           SetLights set_lights)
    : viewer_(viewer), root_(root), scene_node_(scene), set_lights_(std::move(set_lights)) {
  Collector collector(*this);
  scene.accept(collector);
  if (!collector.found_shader()) throw Error("scene", "has no GLSL vertex shader of its own at or below it");
  scene.setNodeMask(kScene);
  viewer.getCamera()->setCullMask(kScene);
  viewer.getCamera()->getOrCreateStateSet()->addUniform(new osg::Uniform("sconce_in_faces", 0.0f));
  map_ = std::make_unique<AmbientMap>(std::move(scene_), 12.0f);
  const PartCorners coordinates = map_->coordinates();
  for (std::size_t p = 0; p < parts_.size(); ++p) set(*parts_[p].lightmap, coordinates[p]);

  osg::ref_ptr<osg::Image> image = new osg::Image;
  image->allocateImage(map_->space().width, map_->space().height, 1, GL_RGB, GL_FLOAT);
  image->setInternalTextureFormat(GL_RGB32F_ARB);
  ambient_map_->setImage(image);
  ambient_map_->setResizeNonPowerOfTwoHint(false);
  for (const auto filter : {osg::Texture::MIN_FILTER, osg::Texture::MAG_FILTER})
    ambient_map_->setFilter(filter, osg::Texture::LINEAR);

  map_->start({[this](const DrawRequest& request) { return draw(request); }});
}

FrameReport OsgRadiosity::update() {
  FrameReport report = map_->update();
  const std::span<const Rgb> ambient = map_->texels();
  std::copy_n(&ambient[0].r, 3 * ambient.size(), reinterpret_cast<float*>(ambient_map_->getImage()->data()));
  ambient_map_->getImage()->dirty();
  return report;
}

/// A camera that draws the scene into a float texture of that size.
const OsgRadiosity::Target& OsgRadiosity::target(int width, int height) {
  Target& t = targets_[{width, height}];
  if (t.camera) return t;
  t.image = new osg::Image;
  t.image->allocateImage(width, height, 1, GL_RGBA, GL_FLOAT);
  t.image->setInternalTextureFormat(GL_RGBA32F_ARB);
  t.camera = new osg::Camera;
  t.camera->setRenderOrder(osg::Camera::PRE_RENDER);
  t.camera->setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
  t.camera->attach(osg::Camera::COLOR_BUFFER, t.image);
  t.camera->setViewport(0, 0, width, height);
  t.camera->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
  t.camera->setCullingMode(osg::CullSettings::NO_CULLING);
  t.camera->setCullMask(kScene);
  t.camera->setNodeMask(kFaces);
  const auto off = osg::StateAttribute::OFF | osg::StateAttribute::OVERRIDE;
  osg::StateSet* state = t.camera->getOrCreateStateSet();
  state->setMode(GL_CULL_FACE, off);
  state->setMode(GL_DEPTH_TEST, off);
  state->addUniform(new osg::Uniform("sconce_in_faces", 1.0f));
  t.camera->addChild(&scene_node_);
  t.camera->addChild(t.drawn = new Drawn);
  return t;
}

Drawing OsgRadiosity::draw(const DrawRequest& request) {
  const PartCorners places = map_->places(request);
  for (std::size_t p = 0; p < parts_.size(); ++p) set(*parts_[p].places, places[p]);
  const Target& t = target(request.width, request.height);
  t.camera->setClearColor(osg::Vec4(1, 1, 1, 1) * request.background);
  t.camera->setViewMatrix(viewer_.getCamera()->getViewMatrix());
  t.camera->setProjectionMatrix(viewer_.getCamera()->getProjectionMatrix());
  set_lights_(request);
  root_.addChild(t.camera);
  viewer_.getCamera()->setCullMask(kFaces);  // not the screen this time
  viewer_.frame();
  viewer_.getCamera()->setCullMask(kScene);
  root_.removeChild(t.camera);
  Drawing drawing{t.image->s(), t.image->t(), {}, {}};
  const auto* rgba = reinterpret_cast<const float*>(t.image->data());
  for (std::size_t i = 0; i < request.pixels(); ++i)
    drawing.values.insert(drawing.values.end(), rgba + 4 * i, rgba + 4 * i + 3);
  drawing.read_milliseconds = static_cast<const Drawn&>(*t.drawn).since.milliseconds();
  return drawing;
}
