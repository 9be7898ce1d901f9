// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <epoxy/gl.h>

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/rgb.h"
#include "core/vec.h"

namespace sconce::gpu {

/// Part of a shader that is somebody else's, told from ours by its lines' numbers (Mesa loses those of source
/// strings): its text comes after `#line kFirstLine`, and what is ours after it counts on.
struct ShaderPart {
  static constexpr std::size_t kFirstLine = 100001;
  std::string file;  ///< for messages
  std::string_view text;
};

/// A uniform that the compiler left in.
struct ActiveUniform {
  std::string name;
  GLenum type;  ///< GL_FLOAT, GL_FLOAT_VEC3, GL_SAMPLER_2D, ...
  int size;     ///< of an array, else 1
};

/// A linked shader program.
class Program {
 public:
  /// @param name  what the shaders do, for messages
  /// @throws Error that shows the compiler's message and the line it speaks of
  Program(const std::string& name, std::string_view vertex, std::string_view fragment);
  Program(const std::string& name, std::string_view vertex, std::string_view geometry,
          std::string_view fragment);
  /// A compute program.
  /// @param part  of it that is not ours: the error then names that file and its line
  Program(const std::string& name, std::string_view compute, const ShaderPart* part = nullptr);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  void use() const { glUseProgram(handle_); }
  /// Uniforms that the compiler left out are ignored.
  void set(const char* uniform, int value) const { glProgramUniform1i(handle_, at(uniform), value); }
  void set(const char* uniform, uint32_t value) const { glProgramUniform1ui(handle_, at(uniform), value); }
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
  void set(const char* uniform, const std::vector<Mat3>& all) const {
    glProgramUniformMatrix3fv(handle_, at(uniform), static_cast<GLsizei>(all.size()), GL_FALSE,
                              &all.front()[0][0]);
  }
  void set(const char* uniform, const Mat3& m) const {
    glProgramUniformMatrix3fv(handle_, at(uniform), 1, GL_FALSE, &m[0][0]);
  }
  /// @param values  as many as the uniform's type has
  void set(const ActiveUniform& uniform, const std::vector<float>& values) const;
  std::vector<ActiveUniform> uniforms() const;

 private:
  /// In order of the stages.
  Program(const std::string& name, std::initializer_list<std::pair<GLenum, std::string_view>> stages,
          const ShaderPart* part = nullptr);
  GLint at(const char* uniform) const { return glGetUniformLocation(handle_, uniform); }
  void link(const std::string& name) const;

  GLuint handle_;
};

/// Runs that many groups of the compute program in use, in rows of at most 1,024: number y *
/// gl_NumWorkGroups.x + x, of which the last row may have too many.
void dispatch(std::size_t groups);

/// A vertex shader that fills the target by one triangle, to draw with three vertices and no buffers.
std::string_view whole_target_vertex();

}  // namespace sconce::gpu
