// SPDX-License-Identifier: Apache-2.0
// For tests only: a context, and shaders run over a list of colours.
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "gpu/framebuffer.h"
#include "gpu/program.h"

namespace sconce::gpu {

class GlTest : public testing::Test {
 protected:
  /// color -> the shader's vec3 apply(vec3 color), computed by OpenGL.
  /// @param functions  GLSL that defines it
  /// @param units      of textures that they read
  std::vector<Rgb> apply(const std::string& functions, const std::vector<Rgb>& colors,
                         const std::vector<std::pair<const char*, int>>& units = {}) const {
    constexpr int kWidth = 1024;
    const int rows = (static_cast<int>(colors.size()) + kWidth - 1) / kWidth;
    std::vector<Rgb> padded = colors;
    padded.resize(static_cast<std::size_t>(rows) * kWidth);
    const Texture in(context_, {.format = GL_RGB32F, .width = kWidth, .height = rows}, "colours");
    in.upload(GL_RGB, GL_FLOAT, padded.data());
    const Texture out(context_, {.format = GL_RGBA32F, .width = kWidth, .height = rows}, "results");
    const Framebuffer target(out, 0);
    const Program program("test", whole_target_vertex(), "#version 450 core\n" + functions + R"(
      uniform sampler2D colors;
      out vec4 result;
      void main() { result = vec4(apply(texelFetch(colors, ivec2(gl_FragCoord.xy), 0).rgb), 1.0); }
    )");
    GLuint nothing = 0;
    glCreateVertexArrays(1, &nothing);
    glBindVertexArray(nothing);
    program.use();
    program.set("colors", 0);
    for (const auto& [uniform, unit] : units) program.set(uniform, unit);
    in.bind(0);
    target.use();
    glDrawArrays(GL_TRIANGLES, 0, 3);
    target.read(GL_RGB, GL_FLOAT, padded.data());
    glDeleteVertexArrays(1, &nothing);
    context_.check("running a test's shader");
    padded.resize(colors.size());
    return padded;
  }

  Context context_;
};

}  // namespace sconce::gpu
