// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "gpu/texture.h"

namespace sconce::gpu {

/// Textures to draw to. Row 0 of a texture is the picture's top row.
class Framebuffer {
 public:
  /// @param layer  of an array
  /// @param depth  may be null
  /// @param more   of the same size, for a shader's further outputs
  /// @throws Error when the device cannot draw to such textures
  Framebuffer(const Texture& color, int layer, const Texture* depth = nullptr,
              std::span<const Texture* const> more = {});
  struct DepthOnly {};
  Framebuffer(DepthOnly, const Texture& depths, int layer);
  /// All layers of an array: shaders choose theirs.
  Framebuffer(DepthOnly, const Texture& depths);
  ~Framebuffer() { glDeleteFramebuffers(1, &handle_); }
  Framebuffer(const Framebuffer&) = delete;
  Framebuffer& operator=(const Framebuffer&) = delete;

  /// Draws go here, to all of it.
  void use() const;
  /// The first colour becomes 0, depth 0 (infinitely far, see Picture).
  void clear() const;
  /// Reads width x height pixels of the first colour back, tightly packed. @param pixels  of that size
  void read(GLenum format, GLenum type, void* pixels) const;

 private:
  explicit Framebuffer(const TextureParams& size) : width_(size.width), height_(size.height) {
    glCreateFramebuffers(1, &handle_);
  }
  void attach(GLenum point, const Texture& texture, int layer) const;
  void attach_depth(const Texture& texture, int layer);
  void check() const;
  /// Layers of a texture that are drawn to.
  struct Part {
    GLuint texture = 0;
    int first = 0, layers = 0;
  };
  void clear(const Part& part, GLenum format) const;

  GLuint handle_ = 0;
  int width_, height_;
  Part color_, depth_;
};

}  // namespace sconce::gpu
