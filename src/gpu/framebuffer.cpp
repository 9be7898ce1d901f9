// SPDX-License-Identifier: Apache-2.0
#include "gpu/framebuffer.h"

#include <vector>

#include "core/error.h"

namespace sconce::gpu {

Framebuffer::Framebuffer(const Texture& color, int layer, const Texture* depth,
                         std::span<const Texture* const> more)
    : Framebuffer(color.params()) {
  attach(GL_COLOR_ATTACHMENT0, color, layer);
  color_ = {color.handle(), layer, 1};
  std::vector<GLenum> points{GL_COLOR_ATTACHMENT0};
  for (const Texture* texture : more) {
    points.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(points.size()));
    attach(points.back(), *texture, layer);
  }
  glNamedFramebufferDrawBuffers(handle_, static_cast<GLsizei>(points.size()), points.data());
  if (depth != nullptr) attach_depth(*depth, 0);
  check();
}

Framebuffer::Framebuffer(DepthOnly, const Texture& depths, int layer) : Framebuffer(depths.params()) {
  attach_depth(depths, layer);
  check();
}

Framebuffer::Framebuffer(DepthOnly, const Texture& depths) : Framebuffer(depths.params()) {
  glNamedFramebufferTexture(handle_, GL_DEPTH_ATTACHMENT, depths.handle(), 0);
  depth_ = {depths.handle(), 0, depths.params().layers};
  check();
}

void Framebuffer::attach(GLenum point, const Texture& texture, int layer) const {
  if (texture.params().layers > 0)
    glNamedFramebufferTextureLayer(handle_, point, texture.handle(), 0, layer);
  else
    glNamedFramebufferTexture(handle_, point, texture.handle(), 0);
}

void Framebuffer::attach_depth(const Texture& texture, int layer) {
  attach(GL_DEPTH_ATTACHMENT, texture, layer);
  depth_ = {texture.handle(), layer, 1};
}

void Framebuffer::check() const {
  const GLenum status = glCheckNamedFramebufferStatus(handle_, GL_FRAMEBUFFER);
  if (status == GL_FRAMEBUFFER_COMPLETE) return;
  throw Error("OpenGL", "this device cannot draw to a texture of " + std::to_string(width_) + " x " +
                            std::to_string(height_) + " (status " + std::to_string(status) + ")");
}

void Framebuffer::use() const {
  glBindFramebuffer(GL_FRAMEBUFFER, handle_);
  glViewport(0, 0, width_, height_);
}

// By the textures: on NVIDIA's driver 580 a framebuffer's clear came, now and then, after the draws that
// followed it.
void Framebuffer::clear(const Part& part, GLenum format) const {
  const float zero[4] = {0, 0, 0, 0};
  if (part.texture != 0)
    glClearTexSubImage(part.texture, 0, 0, 0, part.first, width_, height_, part.layers, format, GL_FLOAT,
                       zero);
}

void Framebuffer::clear() const {
  clear(color_, GL_RGBA), clear(depth_, GL_DEPTH_COMPONENT);
}

void Framebuffer::read(GLenum format, GLenum type, void* pixels) const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, handle_);
  glReadPixels(0, 0, width_, height_, format, type, pixels);
}

}  // namespace sconce::gpu
