// SPDX-License-Identifier: Apache-2.0
#include "gpu/context.h"

#include <fmt/format.h>

#include <regex>

#include "core/error.h"
#include "gpu/display.h"

namespace sconce::gpu {

struct Context::State {
  Display display;
  EGLContext context = EGL_NO_CONTEXT;
  Capabilities capabilities;
  std::string complaint;

  ~State() {
    if (context == EGL_NO_CONTEXT) return;
    eglMakeCurrent(display.handle, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display.handle, context);
  }
};

namespace {

EGLContext make_context(EGLDisplay display, bool debug) {
  if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) return EGL_NO_CONTEXT;
  // No surface is ever drawn to, so the config matters to drivers without EGL_KHR_no_config_context alone.
  const EGLint wanted[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint found = 0;
  if (eglChooseConfig(display, wanted, &config, 1, &found) != EGL_TRUE || found == 0) config = nullptr;
  EGLContext context = EGL_NO_CONTEXT;
  for (const bool robust : {true, false}) {
    const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION, 4, EGL_CONTEXT_MINOR_VERSION, 5,
                                 EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                 EGL_CONTEXT_OPENGL_DEBUG, debug ? EGL_TRUE : EGL_FALSE,
                                 // The end of the list, where a lost context is not to be told.
                                 robust ? EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY : EGL_NONE,
                                 EGL_LOSE_CONTEXT_ON_RESET, EGL_NONE};
    context = eglCreateContext(display, config, EGL_NO_CONTEXT, attributes);
    if (context != EGL_NO_CONTEXT) break;
  }
  return context;
}

bool renders(GLenum format) {
  GLint supported = GL_NONE;
  glGetInternalformativ(GL_TEXTURE_2D, format, GL_FRAMEBUFFER_RENDERABLE, 1, &supported);
  return supported == GL_FULL_SUPPORT;
}

bool filters(GLenum format) {
  GLint supported = GL_NONE;
  glGetInternalformativ(GL_TEXTURE_2D, format, GL_FILTER, 1, &supported);
  return supported == GL_FULL_SUPPORT;
}

Capabilities ask(bool software) {
  Capabilities c;
  c.renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  c.version = reinterpret_cast<const char*>(glGetString(GL_VERSION));
  c.software = software;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &c.max_texture_size);
  glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &c.max_array_layers);
  glGetIntegerv(GL_MAX_TEXTURE_IMAGE_UNITS, &c.max_units);
  GLint64 buffer = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &buffer);
  c.max_buffer = static_cast<std::size_t>(buffer);
  c.float_linear = filters(GL_RGBA32F);
  c.float_target = renders(GL_RGBA32F);
  c.half_target = renders(GL_RGBA16F);
  c.bc6h = filters(GL_COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT);
  return c;
}

void EPOXY_CALLSPEC on_message(GLenum, GLenum type, GLuint, GLenum, GLsizei, const GLchar* message,
                               const void* user) {
  std::string& complaint = *static_cast<std::string*>(const_cast<void*>(user));
  if (type == GL_DEBUG_TYPE_ERROR && complaint.empty()) complaint = message;
}

void explain_errors(std::string& complaint) {
  glEnable(GL_DEBUG_OUTPUT);
  glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  glDebugMessageCallback(on_message, &complaint);
}

void pack_tightly() {
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
}

}  // namespace

Context::Context(std::unique_ptr<State> state) : state_(std::move(state)) {}

std::unique_ptr<Context> Context::adopt(bool debug) {
  if (epoxy_gl_version() < 45)
    throw Error("OpenGL",
                fmt::format("this window has OpenGL {}.{}", epoxy_gl_version() / 10, epoxy_gl_version() % 10),
                "4.5 or newer");
  auto state = std::make_unique<State>();
  if (debug) explain_errors(state->complaint);
  pack_tightly();
  // Mesa's names for drawing by the processor; GLX does not tell.
  static const std::regex software("llvmpipe|softpipe|swrast", std::regex::icase);
  state->capabilities =
      ask(std::regex_search(reinterpret_cast<const char*>(glGetString(GL_RENDERER)), software));
  return std::unique_ptr<Context>(new Context(std::move(state)));
}

Context::Context(const ContextParams& params) : state_(std::make_unique<State>()) {
  State& s = *state_;
  for (Display& display : open_displays(params.hardware_only)) {
    s.display = std::move(display);
    s.context = make_context(s.display.handle, params.debug);
    if (s.context != EGL_NO_CONTEXT &&
        eglMakeCurrent(s.display.handle, EGL_NO_SURFACE, EGL_NO_SURFACE, s.context) == EGL_TRUE)
      break;
    if (s.context != EGL_NO_CONTEXT) eglDestroyContext(s.display.handle, s.context);
    s.context = EGL_NO_CONTEXT;
  }
  if (s.context == EGL_NO_CONTEXT)
    throw Error("OpenGL", params.hardware_only ? "there is no graphics device with OpenGL 4.5"
                                               : "there is no OpenGL 4.5 on this machine");
  if (params.debug) explain_errors(s.complaint);
  pack_tightly();
  s.capabilities = ask(s.display.software);
}

Context::~Context() = default;

const Capabilities& Context::capabilities() const {
  return state_->capabilities;
}

void Context::pretend(const Capabilities& capabilities) {
  state_->capabilities = capabilities;
}

void Context::check(const std::string& doing) const {
  if (glGetGraphicsResetStatus() != GL_NO_ERROR)
    throw Error("OpenGL", "the graphics device was lost (reset or removed) while " + doing);
  const GLenum code = glGetError();
  const std::string complaint = std::exchange(state_->complaint, {});
  if (code == GL_OUT_OF_MEMORY) throw Error("OpenGL", "out of graphics memory while " + doing);
  if (code != GL_NO_ERROR || !complaint.empty())
    throw Error("OpenGL", "error " + std::to_string(code) + " while " + doing +
                              (complaint.empty() ? "" : ": " + complaint));
}

}  // namespace sconce::gpu
