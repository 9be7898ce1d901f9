// SPDX-License-Identifier: Apache-2.0
#include "gpu/geometry.h"

#include "gpu/surface_vertices.h"
#include "transfer/operator.h"

namespace sconce::gpu {

namespace {

/// What gpu/surface_vertex.glsl reads.
struct Vertex {
  SurfaceVertex surface;
  std::array<int16_t, 2> normal, face;  ///< octahedral; the face's where there is no normal
};
static_assert(sizeof(Vertex) == 17 * sizeof(float));

/// And what it reads where there are normal maps.
struct Bend {
  glm::vec4 tangent;
  Vec2 place;
};
static_assert(sizeof(Bend) == 6 * sizeof(float));

GLenum gl_wrap(sconce::Texture::Wrap mode) {
  switch (mode) {
    case sconce::Texture::Wrap::clamp:
      return GL_CLAMP_TO_EDGE;
    case sconce::Texture::Wrap::mirror:
      return GL_MIRRORED_REPEAT;
    case sconce::Texture::Wrap::repeat:
      break;
  }
  return GL_REPEAT;
}

std::vector<unsigned char> as_rgba(const Image8& image) {
  const auto channels = static_cast<std::size_t>(image.channels);
  std::vector<unsigned char> out;
  out.reserve(image.data.size() / channels * 4);
  for (std::size_t i = 0; i + channels <= image.data.size(); i += channels) {
    const unsigned char* p = &image.data[i];
    const bool grey = channels < 3;
    for (std::size_t c = 0; c < 3; ++c) out.push_back(p[grey ? 0 : c]);
    out.push_back(channels == 2 ? p[1] : channels == 4 ? p[3] : 255);
  }
  return out;
}

std::vector<float> decode_srgb(const std::vector<unsigned char>& rgba) {
  std::array<float, 256> linear{};
  for (std::size_t i = 0; i < linear.size(); ++i) linear[i] = srgb_to_linear(static_cast<float>(i) / 255.0f);
  std::vector<float> out(rgba.size());
  for (std::size_t i = 0; i < rgba.size(); ++i)
    out[i] = i % 4 == 3 ? static_cast<float>(rgba[i]) / 255.0f : linear[rgba[i]];
  return out;
}

Vertex vertex(const ShownScene& shown, std::size_t triangle, std::size_t corner) {
  const World& world = shown.world;
  const Vec3 &normal = world.normals[world.triangles[triangle].v[corner]],
             &face = world.face_normals[triangle];
  return {surface_vertex(shown, triangle, corner), pack_normal(normal == Vec3(0) ? face : normal),
          pack_normal(face)};
}

void add_bends(const ShownScene& shown, std::size_t triangle, std::vector<Bend>& out) {
  const World& world = shown.world;
  const TextureUse& map = shown.scene[world.materials[triangle]].normal_texture;
  const std::array<glm::vec4, 3> tangents = map_tangents(shown.scene, world, triangle);
  for (std::size_t k = 0; k < 3; ++k) out.push_back({tangents[k], place_in(map, world, triangle, k)});
}

std::vector<Bend> bends_of(const ShownScene& shown) {
  std::vector<Bend> bends;
  for (const SurfaceBatch& batch : surface_batches(shown))
    for (const uint32_t t : batch.triangles) add_bends(shown, t, bends);
  return bends;
}

std::vector<Vertex> vertices_of(const ShownScene& shown) {
  std::vector<Vertex> vertices;
  vertices.reserve(3 * shown.world.size());
  for (const SurfaceBatch& batch : surface_batches(shown))
    for (const uint32_t t : batch.triangles)
      for (std::size_t k = 0; k < 3; ++k) vertices.push_back(vertex(shown, t, k));
  return vertices;
}

/// Vertex attributes of so many floats each, from `first` on. @return the buffer
template <class T>
GLuint upload_attributes(const std::vector<T>& vertices, GLuint layout, GLuint binding, GLuint first,
                         std::initializer_list<GLint> floats) {
  GLuint buffer = 0;
  glCreateBuffers(1, &buffer);
  glNamedBufferStorage(buffer, static_cast<GLsizeiptr>(vertices.size() * sizeof(T)), vertices.data(),
                       GL_DYNAMIC_STORAGE_BIT);
  glVertexArrayVertexBuffer(layout, binding, buffer, 0, sizeof(T));
  GLuint offset = 0;
  for (const GLint count : floats) {
    glEnableVertexArrayAttrib(layout, first);
    glVertexArrayAttribFormat(layout, first, count, GL_FLOAT, GL_FALSE, offset);
    glVertexArrayAttribBinding(layout, first++, binding);
    offset += static_cast<GLuint>(count) * sizeof(float);
  }
  return buffer;
}

}  // namespace

Geometry::Geometry(const Context& context, const ShownScene& shown, bool normal_maps)
    : shown_(&shown),
      normal_maps_(normal_maps && shown.scene.has_normal_maps()),
      white_(context, {.format = GL_RGBA8}, "white") {
  const unsigned char white[] = {255, 255, 255, 255};
  white_.upload(GL_RGBA, GL_UNSIGNED_BYTE, white);
  upload_textures(context);
  upload_triangles();
  context.check("uploading the scene");
}

Geometry::~Geometry() {
  glDeleteVertexArrays(1, &layout_);
  glDeleteBuffers(1, &vertices_);
  glDeleteBuffers(1, &normals_);
}

void Geometry::upload_triangles() {
  GLint first = 0;
  for (const SurfaceBatch& batch : surface_batches(*shown_)) {
    const auto count = static_cast<GLsizei>(3 * batch.triangles.size());
    batches_.push_back({batch.material, batch.group, first, count});
    first += count;
  }
  glCreateVertexArrays(1, &layout_);
  vertices_ = upload_attributes(vertices_of(*shown_), layout_, 0, 0, {3, 2, 2, 2, 3, 3});
  constexpr GLuint kNormals = 6;
  glEnableVertexArrayAttrib(layout_, kNormals);
  glVertexArrayAttribFormat(layout_, kNormals, 4, GL_SHORT, GL_TRUE, offsetof(Vertex, normal));
  glVertexArrayAttribBinding(layout_, kNormals, 0);
  if (normal_maps_) normals_ = upload_attributes(bends_of(*shown_), layout_, 1, kNormals + 1, {4, 2});
}

void Geometry::follow(const ShownScene& shown) {
  shown_ = &shown;
  const std::vector<Vertex> vertices = vertices_of(shown);
  glNamedBufferSubData(vertices_, 0, static_cast<GLsizeiptr>(vertices.size() * sizeof(Vertex)),
                       vertices.data());
  if (!normal_maps_) return;
  const std::vector<Bend> bends = bends_of(shown);
  glNamedBufferSubData(normals_, 0, static_cast<GLsizeiptr>(bends.size() * sizeof(Bend)), bends.data());
}

void Geometry::upload_textures(const Context& context) {
  const Scene& scene = shown_->scene;
  const auto add = [&](const TextureUse& use, bool srgb, GLenum data = GL_RGBA8) {
    if (!use.texture || textures_.contains({use.texture.value, srgb})) return;
    const sconce::Texture& texture = scene[use.texture];
    if (texture.pixels.data.empty()) return;
    TextureParams params;
    // Mesa's software decodes sRGB by a polynomial that is off by up to 0.7 %.
    const bool decoded = srgb && context.capabilities().software;
    params.format = decoded ? GL_RGBA16F : srgb ? GL_SRGB8_ALPHA8 : data;
    params.width = texture.pixels.width;
    params.height = texture.pixels.height;
    params.filter = texture.nearest ? GL_NEAREST : GL_LINEAR;
    params.wrap_u = gl_wrap(texture.wrap_u);
    params.wrap_v = gl_wrap(texture.wrap_v);
    Texture made(context, params, "texture '" + texture.name + "'");
    const std::vector<unsigned char> codes = as_rgba(texture.pixels);
    if (decoded)
      made.upload(GL_RGBA, GL_FLOAT, decode_srgb(codes).data());
    else
      made.upload(GL_RGBA, GL_UNSIGNED_BYTE, codes.data());
    textures_.emplace(Use{use.texture.value, srgb}, std::move(made));
  };
  for (const Material& material : scene.materials) {
    add(material.base_color_texture, true);
    add(material.metallic_roughness_texture, false);
    if (material.emits()) add(material.emission_texture, true);
    // Filtered to eight bits by Mesa's software, normals would turn by steps of half a degree.
    if (normal_maps_)
      add(material.normal_texture, false, context.capabilities().software ? GL_RGBA16 : GL_RGBA8);
  }
}

void Geometry::bind(const TextureUse& use, bool srgb, int unit) const {
  const auto found = use.texture ? textures_.find({use.texture.value, srgb}) : textures_.end();
  (found == textures_.end() ? white_ : found->second).bind(unit);
}

void Geometry::set_base(const Program& program, const Material& material) const {
  bind(material.base_color_texture, true, 0);
  program.set("alpha", material.alpha);
  program.set("alpha_cutoff", material.alpha_mode == Material::Alpha::mask ? material.alpha_cutoff : -1.0f);
}

void Geometry::draw(const Program& surface, const std::vector<Rgb>& weights) const {
  glBindVertexArray(layout_);
  surface.set("base_map", 0);
  surface.set("metallic_map", 1);
  surface.set("emission_map", 2);
  surface.set("normal_map", 3);
  for (const Batch& batch : batches_) {
    const Material& m = shown_->scene[batch.material];
    set_base(surface, m);
    bind(m.metallic_roughness_texture, false, 1);
    bind(m.emission_texture, true, 2);
    bind(m.normal_texture, false, 3);
    surface.set("has_normal_map", normal_maps_ && m.normal_texture.texture ? 1 : 0);
    surface.set("normal_scale", m.normal_scale);
    surface.set("base_color", m.base_color);
    surface.set("metallic", m.metallic);
    surface.set("roughness", m.roughness);
    surface.set("emission", m.emission);
    surface.set("weight", batch.group ? weights.at(batch.group.value) : Rgb(1));
    const bool pane = shown_->scene.passes(m);
    surface.set("blends", pane && m.alpha_mode == Material::Alpha::blend ? 1 : 0);
    surface.set("transmission", pane ? m.transmission * (1 - m.metallic) : 0.0f);
    surface.set("double_sided", m.double_sided ? 1 : 0);
    glDrawArrays(GL_TRIANGLES, batch.first, batch.count);
  }
}

void Geometry::draw_shapes(const Program& shader) const {
  glBindVertexArray(layout_);
  shader.set("base_map", 0);
  for (const Batch& batch : batches_) {
    if (shown_->scene.passes(shown_->scene[batch.material])) continue;  // panes cast no shadow
    set_base(shader, shown_->scene[batch.material]);
    glDrawArrays(GL_TRIANGLES, batch.first, batch.count);
  }
}

}  // namespace sconce::gpu
