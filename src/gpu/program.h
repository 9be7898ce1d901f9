// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <epoxy/gl.h>

#include <string>
#include <string_view>
#include <vector>

#include "core/rgb.h"
#include "core/vec.h"

namespace sconce::gpu {

/// A linked shader program.
class Program {
 public:
  /// @param name  what the shaders do, for messages
  /// @throws Error that shows the compiler's message and the line it speaks of
  Program(const std::string& name, std::string_view vertex, std::string_view fragment);
  /// A compute program.
  Program(const std::string& name, std::string_view compute);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  void use() const { glUseProgram(handle_); }
  /// Uniforms that the compiler left out are ignored.
  void set(const char* uniform, int value) const { glProgramUniform1i(handle_, at(uniform), value); }
  void set(const char* uniform, float value) const { glProgramUniform1f(handle_, at(uniform), value); }
  void set(const char* uniform, Vec2 v) const { glProgramUniform2f(handle_, at(uniform), v.x, v.y); }
  void set(const char* uniform, const Vec3& v) const {
    glProgramUniform3f(handle_, at(uniform), v.x, v.y, v.z);
  }
  void set(const char* uniform, const Rgb& c) const {
    glProgramUniform3f(handle_, at(uniform), c.r, c.g, c.b);
  }
  void set(const char* uniform, const std::vector<Rgb>& all) const {
    glProgramUniform3fv(handle_, at(uniform), static_cast<GLsizei>(all.size()), &all.front().r);
  }
  void set(const char* uniform, const Mat3& m) const {
    glProgramUniformMatrix3fv(handle_, at(uniform), 1, GL_FALSE, &m[0][0]);
  }

 private:
  GLint at(const char* uniform) const { return glGetUniformLocation(handle_, uniform); }
  void link(const std::string& name) const;

  GLuint handle_;
};

/// A vertex shader that fills the target by one triangle, to draw with three vertices and no buffers.
std::string_view whole_target_vertex();

}  // namespace sconce::gpu
