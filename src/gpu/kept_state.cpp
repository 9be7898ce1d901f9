// SPDX-License-Identifier: Apache-2.0
#include "gpu/kept_state.h"

#include <array>

#include "core/error.h"

namespace sconce::gpu {

namespace {

GLint integer(GLenum name) {
  GLint value = 0;
  glGetIntegerv(name, &value);
  return value;
}
GLuint object(GLenum binding) {
  return static_cast<GLuint>(integer(binding));
}
GLenum mode(GLenum name) {
  return static_cast<GLenum>(integer(name));
}
template <std::size_t N>
std::array<GLint, N> integers(GLenum name) {
  std::array<GLint, N> values{};
  glGetIntegerv(name, values.data());
  return values;
}
template <std::size_t N>
std::array<GLfloat, N> floats(GLenum name) {
  std::array<GLfloat, N> values{};
  glGetFloatv(name, values.data());
  return values;
}
bool since(int version) {
  return epoxy_gl_version() >= version;  // 45: OpenGL 4.5
}

using Pair = std::pair<GLenum, GLenum>;

void bind_range(GLenum target, GLuint index, GLuint buffer, GLint64 start, GLint64 size) {
  if (buffer == 0 || size == 0)
    glBindBufferBase(target, index, buffer);
  else
    glBindBufferRange(target, index, buffer, static_cast<GLintptr>(start), static_cast<GLsizeiptr>(size));
}

}  // namespace

KeptState::KeptState() {
  glGenFramebuffers(1, &marker_);
  const GLuint drawn = object(GL_DRAW_FRAMEBUFFER_BINDING);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, marker_);  // only now it is one
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, drawn);
  is_current();  // libepoxy looks functions up while there is a context
  keep_values();
  keep_switches();  // of single targets, after what is for all
  keep_stencil();
  keep_textures();
  keep_bindings();
}

KeptState::~KeptState() {
  if (marker_ == 0 || !is_current()) return;
  for (const auto& undo : undo_) undo();
  glDeleteFramebuffers(1, &marker_);
}

bool KeptState::is_current() const {
  return glIsFramebuffer(marker_) == GL_TRUE;
}

void KeptState::restore() {
  const bool current = is_current();
  if (current && since(45) && glGetGraphicsResetStatus() != GL_NO_ERROR) {
    marker_ = 0;
    throw Error("the OpenGL context", "is lost");
  }
  if (!current) {
    marker_ = 0;
    throw Error("the OpenGL context", "is lost, or another one was made current",
                "the one that there was before");
  }
  for (const auto& undo : undo_) undo();
  glDeleteFramebuffers(1, &marker_);
  marker_ = 0;
}

void KeptState::keep_bindings() {
  const auto keep = [this](GLenum binding, auto&& bind) {
    undo_.emplace_back([bind, name = object(binding)] { bind(name); });
  };
  keep(GL_DRAW_FRAMEBUFFER_BINDING, [](GLuint name) { glBindFramebuffer(GL_DRAW_FRAMEBUFFER, name); });
  keep(GL_READ_FRAMEBUFFER_BINDING, [](GLuint name) { glBindFramebuffer(GL_READ_FRAMEBUFFER, name); });
  keep(GL_RENDERBUFFER_BINDING, [](GLuint name) { glBindRenderbuffer(GL_RENDERBUFFER, name); });
  keep(GL_VERTEX_ARRAY_BINDING, [](GLuint name) { glBindVertexArray(name); });
  if (since(41)) keep(GL_PROGRAM_PIPELINE_BINDING, [](GLuint name) { glBindProgramPipeline(name); });
  keep(GL_CURRENT_PROGRAM, [](GLuint name) { glUseProgram(name); });

  struct Indexed {
    GLenum target, binding, start, size, most;
  };
  std::vector<Indexed> indexed{{GL_UNIFORM_BUFFER, GL_UNIFORM_BUFFER_BINDING, GL_UNIFORM_BUFFER_START,
                                GL_UNIFORM_BUFFER_SIZE, GL_MAX_UNIFORM_BUFFER_BINDINGS}};
  if (since(43))
    indexed.push_back({GL_SHADER_STORAGE_BUFFER, GL_SHADER_STORAGE_BUFFER_BINDING,
                       GL_SHADER_STORAGE_BUFFER_START, GL_SHADER_STORAGE_BUFFER_SIZE,
                       GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS});
  for (const Indexed& kind : indexed)
    for (GLuint i = 0; i < object(kind.most); ++i) {
      GLint buffer = 0;
      GLint64 start = 0, size = 0;
      glGetIntegeri_v(kind.binding, i, &buffer);
      glGetInteger64i_v(kind.start, i, &start);
      glGetInteger64i_v(kind.size, i, &size);
      undo_.emplace_back([target = kind.target, i, buffer, start, size] {
        bind_range(target, i, static_cast<GLuint>(buffer), start, size);
      });
    }
  std::vector<Pair> buffers{{GL_ARRAY_BUFFER, GL_ARRAY_BUFFER_BINDING},
                            {GL_PIXEL_PACK_BUFFER, GL_PIXEL_PACK_BUFFER_BINDING},
                            {GL_PIXEL_UNPACK_BUFFER, GL_PIXEL_UNPACK_BUFFER_BINDING},
                            {GL_UNIFORM_BUFFER, GL_UNIFORM_BUFFER_BINDING}};
  if (since(43))
    buffers.insert(buffers.end(), {{GL_DRAW_INDIRECT_BUFFER, GL_DRAW_INDIRECT_BUFFER_BINDING},
                                   {GL_SHADER_STORAGE_BUFFER, GL_SHADER_STORAGE_BUFFER_BINDING},
                                   {GL_COPY_READ_BUFFER, GL_COPY_READ_BUFFER_BINDING},
                                   {GL_COPY_WRITE_BUFFER, GL_COPY_WRITE_BUFFER_BINDING}});
  for (const auto& [target, binding] : buffers)
    keep(binding, [t = target](GLuint name) { glBindBuffer(t, name); });
}

void KeptState::keep_textures() {
  std::vector<Pair> kinds{{GL_TEXTURE_1D, GL_TEXTURE_BINDING_1D},
                          {GL_TEXTURE_2D, GL_TEXTURE_BINDING_2D},
                          {GL_TEXTURE_3D, GL_TEXTURE_BINDING_3D},
                          {GL_TEXTURE_1D_ARRAY, GL_TEXTURE_BINDING_1D_ARRAY},
                          {GL_TEXTURE_2D_ARRAY, GL_TEXTURE_BINDING_2D_ARRAY},
                          {GL_TEXTURE_RECTANGLE, GL_TEXTURE_BINDING_RECTANGLE},
                          {GL_TEXTURE_CUBE_MAP, GL_TEXTURE_BINDING_CUBE_MAP},
                          {GL_TEXTURE_BUFFER, GL_TEXTURE_BINDING_BUFFER},
                          {GL_TEXTURE_2D_MULTISAMPLE, GL_TEXTURE_BINDING_2D_MULTISAMPLE},
                          {GL_TEXTURE_2D_MULTISAMPLE_ARRAY, GL_TEXTURE_BINDING_2D_MULTISAMPLE_ARRAY}};
  if (since(40)) kinds.emplace_back(GL_TEXTURE_CUBE_MAP_ARRAY, GL_TEXTURE_BINDING_CUBE_MAP_ARRAY);
  const GLenum active = mode(GL_ACTIVE_TEXTURE);
  const GLuint units = object(GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS);
  for (GLuint unit = 0; unit < units; ++unit) {
    glActiveTexture(GL_TEXTURE0 + unit);
    std::vector<std::pair<GLenum, GLuint>> bound;
    for (const auto& [target, binding] : kinds) bound.emplace_back(target, object(binding));
    undo_.emplace_back([unit, bound, sampler = object(GL_SAMPLER_BINDING)] {
      glActiveTexture(GL_TEXTURE0 + unit);
      for (const auto& [target, name] : bound) glBindTexture(target, name);
      glBindSampler(unit, sampler);
    });
  }
  glActiveTexture(active);
  undo_.emplace_back([active] { glActiveTexture(active); });
}

void KeptState::keep_switches() {
  std::vector<GLenum> names{GL_COLOR_LOGIC_OP,
                            GL_CULL_FACE,
                            GL_DEPTH_CLAMP,
                            GL_DEPTH_TEST,
                            GL_DITHER,
                            GL_FRAMEBUFFER_SRGB,
                            GL_LINE_SMOOTH,
                            GL_MULTISAMPLE,
                            GL_POLYGON_OFFSET_FILL,
                            GL_POLYGON_OFFSET_LINE,
                            GL_POLYGON_OFFSET_POINT,
                            GL_POLYGON_SMOOTH,
                            GL_PRIMITIVE_RESTART,
                            GL_PROGRAM_POINT_SIZE,
                            GL_RASTERIZER_DISCARD,
                            GL_SAMPLE_ALPHA_TO_COVERAGE,
                            GL_SAMPLE_ALPHA_TO_ONE,
                            GL_SAMPLE_COVERAGE,
                            GL_SAMPLE_MASK,
                            GL_SCISSOR_TEST,
                            GL_STENCIL_TEST,
                            GL_TEXTURE_CUBE_MAP_SEAMLESS};
  if (since(43)) names.push_back(GL_PRIMITIVE_RESTART_FIXED_INDEX);
  for (GLuint i = 0; i < object(GL_MAX_CLIP_DISTANCES); ++i) names.push_back(GL_CLIP_DISTANCE0 + i);
  for (const GLenum name : names)
    undo_.emplace_back([name, on = glIsEnabled(name)] { on ? glEnable(name) : glDisable(name); });
  for (GLuint i = 0; i < object(GL_MAX_DRAW_BUFFERS); ++i) {
    std::array<GLboolean, 4> mask{};
    glGetBooleani_v(GL_COLOR_WRITEMASK, i, mask.data());
    undo_.emplace_back([i, mask, on = glIsEnabledi(GL_BLEND, i)] {
      glColorMaski(i, mask[0], mask[1], mask[2], mask[3]);
      on ? glEnablei(GL_BLEND, i) : glDisablei(GL_BLEND, i);
    });
    if (!since(40)) continue;
    std::array<GLenum, 6> blend{GL_BLEND_EQUATION_RGB, GL_BLEND_EQUATION_ALPHA, GL_BLEND_SRC_RGB,
                                GL_BLEND_DST_RGB,      GL_BLEND_SRC_ALPHA,      GL_BLEND_DST_ALPHA};
    for (GLenum& name : blend) {
      GLint value = 0;
      glGetIntegeri_v(name, i, &value);
      name = static_cast<GLenum>(value);
    }
    undo_.emplace_back([i, blend] {
      glBlendEquationSeparatei(i, blend[0], blend[1]);
      glBlendFuncSeparatei(i, blend[2], blend[3], blend[4], blend[5]);
    });
  }
}

void KeptState::keep_values() {
  const auto keep = [this](auto&& value, auto&& set) { undo_.emplace_back([value, set] { set(value); }); };
  keep(integers<4>(GL_VIEWPORT), [](const auto& v) { glViewport(v[0], v[1], v[2], v[3]); });
  keep(integers<4>(GL_SCISSOR_BOX), [](const auto& v) { glScissor(v[0], v[1], v[2], v[3]); });
  keep(floats<2>(GL_DEPTH_RANGE), [](const auto& v) { glDepthRange(v[0], v[1]); });
  keep(floats<4>(GL_BLEND_COLOR), [](const auto& v) { glBlendColor(v[0], v[1], v[2], v[3]); });
  keep(std::array{mode(GL_BLEND_EQUATION_RGB), mode(GL_BLEND_EQUATION_ALPHA)},
       [](const auto& v) { glBlendEquationSeparate(v[0], v[1]); });
  keep(std::array{mode(GL_BLEND_SRC_RGB), mode(GL_BLEND_DST_RGB), mode(GL_BLEND_SRC_ALPHA),
                  mode(GL_BLEND_DST_ALPHA)},
       [](const auto& v) { glBlendFuncSeparate(v[0], v[1], v[2], v[3]); });
  keep(floats<4>(GL_COLOR_CLEAR_VALUE), [](const auto& v) { glClearColor(v[0], v[1], v[2], v[3]); });
  keep(floats<1>(GL_DEPTH_CLEAR_VALUE), [](const auto& v) { glClearDepth(v[0]); });
  keep(mode(GL_DEPTH_FUNC), [](GLenum v) { glDepthFunc(v); });
  keep(integer(GL_DEPTH_WRITEMASK), [](GLint v) { glDepthMask(v != 0 ? GL_TRUE : GL_FALSE); });
  keep(mode(GL_CULL_FACE_MODE), [](GLenum v) { glCullFace(v); });
  keep(mode(GL_FRONT_FACE), [](GLenum v) { glFrontFace(v); });
  keep(mode(GL_LOGIC_OP_MODE), [](GLenum v) { glLogicOp(v); });
  keep(mode(GL_PROVOKING_VERTEX), [](GLenum v) { glProvokingVertex(v); });
  // Two numbers of compatibility contexts, which are equal in others.
  keep(integers<2>(GL_POLYGON_MODE),
       [](const auto& v) { glPolygonMode(GL_FRONT_AND_BACK, static_cast<GLenum>(v[0])); });
  keep(std::array{floats<1>(GL_POLYGON_OFFSET_FACTOR)[0], floats<1>(GL_POLYGON_OFFSET_UNITS)[0]},
       [](const auto& v) { glPolygonOffset(v[0], v[1]); });
  keep(floats<1>(GL_LINE_WIDTH), [](const auto& v) { glLineWidth(v[0]); });
  keep(floats<1>(GL_POINT_SIZE), [](const auto& v) { glPointSize(v[0]); });
  keep(object(GL_PRIMITIVE_RESTART_INDEX), [](GLuint v) { glPrimitiveRestartIndex(v); });
  keep(std::pair(floats<1>(GL_SAMPLE_COVERAGE_VALUE)[0], integer(GL_SAMPLE_COVERAGE_INVERT)),
       [](const auto& v) { glSampleCoverage(v.first, v.second != 0 ? GL_TRUE : GL_FALSE); });
  GLint mask = 0;
  glGetIntegeri_v(GL_SAMPLE_MASK_VALUE, 0, &mask);
  keep(mask, [](GLint v) { glSampleMaski(0, static_cast<GLbitfield>(v)); });
  for (const GLenum name :
       {GL_PACK_SWAP_BYTES, GL_PACK_LSB_FIRST, GL_PACK_ROW_LENGTH, GL_PACK_IMAGE_HEIGHT, GL_PACK_SKIP_ROWS,
        GL_PACK_SKIP_PIXELS, GL_PACK_SKIP_IMAGES, GL_PACK_ALIGNMENT, GL_UNPACK_SWAP_BYTES,
        GL_UNPACK_LSB_FIRST, GL_UNPACK_ROW_LENGTH, GL_UNPACK_IMAGE_HEIGHT, GL_UNPACK_SKIP_ROWS,
        GL_UNPACK_SKIP_PIXELS, GL_UNPACK_SKIP_IMAGES, GL_UNPACK_ALIGNMENT})
    keep(integer(name), [name](GLint v) { glPixelStorei(name, v); });
}

void KeptState::keep_stencil() {
  struct Side {
    GLenum side, function, reference, mask, write, fail, depth_fail, pass;
  };
  static constexpr std::array kSides{
      Side{GL_FRONT, GL_STENCIL_FUNC, GL_STENCIL_REF, GL_STENCIL_VALUE_MASK, GL_STENCIL_WRITEMASK,
           GL_STENCIL_FAIL, GL_STENCIL_PASS_DEPTH_FAIL, GL_STENCIL_PASS_DEPTH_PASS},
      Side{GL_BACK, GL_STENCIL_BACK_FUNC, GL_STENCIL_BACK_REF, GL_STENCIL_BACK_VALUE_MASK,
           GL_STENCIL_BACK_WRITEMASK, GL_STENCIL_BACK_FAIL, GL_STENCIL_BACK_PASS_DEPTH_FAIL,
           GL_STENCIL_BACK_PASS_DEPTH_PASS}};
  for (const Side& s : kSides)
    undo_.emplace_back([side = s.side, function = mode(s.function), reference = integer(s.reference),
                        mask = object(s.mask), write = object(s.write), fail = mode(s.fail),
                        depth_fail = mode(s.depth_fail), pass = mode(s.pass)] {
      glStencilFuncSeparate(side, function, reference, mask);
      glStencilMaskSeparate(side, write);
      glStencilOpSeparate(side, fail, depth_fail, pass);
    });
  undo_.emplace_back([value = integer(GL_STENCIL_CLEAR_VALUE)] { glClearStencil(value); });
}

}  // namespace sconce::gpu
