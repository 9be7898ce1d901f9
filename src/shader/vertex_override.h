// SPDX-License-Identifier: Apache-2.0
// A renderer's own vertex shader, made to draw faces into texture space: "position overwrite at the end of
// affected vertex shaders" (Hrbek 2006, system B). Text only.
#pragma once

#include <string>
#include <string_view>

namespace sconce {

struct VertexOverride {
  std::string place = "sconce_place";      ///< vec2 vertex input: where the vertex lies, 0 to 1 in the target
  std::string enable = "sconce_in_faces";  ///< float uniform: 0 = as on screen, 1 = in texture space
  std::string host_main = "sconce_host_main";  ///< what the shader's main is called then
  int location = -1;                           ///< of the input, where it is laid out by number; -1: by name
};

/// Renames the shader's main and appends one that calls it and then overwrites gl_Position; no line of it
/// moves. GLSL 110 to 460, ES 100 to 320. The vertex stage must be the last before rasterising.
/// @param name  of the shader, for messages
/// @throws Error: name:line, what cannot be rewritten, and what could
std::string override_vertex_position(std::string_view shader, const std::string& name,
                                     const VertexOverride& names = {});

}  // namespace sconce
