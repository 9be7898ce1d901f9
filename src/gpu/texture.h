// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <epoxy/gl.h>

#include <string>
#include <utility>

#include "gpu/context.h"

namespace sconce::gpu {

struct TextureParams {
  GLenum format = GL_RGBA32F;
  int width = 1, height = 1;
  int layers = 0;  ///< 0 = a plain two-dimensional texture, else an array
  GLenum filter = GL_LINEAR;
  GLenum wrap_u = GL_CLAMP_TO_EDGE, wrap_v = GL_CLAMP_TO_EDGE;
};

/// One mip level: charts must not run into each other, and pictures look up LOD 0.
class Texture {
 public:
  /// @param what  for messages
  /// @throws Error when it is larger than the device allows
  Texture(const Context& context, const TextureParams& params, const std::string& what);
  ~Texture() { glDeleteTextures(1, &handle_); }
  Texture(Texture&& other) noexcept : handle_(std::exchange(other.handle_, 0)), params_(other.params_) {}
  Texture(const Texture&) = delete;
  Texture& operator=(const Texture&) = delete;

  /// The whole of one layer. @param pixels  rows from the first one on, tightly packed
  void upload(GLenum format, GLenum type, const void* pixels, int layer = 0) const;
  /// The same for block formats. @param bytes  of the layer
  void upload_blocks(const void* blocks, std::size_t bytes, int layer = 0) const;
  void bind(int unit) const { glBindTextureUnit(static_cast<GLuint>(unit), handle_); }

  GLuint handle() const { return handle_; }
  const TextureParams& params() const { return params_; }

 private:
  GLuint handle_ = 0;
  TextureParams params_;
};

}  // namespace sconce::gpu
