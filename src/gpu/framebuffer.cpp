// SPDX-License-Identifier: Apache-2.0
#include "gpu/framebuffer.h"

#include "core/error.h"

namespace sconce::gpu {

Framebuffer::Framebuffer(const Texture& color, int layer, const Texture* depth)
    : width_(color.params().width), height_(color.params().height), has_depth_(depth != nullptr) {
  glCreateFramebuffers(1, &handle_);
  if (color.params().layers > 0)
    glNamedFramebufferTextureLayer(handle_, GL_COLOR_ATTACHMENT0, color.handle(), 0, layer);
  else
    glNamedFramebufferTexture(handle_, GL_COLOR_ATTACHMENT0, color.handle(), 0);
  if (depth != nullptr) glNamedFramebufferTexture(handle_, GL_DEPTH_ATTACHMENT, depth->handle(), 0);
  const GLenum status = glCheckNamedFramebufferStatus(handle_, GL_FRAMEBUFFER);
  if (status == GL_FRAMEBUFFER_COMPLETE) return;
  glDeleteFramebuffers(1, &handle_);
  throw Error("OpenGL", "this device cannot draw to a texture of " + std::to_string(width_) + " x " +
                            std::to_string(height_) + " (status " + std::to_string(status) + ")");
}

void Framebuffer::use() const {
  glBindFramebuffer(GL_FRAMEBUFFER, handle_);
  glViewport(0, 0, width_, height_);
}

void Framebuffer::clear() const {
  const float zero[4] = {0, 0, 0, 0};
  glClearNamedFramebufferfv(handle_, GL_COLOR, 0, zero);
  if (has_depth_) glClearNamedFramebufferfv(handle_, GL_DEPTH, 0, zero);
}

void Framebuffer::read(GLenum format, GLenum type, void* pixels) const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, handle_);
  glReadPixels(0, 0, width_, height_, format, type, pixels);
}

}  // namespace sconce::gpu
