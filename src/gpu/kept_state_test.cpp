// SPDX-License-Identifier: Apache-2.0
#include "gpu/kept_state.h"

#include <epoxy/egl.h>

#include <cmath>
#include <map>
#include <string>

#include "core/error.h"
#include "gpu/test_context.h"

namespace sconce::gpu {
namespace {

/// What OpenGL says of itself, by another list than the library's.
std::map<std::string, double> snapshot() {
  std::map<std::string, double> all;
#define NUMBERS(name, count)                                                      \
  {                                                                               \
    GLdouble values[4]{};                                                         \
    glGetDoublev(name, values);                                                   \
    for (int i = 0; i < (count); ++i) all[#name + std::to_string(i)] = values[i]; \
  }
#define NUMBER(name) NUMBERS(name, 1)
  NUMBER(GL_DRAW_FRAMEBUFFER_BINDING)
  NUMBER(GL_READ_FRAMEBUFFER_BINDING) NUMBER(GL_RENDERBUFFER_BINDING) NUMBER(GL_CURRENT_PROGRAM) NUMBER(
      GL_VERTEX_ARRAY_BINDING) NUMBER(GL_ARRAY_BUFFER_BINDING) NUMBER(GL_ELEMENT_ARRAY_BUFFER_BINDING)
      NUMBER(GL_UNIFORM_BUFFER_BINDING) NUMBER(GL_PIXEL_PACK_BUFFER_BINDING) NUMBER(
          GL_PIXEL_UNPACK_BUFFER_BINDING) NUMBER(GL_ACTIVE_TEXTURE) NUMBERS(GL_VIEWPORT, 4)
          NUMBERS(GL_SCISSOR_BOX, 4) NUMBERS(GL_DEPTH_RANGE, 2) NUMBERS(GL_COLOR_CLEAR_VALUE, 4) NUMBER(
              GL_DEPTH_CLEAR_VALUE) NUMBER(GL_STENCIL_CLEAR_VALUE) NUMBERS(GL_COLOR_WRITEMASK, 4)
              NUMBER(GL_DEPTH_WRITEMASK) NUMBER(GL_DEPTH_FUNC) NUMBER(GL_CULL_FACE_MODE) NUMBER(
                  GL_FRONT_FACE) NUMBER(GL_POLYGON_MODE) NUMBER(GL_POLYGON_OFFSET_FACTOR)
                  NUMBER(GL_LINE_WIDTH) NUMBER(GL_LOGIC_OP_MODE) NUMBER(GL_PROVOKING_VERTEX) NUMBERS(
                      GL_BLEND_COLOR, 4) NUMBER(GL_BLEND_EQUATION_RGB) NUMBER(GL_BLEND_EQUATION_ALPHA)
                      NUMBER(GL_BLEND_SRC_RGB) NUMBER(GL_BLEND_DST_RGB) NUMBER(GL_BLEND_SRC_ALPHA)
                          NUMBER(GL_BLEND_DST_ALPHA) NUMBER(GL_STENCIL_FUNC) NUMBER(GL_STENCIL_REF) NUMBER(
                              GL_STENCIL_WRITEMASK) NUMBER(GL_STENCIL_FAIL) NUMBER(GL_STENCIL_BACK_FUNC)
                              NUMBER(GL_STENCIL_BACK_PASS_DEPTH_PASS) NUMBER(GL_PACK_ALIGNMENT) NUMBER(
                                  GL_PACK_ROW_LENGTH) NUMBER(GL_UNPACK_ALIGNMENT) NUMBER(GL_UNPACK_SKIP_ROWS)
                                  NUMBER(GL_SAMPLE_COVERAGE_VALUE) NUMBER(GL_BLEND) NUMBER(GL_CULL_FACE)
                                      NUMBER(GL_DEPTH_TEST) NUMBER(GL_SCISSOR_TEST) NUMBER(GL_STENCIL_TEST)
                                          NUMBER(GL_DITHER) NUMBER(GL_MULTISAMPLE) NUMBER(GL_FRAMEBUFFER_SRGB)
                                              NUMBER(GL_POLYGON_OFFSET_FILL) NUMBER(GL_RASTERIZER_DISCARD)
                                                  NUMBER(GL_DEPTH_CLAMP) NUMBER(GL_COLOR_LOGIC_OP)
                                                      NUMBER(GL_CLIP_DISTANCE2) NUMBER(GL_PROGRAM_POINT_SIZE)
#undef NUMBER
#undef NUMBERS
                                                          const auto per_index =
                                                              [&](const char* label, GLenum name, GLuint i) {
                                                                GLint value = 0;
                                                                glGetIntegeri_v(name, i, &value);
                                                                all[label + std::to_string(i)] = value;
                                                              };
  for (const GLuint i : {0u, 1u, 3u}) {
    per_index("uniform buffer ", GL_UNIFORM_BUFFER_BINDING, i);
    per_index("storage buffer ", GL_SHADER_STORAGE_BUFFER_BINDING, i);
    per_index("texture 2d ", GL_TEXTURE_BINDING_2D, i);
    per_index("texture array ", GL_TEXTURE_BINDING_2D_ARRAY, i);
    per_index("sampler ", GL_SAMPLER_BINDING, i);
    per_index("source ", GL_BLEND_SRC_RGB, i);
    all["blend " + std::to_string(i)] = glIsEnabledi(GL_BLEND, i);
  }
  return all;
}

class KeptStates : public GlTest {
 protected:
  KeptStates() {
    glGenTextures(2, textures_), glGenBuffers(2, buffers_), glGenSamplers(1, &sampler_);
    glGenVertexArrays(2, arrays_), glGenFramebuffers(2, framebuffers_), glGenRenderbuffers(1, &renderbuffer_);
    // The host's state, nothing of which is a default.
    glBindTexture(GL_TEXTURE_2D, textures_[0]);
    glBindVertexArray(arrays_[0]);
    glBindBuffer(GL_ARRAY_BUFFER, buffers_[0]);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers_[0]);
    glBufferData(GL_ARRAY_BUFFER, 1024, nullptr, GL_STATIC_DRAW);
    glBindBufferRange(GL_UNIFORM_BUFFER, 1, buffers_[0], 256, 128);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffers_[0]);
    glViewport(1, 2, 3, 4);
    glClearColor(0.1f, 0.2f, 0.3f, 0.4f);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_CULL_FACE);
    glEnablei(GL_BLEND, 1);
    glBlendFunci(1, GL_ONE, GL_ONE);
    glDepthMask(GL_FALSE);
    glPixelStorei(GL_PACK_ALIGNMENT, 2);
  }

  /// A host's drawing that leaves nothing as it was.
  void change_everything() const {
    for (const GLuint unit : {0u, 1u, 3u}) {
      glActiveTexture(GL_TEXTURE0 + unit);
      glBindTexture(GL_TEXTURE_2D, textures_[1]);
      glBindSampler(unit, sampler_);
      glBindBufferBase(GL_UNIFORM_BUFFER, unit, buffers_[1]);
      glBindBufferBase(GL_SHADER_STORAGE_BUFFER, unit, buffers_[1]);
    }
    glUseProgram(program_.name());
    glBindVertexArray(arrays_[1]);
    for (const GLenum target : {GL_ARRAY_BUFFER, GL_ELEMENT_ARRAY_BUFFER, GL_PIXEL_PACK_BUFFER,
                                GL_PIXEL_UNPACK_BUFFER, GL_UNIFORM_BUFFER})
      glBindBuffer(target, buffers_[1]);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffers_[1]);
    glBindRenderbuffer(GL_RENDERBUFFER, renderbuffer_);
    for (const GLenum name :
         {GL_BLEND, GL_SCISSOR_TEST, GL_STENCIL_TEST, GL_FRAMEBUFFER_SRGB, GL_POLYGON_OFFSET_FILL,
          GL_RASTERIZER_DISCARD, GL_DEPTH_CLAMP, GL_COLOR_LOGIC_OP, GL_CLIP_DISTANCE2, GL_PROGRAM_POINT_SIZE})
      glEnable(name);
    for (const GLenum name : {GL_DEPTH_TEST, GL_CULL_FACE, GL_DITHER, GL_MULTISAMPLE}) glDisable(name);
    glViewport(10, 20, 30, 40), glScissor(5, 6, 7, 8), glDepthRange(0.25, 0.75);
    glClearColor(1, 1, 1, 0), glClearDepth(0.5), glClearStencil(3);
    glColorMask(GL_FALSE, GL_TRUE, GL_FALSE, GL_FALSE), glDepthMask(GL_TRUE), glDepthFunc(GL_ALWAYS);
    glCullFace(GL_FRONT), glFrontFace(GL_CW), glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    glPolygonOffset(2, 3), glLogicOp(GL_XOR), glProvokingVertex(GL_FIRST_VERTEX_CONVENTION);
    glBlendColor(1, 1, 0, 0), glBlendEquationSeparate(GL_MAX, GL_MIN);
    glBlendFuncSeparate(GL_DST_COLOR, GL_SRC_COLOR, GL_ONE, GL_ONE);
    glStencilFunc(GL_NEVER, 7, 8), glStencilMask(9), glStencilOp(GL_INVERT, GL_INCR, GL_DECR);
    glPixelStorei(GL_PACK_ALIGNMENT, 8), glPixelStorei(GL_PACK_ROW_LENGTH, 99);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1), glPixelStorei(GL_UNPACK_SKIP_ROWS, 5);
    glSampleCoverage(0.5f, GL_TRUE);
  }

  struct Linked {
    Program program{"nothing", whole_target_vertex(), "#version 450 core\nvoid main() {}\n"};
    GLuint name() const {
      program.use();
      GLint name = 0;
      glGetIntegerv(GL_CURRENT_PROGRAM, &name);
      return static_cast<GLuint>(name);
    }
  };
  Linked program_;
  GLuint textures_[2]{}, buffers_[2]{}, arrays_[2]{}, framebuffers_[2]{}, sampler_ = 0, renderbuffer_ = 0;
};

TEST_F(KeptStates, EverythingIsAsItWas) {
  const auto before = snapshot();
  const int answer = keep_state([&] {
    change_everything();
    const auto changed = snapshot();
    std::size_t different = 0;
    for (const auto& [name, value] : before) different += changed.at(name) != value ? 1 : 0;
    EXPECT_GT(different, 75u) << "of " << before.size() << ": the test changes too little";
    return 7;
  });
  EXPECT_EQ(answer, 7);
  EXPECT_EQ(snapshot(), before);
  GLint64 start = 0;
  glGetInteger64i_v(GL_UNIFORM_BUFFER_START, 1, &start);
  EXPECT_EQ(start, 256);
  context_.check("putting the state back");
}

TEST_F(KeptStates, AlsoAfterAnException) {
  const auto before = snapshot();
  EXPECT_THROW(keep_state([&]() -> int {
                 change_everything();
                 throw std::runtime_error("out of memory");
               }),
               std::runtime_error);
  EXPECT_EQ(snapshot(), before);
}

TEST_F(KeptStates, AContextThatIsGoneIsAnError) {
  const EGLDisplay display = eglGetCurrentDisplay();
  const EGLContext context = eglGetCurrentContext();
  try {
    keep_state([&] { return eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); });
    ADD_FAILURE() << "no error";
  } catch (const Error& e) {
    EXPECT_STREQ(e.what(),
                 "the OpenGL context: is lost, or another one was made current (allowed: the one that there "
                 "was before)");
  }
  ASSERT_EQ(eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context), EGL_TRUE);
  const auto before = snapshot();
  keep_state([&] {
    change_everything();
    return 0;
  });
  EXPECT_EQ(snapshot(), before);
}

}  // namespace
}  // namespace sconce::gpu
