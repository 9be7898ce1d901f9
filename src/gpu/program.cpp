// SPDX-License-Identifier: Apache-2.0
#include "gpu/program.h"

#include <regex>
#include <vector>

#include "core/error.h"
#include "core/text.h"

namespace sconce::gpu {

namespace {

class Shader {
 public:
  Shader(GLenum stage, const std::string& name, std::string_view text) : handle_(glCreateShader(stage)) {
    const char* start = text.data();
    const auto length = static_cast<GLint>(text.size());
    glShaderSource(handle_, 1, &start, &length);
    glCompileShader(handle_);
    GLint good = GL_FALSE;
    glGetShaderiv(handle_, GL_COMPILE_STATUS, &good);
    if (good != GL_TRUE) {
      const std::string log = this->log();
      glDeleteShader(handle_);
      throw Error("shader '" + name + "'", explain(log, text));
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
  static std::string explain(const std::string& log, std::string_view text) {
    // Mesa and most others: "0:12(5): error: ..."; NVIDIA: "0(12) : error C0000: ...".
    static const std::regex place(R"(^\s*(?:ERROR:\s*)?\d+(?::(\d+)(?:\(\d+\))?|\((\d+)\))\s*:\s*(.*))");
    for (const std::string& line : split(log, '\n')) {
      std::smatch match;
      if (!std::regex_search(line, match, place)) continue;
      const auto number = static_cast<std::size_t>(std::stoul(match[1].matched ? match[1] : match[2]));
      const std::vector<std::string> lines = split(std::string(text), '\n');
      const std::string code =
          number >= 1 && number <= lines.size() ? std::string(trim(lines[number - 1])) : "";
      return "line " + std::to_string(number) + ": `" + code + "`: " + match[3].str();
    }
    return "cannot be compiled: " + std::string(trim(split(log, '\n').front()));
  }

  GLuint handle_;
};

}  // namespace

Program::Program(const std::string& name, std::string_view vertex, std::string_view fragment) : handle_(0) {
  const Shader v(GL_VERTEX_SHADER, name, vertex), f(GL_FRAGMENT_SHADER, name, fragment);
  handle_ = glCreateProgram();
  glAttachShader(handle_, v.handle());
  glAttachShader(handle_, f.handle());
  link(name);
  glDetachShader(handle_, v.handle());
  glDetachShader(handle_, f.handle());
}

Program::Program(const std::string& name, std::string_view compute) : handle_(0) {
  const Shader c(GL_COMPUTE_SHADER, name, compute);
  handle_ = glCreateProgram();
  glAttachShader(handle_, c.handle());
  link(name);
  glDetachShader(handle_, c.handle());
}

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

std::string_view whole_target_vertex() {
  return
#include "gpu/whole_target.glsl.h"
      ;
}

}  // namespace sconce::gpu
