// SPDX-License-Identifier: Apache-2.0
#include "gpu/program.h"

#include <memory>
#include <regex>
#include <vector>

#include "core/error.h"
#include "core/text.h"

namespace sconce::gpu {

namespace {

class Shader {
 public:
  Shader(GLenum stage, const std::string& name, std::string_view text, const ShaderPart* part = nullptr)
      : handle_(glCreateShader(stage)) {
    const char* start = text.data();
    const auto length = static_cast<GLint>(text.size());
    glShaderSource(handle_, 1, &start, &length);
    glCompileShader(handle_);
    GLint good = GL_FALSE;
    glGetShaderiv(handle_, GL_COMPILE_STATUS, &good);
    if (good != GL_TRUE) {
      const std::string log = this->log();
      glDeleteShader(handle_);
      throw explain(log, name, text, part);
    }
  }
  ~Shader() { glDeleteShader(handle_); }
  Shader(const Shader&) = delete;
  Shader& operator=(const Shader&) = delete;
  GLuint handle() const { return handle_; }

 private:
  std::string log() const {
    GLint length = 0;
    glGetShaderiv(handle_, GL_INFO_LOG_LENGTH, &length);
    std::string text(static_cast<std::size_t>(std::max(length, 1)), '\0');
    glGetShaderInfoLog(handle_, length, &length, text.data());
    text.resize(static_cast<std::size_t>(length));
    return text;
  }

  /// The log's first complaint beside the line it speaks of: "line 12: `vec3 c = 1;`: ...".
  static Error explain(const std::string& log, const std::string& name, std::string_view text,
                       const ShaderPart* part) {
    // Mesa and most others: "0:12(5): error: ..."; NVIDIA: "0(12) : error C0000: ...".
    static const std::regex place(R"(^\s*(?:ERROR:\s*)?\d+(?::(\d+)(?:\(\d+\))?|\((\d+)\))\s*:\s*(.*))");
    const std::string shader = "shader '" + name + "'";
    for (const std::string& line : split(log, '\n')) {
      std::smatch match;
      if (!std::regex_search(line, match, place)) continue;
      std::size_t number = std::stoul(match[1].matched ? match[1] : match[2]);
      const bool theirs = part != nullptr && number >= ShaderPart::kFirstLine;
      if (theirs) number -= ShaderPart::kFirstLine - 1;
      const std::vector<std::string> lines = split(std::string(theirs ? part->text : text), '\n');
      const std::string code = number >= 1 && number <= lines.size() ? trim(lines[number - 1]) : "";
      const std::string what = "`" + code + "`: " + match[3].str();
      return theirs ? Error(part->file + ":" + std::to_string(number), what)
                    : Error(shader, "line " + std::to_string(number) + ": " + what);
    }
    return Error(shader, "cannot be compiled: " + trim(split(log, '\n').front()));
  }

  GLuint handle_;
};

}  // namespace

Program::Program(const std::string& name, std::initializer_list<std::pair<GLenum, std::string_view>> stages,
                 const ShaderPart* part)
    : handle_(0) {
  std::vector<std::unique_ptr<Shader>> shaders;
  for (const auto& [stage, text] : stages)
    shaders.push_back(std::make_unique<Shader>(stage, name, text, part));
  handle_ = glCreateProgram();
  for (const auto& shader : shaders) glAttachShader(handle_, shader->handle());
  link(name);
  for (const auto& shader : shaders) glDetachShader(handle_, shader->handle());
}

Program::Program(const std::string& name, std::string_view vertex, std::string_view fragment)
    : Program(name, {{GL_VERTEX_SHADER, vertex}, {GL_FRAGMENT_SHADER, fragment}}) {}

Program::Program(const std::string& name, std::string_view vertex, std::string_view geometry,
                 std::string_view fragment)
    : Program(name,
              {{GL_VERTEX_SHADER, vertex}, {GL_GEOMETRY_SHADER, geometry}, {GL_FRAGMENT_SHADER, fragment}}) {}

Program::Program(const std::string& name, std::string_view compute, const ShaderPart* part)
    : Program(name, {{GL_COMPUTE_SHADER, compute}}, part) {}

Program::~Program() {
  glDeleteProgram(handle_);
}

void Program::link(const std::string& name) const {
  glLinkProgram(handle_);
  GLint good = GL_FALSE, length = 0;
  glGetProgramiv(handle_, GL_LINK_STATUS, &good);
  if (good == GL_TRUE) return;
  glGetProgramiv(handle_, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
  glGetProgramInfoLog(handle_, length, &length, log.data());
  log.resize(static_cast<std::size_t>(length));
  glDeleteProgram(handle_);
  throw Error("shader '" + name + "'", "cannot be linked: " + std::string(trim(split(log, '\n').front())));
}

void Program::set(const ActiveUniform& uniform, const std::vector<float>& values) const {
  const GLint place = at(uniform.name.c_str());
  const auto whole = static_cast<GLint>(values.front());
  switch (uniform.type) {
    case GL_FLOAT:
      return glProgramUniform1fv(handle_, place, 1, values.data());
    case GL_FLOAT_VEC2:
      return glProgramUniform2fv(handle_, place, 1, values.data());
    case GL_FLOAT_VEC3:
      return glProgramUniform3fv(handle_, place, 1, values.data());
    case GL_FLOAT_VEC4:
      return glProgramUniform4fv(handle_, place, 1, values.data());
    default:
      return glProgramUniform1i(handle_, place, whole);
  }
}

std::vector<ActiveUniform> Program::uniforms() const {
  GLint count = 0;
  glGetProgramiv(handle_, GL_ACTIVE_UNIFORMS, &count);
  std::vector<ActiveUniform> out;
  for (GLint i = 0; i < count; ++i) {
    char name[256];
    GLint size = 0;
    GLenum type = GL_NONE;
    glGetActiveUniform(handle_, static_cast<GLuint>(i), sizeof name, nullptr, &size, &type, name);
    out.push_back({name, type, size});
  }
  return out;
}

void dispatch(std::size_t groups) {
  constexpr std::size_t kAcross = 1024;
  if (groups > 0)
    glDispatchCompute(static_cast<GLuint>(std::min(groups, kAcross)),
                      static_cast<GLuint>((groups + kAcross - 1) / kAcross), 1);
}

std::string_view whole_target_vertex() {
  return
#include "gpu/whole_target.glsl.h"
      ;
}

}  // namespace sconce::gpu
