// SPDX-License-Identifier: Apache-2.0
#include "gpu/texture.h"

#include "core/error.h"

namespace sconce::gpu {

Texture::Texture(const Context& context, const TextureParams& params, const std::string& what)
    : params_(params) {
  const Capabilities& can = context.capabilities();
  if (params.width > can.max_texture_size || params.height > can.max_texture_size)
    throw Error(what,
                std::to_string(params.width) + " x " + std::to_string(params.height) + " is too large for " +
                    can.renderer,
                "up to " + std::to_string(can.max_texture_size));
  if (params.layers > can.max_array_layers)
    throw Error(what, std::to_string(params.layers) + " layers are too many for " + can.renderer,
                "up to " + std::to_string(can.max_array_layers));
  glCreateTextures(params.layers > 0 ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D, 1, &handle_);
  if (params.layers > 0)
    glTextureStorage3D(handle_, 1, params.format, params.width, params.height, params.layers);
  else
    glTextureStorage2D(handle_, 1, params.format, params.width, params.height);
  glTextureParameteri(handle_, GL_TEXTURE_MIN_FILTER, static_cast<GLint>(params.filter));
  glTextureParameteri(handle_, GL_TEXTURE_MAG_FILTER, static_cast<GLint>(params.filter));
  glTextureParameteri(handle_, GL_TEXTURE_WRAP_S, static_cast<GLint>(params.wrap_u));
  glTextureParameteri(handle_, GL_TEXTURE_WRAP_T, static_cast<GLint>(params.wrap_v));
}

void Texture::upload(GLenum format, GLenum type, const void* pixels, int layer) const {
  if (params_.layers > 0)
    glTextureSubImage3D(handle_, 0, 0, 0, layer, params_.width, params_.height, 1, format, type, pixels);
  else
    glTextureSubImage2D(handle_, 0, 0, 0, params_.width, params_.height, format, type, pixels);
}

void Texture::upload_blocks(const void* blocks, std::size_t bytes, int layer) const {
  const auto size = static_cast<GLsizei>(bytes);
  if (params_.layers > 0)
    glCompressedTextureSubImage3D(handle_, 0, 0, 0, layer, params_.width, params_.height, 1, params_.format,
                                  size, blocks);
  else
    glCompressedTextureSubImage2D(handle_, 0, 0, 0, params_.width, params_.height, params_.format, size,
                                  blocks);
}

}  // namespace sconce::gpu
