// SPDX-License-Identifier: Apache-2.0
#include "gpu/seen_surfaces.h"

namespace sconce::gpu {

namespace {

constexpr std::string_view kSurfaces =
#include "gpu/seen_surfaces.glsl.h"
    ;
constexpr int kGroup = 8;  // its sides

}  // namespace

std::string_view octahedral_glsl() {
  return
#include "gpu/octahedral.glsl.h"
      ;
}

std::string SeenSurfaces::glsl() {
  return std::string(octahedral_glsl()) + std::string(kSurfaces);
}

void SeenSurfaces::shade(const Program& program, const Texture& picture) const {
  int unit = 0;
  for (const Texture* texture : {&depth, &surfaces, &materials}) texture->bind(unit++);
  unit = 0;
  for (const char* name : {"sconce_depth", "sconce_surfaces", "sconce_materials"}) program.set(name, unit++);
  if (mapped != nullptr) mapped->bind(unit);
  program.set("sconce_mapped", unit);
  program.set("sconce_normal_maps", mapped == nullptr ? 0 : directional ? 2 : 1);
  program.set("sconce_seen_from", lens.eye()), program.set("sconce_seen_plane", lens.plane());
  program.set("sconce_seen_shift", shift);
  glBindImageTexture(0, picture.handle(), 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA32F);
  const TextureParams& size = picture.params();
  glDispatchCompute(static_cast<GLuint>((size.width + kGroup - 1) / kGroup),
                    static_cast<GLuint>((size.height + kGroup - 1) / kGroup), 1);
  glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT |
                  GL_FRAMEBUFFER_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
}

}  // namespace sconce::gpu
