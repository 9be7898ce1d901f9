// SPDX-License-Identifier: Apache-2.0
#include "gpu/framebuffer.h"

#include <vector>

#include "core/error.h"

namespace sconce::gpu {

Framebuffer::Framebuffer(const Texture& color, int layer, const Texture* depth,
                         std::span<const Texture* const> more)
    : Framebuffer(color.params()) {
  attach(GL_COLOR_ATTACHMENT0, color, layer);
  std::vector<GLenum> points{GL_COLOR_ATTACHMENT0};
  for (const Texture* texture : more) {
    points.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(points.size()));
    attach(points.back(), *texture, layer);
  }
  colors_ = static_cast<int>(points.size());
  glNamedFramebufferDrawBuffers(handle_, colors_, points.data());
  if (depth != nullptr) attach_depth(*depth, 0);
  check();
}

Framebuffer::Framebuffer(DepthOnly, const Texture& depths, int layer) : Framebuffer(depths.params()) {
  attach_depth(depths, layer);
  check();
}

Framebuffer::Framebuffer(DepthOnly, const Texture& depths) : Framebuffer(depths.params()) {
  glNamedFramebufferTexture(handle_, GL_DEPTH_ATTACHMENT, depths.handle(), 0);
  depth_ = depths.handle(), layers_ = depths.params().layers;
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
  depth_ = texture.handle(), layer_ = layer, layers_ = 1;
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

void Framebuffer::clear() const {
  const float zero[4] = {0, 0, 0, 0};
  for (int i = 0; i < colors_; ++i) glClearNamedFramebufferfv(handle_, GL_COLOR, i, zero);
  // By the texture: after a framebuffer's depth was cleared to 0, NVIDIA's driver 580 dropped tiles of
  // triangles that are greater.
  if (depth_ != 0)
    glClearTexSubImage(depth_, 0, 0, 0, layer_, width_, height_, layers_, GL_DEPTH_COMPONENT, GL_FLOAT, zero);
}

void Framebuffer::read(GLenum format, GLenum type, void* pixels) const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, handle_);
  glReadPixels(0, 0, width_, height_, format, type, pixels);
}

}  // namespace sconce::gpu
