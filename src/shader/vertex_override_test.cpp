// SPDX-License-Identifier: Apache-2.0
#include "shader/vertex_override.h"

#include <regex>
#include <vector>

#include "core/error.h"
#include "shader/test_glslang.h"

namespace sconce {
namespace {

/// Vertex shaders as renderers have them: every dialect, and what makes rewriting hard.
const std::vector<std::string>& corpus() {
  static const std::vector<std::string> all{
      // Fixed-function names.
      "#version 110\nvarying vec3 n;\nvoid main() {\n  n = gl_NormalMatrix * gl_Normal;\n  gl_TexCoord[0] = "
      "gl_MultiTexCoord0;\n"
      "  gl_Position = ftransform();\n}\n",
      "#version 110\nuniform mat4 mvp;\nattribute vec4 at;\nvoid main(void) { gl_Position = mvp * at; }",
      // A word like main, a comment about main, a string of signs.
      "#version 120\nattribute vec3 at; /* main() is\nbelow */ uniform mat4 mainmatrix;\n"
      "// void main() { not yet }\nfloat domain(float x) { return x; }\n"
      "void main()\n{\n  if (domain(at.x) < 0.0) { gl_Position = vec4(0.0); return; }\n"
      "  gl_Position = mainmatrix * vec4(at, 1.0);\n}\n",
      "#version 130\nin vec4 at;\nout vec4 v;\nvoid main() { v = at; gl_Position = "
      "gl_ModelViewProjectionMatrix * at; }\n",
      "#version 140\nin vec4 at;\nlayout(std140) uniform Camera { mat4 mvp; };\nvoid main() { gl_Position = "
      "mvp * at; }\n",
      "#version 150 core\nin vec4 at;\nuniform mat4 bones[4];\nin vec4 weight;\n"
      "vec4 skinned() { vec4 p = vec4(0); for (int i = 0; i < 4; ++i) p += weight[i] * (bones[i] * at); "
      "return p; }\n"
      "void main(\n) { gl_Position = skinned(); }\n",
      "#version 330 core\nlayout(location = 0) in vec3 at;\nlayout(location = 2) in vec3 n;\nout vec3 "
      "normal;\n"
      "uniform mat4 world, view_projection;\ninvariant gl_Position;\n"
      "void main() { normal = mat3(world) * n; gl_Position = view_projection * world * vec4(at, 1); }\n",
      // Two mains, one for each branch, and a prototype.
      "#version 330\n#define SHADOW 1\nin vec4 at;\nvoid main();\n#if SHADOW\nvoid main() { gl_Position = "
      "at.xyww; }\n"
      "#else\nvoid main() { gl_Position = at; }\n#endif\n",
      // Main behind a macro.
      "#version 400\n#define ENTRY void main()\nin vec4 at;\nENTRY { gl_Position = at; }\n",
      "#version 410\nin vec4 at;\nout gl_PerVertex { vec4 gl_Position; float gl_ClipDistance[1]; };\n"
      "void main() { gl_Position = at; gl_ClipDistance[0] = at.z; }\n",
      "#version 420\n#extension GL_ARB_shading_language_420pack : enable\nin vec4 at;\n"
      "void main() { const mat4 m = mat4(1); gl_Position = m * at; }\n",
      "#version 430 core\nlayout(std430, binding = 0) buffer Points { vec4 points[]; };\n"
      "void main() { gl_Position = points[gl_VertexID]; }\n",
      "#version 440\nin vec4 at;\nout Vertex { vec4 color; } main_out;\nvoid main() { main_out.color = at; "
      "gl_Position = at; }\n",
      "#version 450 core\n#ifdef NEVER\n#error main( is not for NEVER, don't\n#endif\n#pragma main stage\nin "
      "dvec4 at;\n"
      "void main() { gl_Position = vec4(at); }\n",
      "#version 460\nin vec4 at;\nvoid main() { gl_Position = at + float(gl_DrawID); }\n",
      "#version 100\nattribute vec4 at;\nuniform mat4 mvp;\nvarying mediump vec2 uv;\n"
      "void main() { uv = at.xy; gl_Position = mvp * at; }\n",
      "precision highp float;\n#line 1 3\nuniform mat4 m;\nattribute vec3 at;\nvoid "
      "main(){gl_Position=m*vec4(at,1.);}// end",
      "#version 300 es\nprecision highp float;\nin vec3 at;\nuniform mat4 m;\nvoid main() { gl_Position = m "
      "* vec4(at, 1.0); }\n",
      "#version 310 es\nlayout(location = 0) in vec3 at;\nvoid main() { gl_Position = vec4(at, 1.0); }\n",
      "#version 320 es\r\nin highp vec3 at;\r\nvoid main()\r\n{\r\n  gl_Position = vec4(at, 1.0);\r\n}\r\n",
  };
  return all;
}

TEST(VertexOverride, TheCompilerTakesTheCorpusBeforeAndAfter) {
  std::set<std::string> before(corpus().begin(), corpus().end()), after;
  expect_valid_glsl(before, "vert");
  for (const std::string& shader : corpus()) after.insert(override_vertex_position(shader, "a shader"));
  EXPECT_EQ(after.size(), corpus().size());
  expect_valid_glsl(after, "vert");
}

TEST(VertexOverride, LeavesEverythingElseAlone) {
  for (const std::string& shader : corpus()) {
    const std::string rewritten = override_vertex_position(shader, "a shader");
    const std::string back = std::regex_replace(rewritten, std::regex("sconce_host_main"), "main");
    EXPECT_EQ(back.substr(0, shader.size()), shader);
    EXPECT_NE(rewritten.find("void main() {\n  sconce_host_main();\n", 0), std::string::npos);
  }
}

TEST(VertexOverride, SpeaksTheDialect) {
  const auto has = [](const std::string& shader, const char* line, const VertexOverride& names = {}) {
    EXPECT_NE(override_vertex_position(shader, "x", names).find(line), std::string::npos) << line;
  };
  has("void main() {}", "\nattribute vec2 sconce_place;");
  has("#version 100\nvoid main() {}", "\nattribute vec2 sconce_place;");
  has("#version 300 es\nvoid main() {}", "\nin vec2 sconce_place;");
  has("#version 330\nvoid main() {}", "\nlayout(location = 7) in vec2 spot;", {"spot", "on", "inner", 7});
}

TEST(VertexOverride, RefusesWithTheLine) {
  const auto refused = [](const std::string& shader, const char* message) {
    try {
      override_vertex_position(shader, "walls.vert");
      ADD_FAILURE() << "taken: " << shader;
    } catch (const Error& e) {
      EXPECT_EQ(std::string(e.what()).substr(0, std::string(message).size()), message);
    }
  };
  refused("#version 330\nin vec4 at;\n", "walls.vert:3: there is no function main");
  refused("// void main() {}", "walls.vert:1: there is no function main");
  refused("#version 120\n\nvoid main(int x) {}", "walls.vert:3: main takes parameters");
  refused("#version 120\n#define main other\nvoid main() {}", "walls.vert:2: main is a macro");
  refused("#version 330\nuniform vec4\n main;\nvoid main() {}",
          "walls.vert:3: main is the name of something else");
  refused("struct S { int main; } s;\nvoid main() { s.main = 1; }",
          "walls.vert:1: main is the name of something");
  refused("#version 500\nvoid main() {}", "walls.vert:1: GLSL version 500 (allowed: 110 to 460");
  refused("#version 330 es\nvoid main() {}", "walls.vert:1: GLSL version 330");
  refused("void main() {}\n/* open\n", "walls.vert:2: a comment that does not end");
  refused("// goes on \\\nvoid main() {}\n", "walls.vert:1: a comment that ends with a backslash");
  refused("#if 1\nvoid main() {}\n", "walls.vert:1: #if without #endif");
  refused("void main() {}\n#endif\n", "walls.vert:2: #endif without #if");
  refused("void main() {\n gl_FragColor = vec4(1); }", "walls.vert:2: gl_FragColor is of another stage");
  refused(override_vertex_position("void main() {}", "x"),
          "walls.vert:1: the name sconce_host_main is taken");
}

}  // namespace
}  // namespace sconce
