// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/texture.h"

namespace sconce::gpu {

/// A texture to draw to. Row 0 of the texture is the picture's top row.
class Framebuffer {
 public:
  /// @param layer  of an array
  /// @param depth  may be null
  /// @throws Error when the device cannot draw to such textures
  Framebuffer(const Texture& color, int layer, const Texture* depth = nullptr);
  ~Framebuffer() { glDeleteFramebuffers(1, &handle_); }
  Framebuffer(const Framebuffer&) = delete;
  Framebuffer& operator=(const Framebuffer&) = delete;

  /// Draws go here, to all of it.
  void use() const;
  /// Colour becomes 0, depth 0 (infinitely far, see Picture).
  void clear() const;
  /// Reads width x height pixels back, tightly packed. @param pixels  of that size
  void read(GLenum format, GLenum type, void* pixels) const;

 private:
  GLuint handle_ = 0;
  int width_, height_;
  bool has_depth_;
};

}  // namespace sconce::gpu
